// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. Lay each bone of the generic wrist on the patient's; its landmarks carry the courses' points.
// 2. Put each point into its layer: so far over bone, or so deep under the skin.
// 3. Draw a curve through them; let all curves settle out of bone and of each other.
// 4. Cut off what leaves the scan; say how far each point goes with the hand.
#include "cases/make_structures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <span>

#include "cases/detail/carried_landmarks.hpp"
#include "cases/detail/stored_digits.hpp"
#include "cases/detail/tube_course.hpp"
#include "cases/find_structure.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"

namespace carpus::cases {
namespace {

using anatomy::Layer;
using anatomy::StructureTable;
using anatomy::TabledStructure;
using detail::CarriedLandmarks;
using detail::LaidTube;
using detail::rounded;
using detail::WristSurfaces;

/// What a scan leaves of a tube and is shorter than this tells nothing and is left out [mm].
constexpr double kShortestMm = 10;
/// A point that was meant to lie on bone or skin and is farther from it stays where it is [mm].
constexpr double kFarthestLayerMm = 14;
/// More than this in bone is a fault of the course [mm].
constexpr double kDeepestInBoneMm = 0.1;
/// A tendon or nerve nearer than this to the skin's outside is a fault [mm].
constexpr double kLeastUnderSkinMm = 0.0;
/// Of the whole way from forearm to hand: nearer than this to one end only that end counts; as the
/// page's skin (web/src/theatre/skin_blend_model.ts).
constexpr double kBlendFrom = 0.2;
constexpr double kBlendTo = 0.8;
constexpr int kEveningPasses = 6;

/// The point in its layer.
Vec3 in_layer(const Vec3& p,
              const anatomy::Place& place,
              double radius_mm,
              double scale,
              const WristSurfaces& surfaces) {
  if (place.layer == Layer::OverBone) {
    const WristSurfaces::Near near = surfaces.bone_near(p);
    if (std::abs(near.distance_mm) > kFarthestLayerMm * scale) return p;
    return near.point + near.outwards * (radius_mm + place.millimetres * scale);
  }
  if (place.layer == Layer::UnderSkin) {
    const auto depth = surfaces.depth_at(p);
    if (!depth || std::abs(depth->mm) > kFarthestLayerMm * scale) return p;
    return depth->point - depth->outwards * (place.millimetres * scale);
  }
  return p;
}

LaidTube lay(const TabledStructure& tabled,
             const CarriedLandmarks& landmarks,
             const WristSurfaces& surfaces) {
  const double radius = tabled.radius_mm * landmarks.scale();
  std::vector<Vec3> given;
  for (const anatomy::Place& place : tabled.course) {
    given.push_back(in_layer(landmarks.at(place), place, radius, landmarks.scale(), surfaces));
  }
  return detail::through(given, radius);
}

/// The longest run of points in the scan.
std::vector<Vec3> within_scan(const WristSurfaces& surfaces, const std::vector<Vec3>& line) {
  std::vector<Vec3> best;
  std::vector<Vec3> run;
  for (const Vec3& p : line) {
    if (surfaces.is_in_scan(p)) {
      run.push_back(p);
      if (run.size() > best.size()) best = run;
    } else {
      run.clear();
    }
  }
  return best;
}

double hand_share(const Vec3& p, const WristSurfaces& surfaces) {
  const double to_forearm = surfaces.distance_to_forearm(p);
  const double to_hand = surfaces.distance_to_hand(p);
  if (!std::isfinite(to_hand)) return 0;
  if (!std::isfinite(to_forearm)) return 1;
  const double way = to_forearm / std::max(1e-6, to_forearm + to_hand);
  const double t = std::clamp((way - kBlendFrom) / (kBlendTo - kBlendFrom), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

Structure structure_of(const TabledStructure& tabled,
                       const LaidTube& tube,
                       const WristSurfaces& surfaces) {
  Structure s{tabled.id, tabled.name, tabled.kind, rounded(tube.radius_mm), tabled.forearm, {}};
  std::vector<Vec3> line = within_scan(surfaces, tube.line);
  if (line.size() > kMaxStructurePoints) line.resize(kMaxStructurePoints);
  for (const Vec3& p : line) {
    s.course.push_back({rounded(p), hand_share(p, surfaces)});
  }
  for (int pass = 0; pass < kEveningPasses; ++pass) {
    const std::vector<StructurePoint> before = s.course;
    for (std::size_t i = 1; i + 1 < before.size(); ++i) {
      s.course[i].hand_share =
          (before[i - 1].hand_share + before[i].hand_share + before[i + 1].hand_share) / 3;
    }
  }
  for (StructurePoint& p : s.course) p.hand_share = rounded(p.hand_share);
  return s;
}

/// Five points to a millimetre.
double deepest_in(const WristSurfaces& surfaces, const Structure& structure) {
  constexpr double kSampleMm = 0.2;
  double deepest = 0;
  for (std::size_t i = 1; i < structure.course.size(); ++i) {
    const Vec3& a = structure.course[i - 1].at;
    const Vec3& b = structure.course[i].at;
    const int steps = std::max(1, static_cast<int>(std::ceil(distance(a, b) / kSampleMm)));
    for (int k = 0; k <= steps; ++k) {
      const Vec3 p = a + (b - a) * (static_cast<double>(k) / steps);
      deepest = std::max(deepest, structure.radius_mm - surfaces.bone_near(p).distance_mm);
    }
  }
  return deepest;
}

StructureDepth depth_of(const Structure& structure, const WristSurfaces& surfaces) {
  double under = std::numeric_limits<double>::infinity();
  for (const StructurePoint& p : structure.course) {
    if (const auto depth = surfaces.depth_at(p.at)) under = std::min(under, depth->mm);
  }
  return {deepest_in(surfaces, structure), under - structure.radius_mm};
}

double deepest_between(const Structure& a, const Structure& b) {
  double deepest = 0;
  for (const StructurePoint& p : a.course) {
    deepest = std::max(deepest, a.radius_mm - distance_to(b, p.at));
  }
  return deepest;
}

void check_length(const TabledStructure& tabled,
                  const LaidTube& tube,
                  double scale,
                  std::vector<std::string>& problems) {
  double length = 0;
  for (std::size_t i = 1; i < tube.line.size(); ++i) {
    length += distance(tube.line[i - 1], tube.line[i]);
  }
  if (length >= tabled.shortest_mm * scale && length <= tabled.longest_mm * scale) return;
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), "%s: %.0f mm long, expected %.0f to %.0f",
                tabled.name.c_str(), length, tabled.shortest_mm * scale, tabled.longest_mm * scale);
  problems.emplace_back(text.data());
}

/// From radial to ulnar, where they pass the radius's dorsal tubercle [K]: dorsal, volar.
constexpr std::array<std::string_view, 10> kDorsalOrder{
    "apl_epb",    "ecrl",     "ecrb",      "epl", "edc_index",
    "edc_middle", "edc_ring", "edc_small", "edm", "ecu"};
constexpr std::array<std::string_view, 6> kVolarOrder{
    "radial_artery", "fcr", "median_nerve", "ulnar_artery", "ulnar_nerve", "fcu"};

void check_order(const CaseData& data,
                 const std::vector<Structure>& structures,
                 std::span<const std::string_view> order,
                 const Vec3& lister,
                 std::vector<std::string>& problems) {
  const double mirror = data.side == Side::Left ? 1 : -1;
  const Vec3 at = (data.wrist_from_patient * Point<frame::Patient>{lister}).v;
  double most_ulnar = -std::numeric_limits<double>::infinity();
  std::string before;
  for (const std::string_view id : order) {
    const auto s = std::find_if(structures.begin(), structures.end(),
                                [&](const Structure& each) { return each.id == id; });
    if (s == structures.end()) continue;
    double nearest = std::numeric_limits<double>::infinity();
    double ulnar = 0;
    for (const StructurePoint& p : s->course) {
      const Vec3 w = (data.wrist_from_patient * Point<frame::Patient>{p.at}).v;
      if (std::abs(w.x - at.x) < nearest) {
        nearest = std::abs(w.x - at.x);
        ulnar = mirror * w.y;
      }
    }
    if (!(ulnar > most_ulnar)) problems.push_back(s->name + " lies radial to " + before);
    most_ulnar = std::max(most_ulnar, ulnar);
    before = s->name;
  }
}

PortalDistance measure_portal(const anatomy::TabledPortal& portal,
                              const CarriedLandmarks& landmarks,
                              const WristSurfaces& surfaces,
                              const std::vector<Structure>& structures) {
  const Vec3 at =
      in_layer(landmarks.at(portal.place), portal.place, 0, landmarks.scale(), surfaces);
  PortalDistance result{portal.id, "", std::numeric_limits<double>::infinity(), portal.published};
  for (const Structure& s : structures) {
    if (s.kind != anatomy::StructureKind::Nerve) continue;
    const double mm = distance_to(s, at);
    if (mm < result.mm) {
      result.mm = mm;
      result.nearest = s.name;
    }
  }
  return result;
}

std::string millimetres(const std::string& what, double mm) {
  std::array<char, 200> text{};
  std::snprintf(text.data(), text.size(), "%s: %.2f mm", what.c_str(), mm);
  return text.data();
}

void measure(const CaseData& data,
             const std::vector<Structure>& structures,
             const StructureTable& table,
             const CarriedLandmarks& landmarks,
             const WristSurfaces& surfaces,
             StructureFigures& f) {
  f.scale = landmarks.scale();
  f.worst_misfit_mm = landmarks.worst_misfit_mm();
  f.least_under_skin_mm = std::numeric_limits<double>::infinity();
  for (const Structure& s : structures) {
    const auto [in_bone, under] = depth_of(s, surfaces);
    f.deepest_in_bone_mm = std::max(f.deepest_in_bone_mm, in_bone);
    if (in_bone > kDeepestInBoneMm) f.problems.push_back(millimetres(s.name + " in bone", in_bone));
    f.least_under_skin_mm = std::min(f.least_under_skin_mm, under);
    if (under < kLeastUnderSkinMm) {
      f.problems.push_back(millimetres(s.name + " outside the skin", -under));
    }
    for (const Structure& other : structures) {
      if (&other != &s) {
        f.deepest_in_other_mm = std::max(f.deepest_in_other_mm, deepest_between(s, other));
      }
    }
  }
  if (!std::isfinite(f.least_under_skin_mm)) f.least_under_skin_mm = 0;
  for (std::size_t i = 0; i < table.landmarks.size(); ++i) {
    if (table.landmarks[i].id != "lister") continue;
    const Vec3 lister = landmarks.at({i, {}, Layer::AsPlaced, 0});
    check_order(data, structures, kDorsalOrder, lister, f.problems);
    check_order(data, structures, kVolarOrder, lister, f.problems);
  }
  for (const anatomy::TabledPortal& portal : table.portals) {
    f.portals.push_back(measure_portal(portal, landmarks, surfaces, structures));
  }
}

}  // namespace

MadeStructures make_structures(const CaseData& data, const StructureTable& table) {
  if (find_bone(data, BoneId::Radius) == nullptr) {
    throw InvalidInput("tendons, arteries and nerves cannot be laid without a radius");
  }
  const WristSurfaces surfaces(data);
  const CarriedLandmarks landmarks(data, table);
  MadeStructures made;
  std::vector<LaidTube> tubes;
  for (const TabledStructure& tabled : table.structures) {
    tubes.push_back(lay(tabled, landmarks, surfaces));
  }
  detail::settle(tubes, surfaces, detail::Settling::Roughly);
  for (std::size_t i = 0; i < tubes.size(); ++i) {
    check_length(table.structures[i], tubes[i], landmarks.scale(), made.figures.problems);
    Structure s = structure_of(table.structures[i], tubes[i], surfaces);
    if (length_of(s) < kShortestMm) {
      made.figures.problems.push_back(s.name + ": lies outside the scan and was left out");
      continue;
    }
    made.structures.push_back(std::move(s));
  }
  measure(data, made.structures, table, landmarks, surfaces, made.figures);
  return made;
}

StructureFigures measure_structures(const CaseData& data, const StructureTable& table) {
  const WristSurfaces surfaces(data);
  const CarriedLandmarks landmarks(data, table);
  StructureFigures figures;
  measure(data, data.structures, table, landmarks, surfaces, figures);
  return figures;
}

AddedStructures add_missing_structures(CaseData& data, const StructureTable& table) {
  const auto has = [&data](const auto& each) {
    return find_structure(data.structures, each.id) != nullptr;
  };
  const bool has_all = std::all_of(table.structures.begin(), table.structures.end(), has);
  AddedStructures added;
  if (has_all) return added;
  MadeStructures made = make_structures(data, table);
  added.problems = std::move(made.figures.problems);
  for (Structure& each : made.structures) {
    if (has(each) || data.structures.size() >= kMaxStructures) continue;
    added.names.push_back(each.name);
    data.structures.push_back(std::move(each));
  }
  return added;
}

double deepest_in_bone_mm(const CaseData& data, const Structure& structure) {
  return deepest_in(WristSurfaces(data), structure);
}

std::vector<StructureDepth> structure_depths(const CaseData& data) {
  const WristSurfaces surfaces(data);
  std::vector<StructureDepth> depths(data.structures.size());
  parallel_for(depths.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) depths[i] = depth_of(data.structures[i], surfaces);
  });
  return depths;
}

}  // namespace carpus::cases
