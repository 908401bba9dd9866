// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Landmark by the radius's own surface -> skin mark by the table -> of the ways in near there the
// one with most room between the pulled bones -> depth of the capsule by the joint's space. Points:
// bone of the joint's wall, a ligament's course, the disc's middle.
#include "arthroscopy/make_map.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "arthroscopy/portal_table.hpp"
#include "cases/joint_under_block.hpp"
#include "fields/distance_field.hpp"
#include "fields/triangle_tree.hpp"

namespace carpus::arthroscopy {
namespace {

using soft_tissue::Lining;
using soft_tissue::SoftTissue;
using soft_tissue::Space;

constexpr const char* kJoint = "radiocarpal";
constexpr double kRadPerDeg = 3.14159265358979323846 / 180;
constexpr double kStepMm = 0.25;
constexpr double kTiltStepDeg = 5;
/// Room for which a mark a millimetre farther off is taken [E].
constexpr double kPerMmOff = 0.03;
/// A scope's tip looks about from so far beyond the capsule at least [E]; farther in, where the
/// convex row lies nearer to the radius, bone stops it.
constexpr double kWorkingMm = 4.0;
constexpr double kLeastWayMm = 3.0;
constexpr double kFarMm = 4.0;
/// Skin over the dorsal capsule where the case has no skin [E].
constexpr double kSkinOverCapsuleMm = 8.0;
/// Cartilage of this joint: so near to the wall of its space.
constexpr double kOnWallMm = 0.6;
constexpr double kThinnestMm = 0.05;

/// The case in the frame of a left wrist of the generic size.
class Wrist {
 public:
  Wrist(const cases::CaseData& data, double size)
      : to_patient_(data.wrist_from_patient.inverse()),
        from_patient_(data.wrist_from_patient),
        size_(size),
        mirror_(data.side == Side::Left ? 1.0 : -1.0) {}

  [[nodiscard]] Vec3 point(const Vec3& left) const {
    return (to_patient_ * Point<frame::Wrist>{Vec3{left.x, left.y * mirror_, left.z} * size_}).v;
  }
  [[nodiscard]] Vec3 way(const Vec3& left) const {
    return (to_patient_ * Direction<frame::Wrist>{Vec3{left.x, left.y * mirror_, left.z}}).v;
  }
  [[nodiscard]] Vec3 left_of(const Vec3& point) const {
    const Vec3 w = (from_patient_ * Point<frame::Patient>{point}).v / size_;
    return {w.x, w.y * mirror_, w.z};
  }

 private:
  Pose<frame::Patient, frame::Wrist> to_patient_;
  Pose<frame::Wrist, frame::Patient> from_patient_;
  double size_;
  double mirror_;
};

/// Least distance to any bone as the hand is pulled.
class PulledBones {
 public:
  PulledBones(const cases::CaseData& data, double traction_n) : data_(data) {
    anatomy::HandPose pose = data.hand_motion.scan;
    pose.traction_n = traction_n;
    for (const cases::Bone& bone : data.bones) {
      from_patient_.push_back(cases::pose_under_block(data.hand_motion, bone.bone, pose).inverse());
    }
  }
  [[nodiscard]] double distance_mm(const Vec3& point) const {
    double least = kFarMm;
    for (std::size_t b = 0; b < data_.bones.size(); ++b) {
      const Vec3 local = (from_patient_[b] * Point<frame::Patient>{point}).v;
      if (data_.bones[b].distance_field.values().empty()) continue;
      const fields::DistanceSample s =
          fields::sample_distance(data_.bones[b].distance_field, local);
      if (s.is_inside_grid) least = std::min(least, s.distance_mm);
    }
    return least;
  }

 private:
  const cases::CaseData& data_;
  std::vector<Pose<frame::Bone, frame::Patient>> from_patient_;
};

const Space* space_of(const SoftTissue& tissue, const std::string& id) {
  for (const Space& space : tissue.spaces) {
    if (space.id == id && !space.surface.facets.empty()) return &space;
  }
  return nullptr;
}

/// Lister's tubercle: the most dorsal point of the radius where the generic one has it.
std::optional<Vec3> lister_of(const cases::CaseData& data, const Wrist& wrist) {
  const cases::Bone* radius = cases::find_bone(data, BoneId::Radius);
  if (radius == nullptr) return std::nullopt;
  std::optional<Vec3> best;
  for (const Vec3& v : radius->surface.vertices) {
    const Vec3 at = wrist.left_of(v);
    if (at.x < 1 || at.x > 12 || at.y < -4.5 || at.y > 4.5 || at.z > 0) continue;
    if (!best || at.z < best->z) best = at;
  }
  return best;
}

/// Where a line from within goes through the skin for the last time; none where there is no skin.
std::optional<double> way_to_skin(const MeshIn<frame::Patient>& skin,
                                  const Vec3& from,
                                  const Vec3& way) {
  std::optional<double> farthest;
  for (const Triangle& f : skin.facets) {
    const Vec3& a = skin.vertices[f[0]];
    const Vec3 ab = skin.vertices[f[1]] - a;
    const Vec3 ac = skin.vertices[f[2]] - a;
    const Vec3 p = cross(way, ac);
    const double det = dot(ab, p);
    if (det == 0) continue;
    const Vec3 s = from - a;
    const double u = dot(s, p) / det;
    const Vec3 q = cross(s, ab);
    const double v = dot(way, q) / det;
    const double t = dot(ac, q) / det;
    if (u < 0 || v < 0 || u + v > 1 || t < 0) continue;
    if (!farthest || t > *farthest) farthest = t;
  }
  return farthest;
}

struct WayIn {
  Vec3 capsule;
  Vec3 inwards;
  double room_mm = 0;
};

/// From the capsule to the working depth along a line: how thick a tip goes there.
std::optional<WayIn> way_in(const Grid<float>& space,
                            const PulledBones& bones,
                            const Vec3& from,
                            const Vec3& inwards) {
  std::optional<WayIn> way;
  double in = 0;
  for (double s = 0; s < 30; s += kStepMm) {
    const Vec3 p = from + inwards * s;
    const fields::DistanceSample wall = fields::sample_distance(space, p);
    const bool is_in = wall.is_inside_grid && wall.distance_mm < 0;
    if (!way) {
      if (!is_in && bones.distance_mm(p) < kLeastRoomMm) return std::nullopt;  // bone is before it
      if (!is_in) continue;
      way = WayIn{p, inwards, kFarMm};
    }
    if (!is_in || in > kWorkingMm) break;
    way->room_mm = std::min(way->room_mm, bones.distance_mm(p));
    in += kStepMm;
  }
  // A line that leaves the space at once only grazes it.
  if (way && in < kLeastWayMm) way.reset();
  return way;
}

class MapMaker {
 public:
  MapMaker(const cases::CaseData& data, const SoftTissue& tissue, const Space& space)
      : data_(data),
        tissue_(tissue),
        space_(space),
        table_(PortalTable::generic()),
        wrist_(data, tissue.size),
        bones_(data, table_.traction_n),
        wall_(space.surface) {
    map_.space = fields::build_distance_field(space.surface, {0.4, kFarMm});
    map_.space_body = body_of(BoneId::Radius);
    map_.disc = tissue.disc.body;
    map_.distal = wrist_.way({-1, 0, 0});
  }

  cases::ArthroscopicMap make() {
    place_portals();
    if (map_.portals.empty()) return std::move(map_);
    place_points();
    collect_cartilage();
    return std::move(map_);
  }

 private:
  [[nodiscard]] std::uint8_t body_of(BoneId bone) const {
    for (std::size_t b = 0; b < data_.bones.size(); ++b) {
      if (data_.bones[b].bone == bone) return static_cast<std::uint8_t>(b);
    }
    return 0;
  }

  void place_portals() {
    const std::optional<Vec3> lister = lister_of(data_, wrist_);
    if (!lister) {
      map_.problems.emplace_back("there is no radius to feel Lister's tubercle on");
      return;
    }
    std::vector<std::pair<std::string, Vec3>> marks{{"lister", *lister}};
    for (const TabledPortal& portal : table_.portals) {
      const auto mark = std::find_if(marks.begin(), marks.end(),
                                     [&](const auto& m) { return m.first == portal.from; });
      if (mark == marks.end()) {
        map_.problems.push_back(portal.name + ": " + portal.from + " was not found");
        continue;
      }
      const Vec3 nominal = mark->second + Vec3{-portal.distal_mm, portal.ulnar_mm, 0};
      if (const std::optional<Vec3> at = place(portal, nominal)) marks.emplace_back(portal.id, *at);
    }
  }

  /// @return where it was placed, in the frame of the generic wrist.
  std::optional<Vec3> place(const TabledPortal& portal, const Vec3& nominal) {
    std::optional<WayIn> best;
    Vec3 mark;
    double best_value = -1e9;
    for (double deg = portal.proximal_deg[0]; deg <= portal.proximal_deg[1]; deg += kTiltStepDeg) {
      const double tilt = deg * kRadPerDeg;
      const Vec3 inwards = wrist_.way({std::sin(tilt), 0, std::cos(tilt)});
      for (double x = -portal.search_mm[0]; x <= portal.search_mm[0]; x += 0.5) {
        for (double y = -portal.search_mm[1]; y <= portal.search_mm[1]; y += 0.5) {
          const Vec3 left{nominal.x + x, nominal.y + y, -18};
          const auto way = way_in(map_.space, bones_, wrist_.point(left), inwards);
          // Of two ways with much the same room the one nearer to the mark.
          const double value = way ? way->room_mm - kPerMmOff * std::hypot(x, y) : -1e9;
          if (!way || value <= best_value) continue;
          best = way;
          best_value = value;
          mark = left;
        }
      }
    }
    if (!best || best->room_mm < kLeastRoomMm) {
      map_.problems.push_back(
          portal.name + ": no room between the bones" +
          (best ? " (" + std::to_string(best->room_mm).substr(0, 4) + " mm)" : std::string()));
      return std::nullopt;
    }
    cases::Portal placed;
    placed.id = portal.id;
    placed.name = portal.name;
    placed.landmarks = portal.landmarks;
    placed.joint = portal.joint;
    placed.inwards = best->inwards;
    placed.capsule_mm =
        way_to_skin(data_.skin, best->capsule, -best->inwards).value_or(kSkinOverCapsuleMm);
    placed.skin = best->capsule - best->inwards * placed.capsule_mm;
    placed.room_mm = best->room_mm;
    placed.body = map_.space_body;
    map_.portals.push_back(placed);
    return Vec3{mark.x, mark.y, nominal.z};
  }

  /// The vertex of the joint's wall nearest to a point: of this lining, and beside this body, where
  /// they are asked for.
  [[nodiscard]] Vec3 on_wall(const Vec3& point,
                             std::optional<Lining> lining,
                             std::optional<std::uint8_t> body = std::nullopt) const {
    Vec3 best = point;
    double least = 1e18;
    for (std::size_t i = 0; i < space_.surface.vertices.size(); ++i) {
      if (lining && space_.lining[i] != *lining) continue;
      const double far = squared_length(space_.surface.vertices[i] - point);
      if (far < least && (!body || nearest_body(space_.surface.vertices[i]) == *body)) {
        least = far;
        best = space_.surface.vertices[i];
      }
    }
    return best;
  }

  [[nodiscard]] std::optional<Vec3> place_of(const TabledPoint& point) const {
    if (point.on) {
      const cases::Bone* bone = cases::find_bone(data_, *point.on);
      if (bone == nullptr && *point.on == BoneId::Scaphoid) {
        bone = cases::find_bone(data_, *point.on, BonePart::Proximal);
      }
      if (bone == nullptr) return std::nullopt;
      const auto body = static_cast<std::uint8_t>(bone - data_.bones.data());
      return on_wall(wrist_.point(point.at), Lining::Cartilage, body);
    }
    if (point.is_disc) {
      if (tissue_.disc.middle.vertices.empty()) return std::nullopt;
      Vec3 sum;
      for (const Vec3& v : tissue_.disc.middle.vertices) sum += v;
      return on_wall(sum / static_cast<double>(tissue_.disc.middle.vertices.size()), Lining::Disc);
    }
    for (const soft_tissue::Ligament& l : tissue_.ligaments) {
      if (l.id != point.ligament || l.strands.empty()) continue;
      const std::vector<Vec3>& course = l.strands[l.strands.size() / 2].course;
      const double at = point.fraction * static_cast<double>(course.size() - 1);
      return on_wall(course[static_cast<std::size_t>(at + 0.5)], std::nullopt);
    }
    return std::nullopt;
  }

  [[nodiscard]] std::uint8_t nearest_body(const Vec3& point) const {
    std::uint8_t best = 0;
    double least = 1e18;
    for (std::size_t b = 0; b < data_.bones.size(); ++b) {
      if (data_.bones[b].distance_field.values().empty()) continue;
      const auto s = fields::sample_distance(data_.bones[b].distance_field, point);
      if (s.is_inside_grid && s.distance_mm < least) {
        least = s.distance_mm;
        best = static_cast<std::uint8_t>(b);
      }
    }
    return best;
  }

  void place_points() {
    for (const TabledPoint& point : table_.points) {
      const std::optional<Vec3> at = place_of(point);
      if (!at) {
        map_.problems.push_back(point.name + ": is missing in this case");
        continue;
      }
      map_.points.push_back({point.number, point.id, point.name, point.found_by, *at,
                             point.is_disc ? map_.space_body : nearest_body(*at), point.is_probed});
    }
  }

  void collect_cartilage() {
    for (const soft_tissue::Cartilage& c : tissue_.cartilage) {
      for (std::size_t b = 0; b < data_.bones.size(); ++b) {
        const MeshIn<frame::Bone>& surface = data_.bones[b].surface;
        if (data_.bones[b].label != c.label ||
            c.vertex_thickness_mm.size() != surface.vertices.size()) {
          continue;
        }
        for (const Triangle& f : surface.facets) {
          add_facet(surface, f, c.vertex_thickness_mm, static_cast<std::uint8_t>(b));
        }
      }
    }
  }

  void add_facet(const TriangleMesh& surface,
                 const Triangle& f,
                 const std::vector<float>& thickness,
                 std::uint8_t body) {
    for (const std::uint32_t v : f) {
      if (!(thickness[v] > kThinnestMm)) return;
    }
    const Vec3& a = surface.vertices[f[0]];
    const Vec3& b = surface.vertices[f[1]];
    const Vec3& c = surface.vertices[f[2]];
    const Vec3 middle = (a + b + c) / 3.0;
    if (!wall_.nearest(middle, kOnWallMm)) return;
    const Vec3 normal = cross(b - a, c - a);
    const double twice = length(normal);
    if (!(twice > 0)) return;
    map_.cartilage.push_back({middle, normal / twice, twice / 2, body});
  }

  const cases::CaseData& data_;
  const SoftTissue& tissue_;
  const Space& space_;
  const PortalTable& table_;
  Wrist wrist_;
  PulledBones bones_;
  fields::TriangleTree wall_;
  cases::ArthroscopicMap map_;
};

}  // namespace

cases::ArthroscopicMap make_map(const cases::CaseData& data, const SoftTissue& tissue) {
  cases::ArthroscopicMap map;
  const Space* space = space_of(tissue, kJoint);
  if (space == nullptr) {
    map.problems.emplace_back("the radiocarpal joint's space could not be made");
    return map;
  }
  return MapMaker(data, tissue, *space).make();
}

}  // namespace carpus::arthroscopy
