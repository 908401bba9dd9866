// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Rims of the skin -> for each the way out -> a distance to outline and
// generated limb, blended by how far out -> marching cubes -> cut off at the rim.
#include "reconstruct/limb_beyond_scan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "core/parallel.hpp"
#include "core/units.hpp"
#include "geometry/aabb.hpp"
#include "geometry/grid.hpp"
#include "geometry/mat3.hpp"
#include "mesh/clip.hpp"
#include "mesh/marching_cubes.hpp"
#include "mesh/simplify.hpp"
#include "mesh/smooth.hpp"
#include "reconstruct/bone_surface.hpp"
#include "reconstruct/skin_rims.hpp"

namespace carpus::reconstruct {
namespace {

/// Means of grown-ups [mm], from the metacarpal's base on: [buryanov2010hand] table 1.
struct Ray {
  BoneId metacarpal;
  std::array<double, 4> lengths;  ///< metacarpal, phalanges; the thumb has two
  double radius_mm;               ///< of the skin at the knuckle; at the tip 0.75 of it [E]
};
constexpr std::array<Ray, 5> kRays{{
    {BoneId::Metacarpal1, {46.2, 31.6, 21.7, 0}, 10.5},
    {BoneId::Metacarpal2, {68.1, 39.8, 22.4, 15.8}, 9.5},
    {BoneId::Metacarpal3, {64.6, 44.6, 26.3, 17.4}, 9.8},
    {BoneId::Metacarpal4, {58.0, 41.4, 25.7, 17.3}, 9.2},
    {BoneId::Metacarpal5, {53.7, 32.7, 18.1, 16.0}, 8.2},
}};
/// Of each joint from the knuckle on, towards the palm [degrees]: a hand at rest [E].
constexpr std::array<double, 3> kBendDeg{12, 22, 12};
/// Breadth of the palm where a scan of the generic wrist ends [mm].
constexpr double kPalmMm = 80;
constexpr double kTipShare = 0.75;
constexpr double kBlendMm = 6;     ///< by which parts melt into each other
constexpr double kOutlineMm = 25;  ///< in which the outline becomes the generated
constexpr double kWithinMm = 1.5;  ///< it begins so far inside the skin
constexpr double kUnderMm = 0.1;   ///< and so far below it
constexpr double kForearmMm = 150;
constexpr double kWidenPerMm = 0.002;
constexpr double kVoxelMm = 1.6;
constexpr double kMostMm = 500;
/// Of the middle finger's way in another's: shafts spread, fingers at rest hardly do [E].
constexpr double kMiddleInShaft = 0.35;
constexpr double kMiddleInFinger = 0.75;
/// For the eye: as many as the skin itself has.
constexpr std::size_t kMostFacets = 9000;
constexpr double kMostErrorMm = 0.3;
constexpr mesh::SmoothOptions kSmooth{8, 0.5, -0.526, false, 0};

struct Capsule {
  Vec3 from;
  Vec3 to;
  double from_mm = 0;
  double to_mm = 0;
  [[nodiscard]] double distance_to(const Vec3& p) const {
    const Vec3 way = to - from;
    const double t = std::clamp(dot(p - from, way) / std::max(1e-9, squared_length(way)), 0.0, 1.0);
    return distance(p, from + way * t) - (from_mm + (to_mm - from_mm) * t);
  }
};

/// Smooth least of two distances: a polynomial over kBlendMm.
double melted(double a, double b) {
  const double h = std::max(kBlendMm - std::abs(a - b), 0.0) / kBlendMm;
  return std::min(a, b) - h * h * kBlendMm / 4;
}

/// The way of a bone's shaft, from its base.
struct Shaft {
  Vec3 base;
  Vec3 way;
  double seen_mm = 0;
};

std::optional<Shaft> shaft_of(const cases::CaseData& data, BoneId id, const Vec3& distal) {
  for (const cases::Bone& bone : data.bones) {
    if (bone.bone != id || bone.surface.vertices.empty()) continue;
    std::vector<Vec3> points;
    Vec3 middle;
    for (const Vec3& v : bone.surface.vertices) {
      points.push_back((bone.patient_from_bone * Point<frame::Bone>{v}).v);
      middle += points.back() / static_cast<double>(bone.surface.vertices.size());
    }
    // Means of the two ends, twice: a shaft along the line between them.
    Vec3 way = distal;
    Vec3 low;
    Vec3 high;
    for (int pass = 0; pass < 4; ++pass) {
      std::sort(points.begin(), points.end(),
                [&](const Vec3& a, const Vec3& b) { return dot(a, way) < dot(b, way); });
      const std::size_t share = std::max<std::size_t>(1, points.size() / 4);
      low = high = Vec3{};
      for (std::size_t i = 0; i < share; ++i) {
        low += points[i] / static_cast<double>(share);
        high += points[points.size() - 1 - i] / static_cast<double>(share);
      }
      way = normalized_or(high - low, way);
    }
    const double seen = dot(points.back() - points.front(), way);
    return Shaft{low - way * dot(low - points.front(), way), way, seen};
  }
  return std::nullopt;
}

/// Parts that follow each other; others melt into them.
using Finger = std::vector<Capsule>;

Vec3 towards_middle(const Vec3& way, const Vec3& middle, double share) {
  return normalized_or(way * (1 - share) + middle * share, way);
}

/// The finger of a ray beyond what was seen of it, its metacarpal first. @param middle  the way of
/// the middle finger.
Finger finger(const Ray& ray,
              const Shaft& shaft,
              const Vec3& middle,
              const Vec3& dorsal,
              double size) {
  const bool is_thumb = ray.metacarpal == BoneId::Metacarpal1;
  const Vec3 end = shaft.base + shaft.way * shaft.seen_mm;
  const Vec3 on = is_thumb ? shaft.way : towards_middle(shaft.way, middle, kMiddleInShaft);
  const Vec3 knuckle = end + on * std::max(size * ray.lengths[0] - shaft.seen_mm, 2.0);
  const double radius = size * ray.radius_mm;
  Finger parts{{end, knuckle, radius * (is_thumb ? 1.3 : 1.25), radius}};
  Vec3 way = is_thumb ? shaft.way : towards_middle(shaft.way, middle, kMiddleInFinger);
  // Towards the palm.
  const Vec3 axis = normalized_or(cross(dorsal, way), {});
  Vec3 at = knuckle;
  const int phalanges = is_thumb ? 2 : 3;
  for (int i = 0; i < phalanges; ++i) {
    way = rotation_about(
              axis, radians_from_degrees(is_thumb ? 8 : kBendDeg[static_cast<std::size_t>(i)])) *
          way;
    const Vec3 to = at + way * (size * ray.lengths[static_cast<std::size_t>(i) + 1]);
    const double share = [&](double k) { return 1 - (1 - kTipShare) * k / phalanges; }(i);
    const double then = 1 - (1 - kTipShare) * (i + 1.0) / phalanges;
    parts.push_back({at, to, radius * share, radius * then});
    at = to;
  }
  // The last one ends with its pulp.
  parts.back().to = parts.back().to - way * (0.5 * parts.back().to_mm);
  return parts;
}

/// What fills the palm between two metacarpals, and the web between their knuckles.
Finger palm_between(const Capsule& one, const Capsule& other, double size) {
  const auto half = [&](const Vec3& a, const Vec3& b) { return (a + b) / 2.0; };
  const Vec3 low = half(one.from, other.from);
  const Vec3 high = half(one.to, other.to);
  const Vec3 on = normalized_or(high - low, {}) * (6 * size);
  return {{low, high, one.from_mm, 9 * size}, {one.to + on, other.to + on, 7.5 * size, 7.5 * size}};
}

template <typename Distance>
TriangleMesh surface_of(const Aabb& box, const Distance& distance_at) {
  const Vec3 low = box.low;
  const Vec3 extent = box.extent();
  // Of no hand and no forearm: a case that came from elsewhere may hold anything.
  if (!(std::max({extent.x, extent.y, extent.z}) < kMostMm)) return {};
  GridGeometry g;
  g.origin = low;
  g.spacing = {kVoxelMm, kVoxelMm, kVoxelMm};
  for (std::size_t a = 0; a < 3; ++a) {
    g.size[a] = static_cast<int>(extent[a] / kVoxelMm) + 2;
  }
  Grid<float> grid(g);
  const auto plane = static_cast<std::size_t>(g.size[0]) * static_cast<std::size_t>(g.size[1]);
  parallel_for(static_cast<std::size_t>(g.size[2]), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin * plane; i < end * plane; ++i) {
      const VoxelIndex v = g.index_of(i);
      const Vec3 p = low + Vec3{v.x * kVoxelMm, v.y * kVoxelMm, v.z * kVoxelMm};
      grid[i] = static_cast<float>(-distance_at(p));
    }
  });
  return mesh::simplify(mesh::smooth(mesh::extract_isosurface(grid.view(), 0), kSmooth),
                        {kMostFacets, kMostErrorMm})
      .mesh;
}

void include(Aabb& box, const Vec3& p, double radius) {
  const Vec3 r{radius, radius, radius};
  box.include(p - r);
  box.include(p + r);
}

void append(TriangleMesh& mesh, const TriangleMesh& other) {
  const auto first = static_cast<Triangle::value_type>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (Triangle t : other.facets) {
    for (auto& corner : t) corner += first;
    mesh.facets.push_back(t);
  }
}

double breadth_of(const Rim& rim) {
  double most = 0;
  for (const Vec3& c : rim.corners) most = std::max(most, 2 * distance(c, rim.middle));
  return most;
}

double smooth_step(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

TriangleMesh hand_from(const Rim& rim, const std::vector<Finger>& fingers, const Vec3& way) {
  const RimOutline outline(rim, way);
  Aabb box;
  for (const Vec3& c : rim.corners) include(box, c, 4);
  for (const Finger& parts : fingers) {
    for (const Capsule& part : parts) {
      include(box, part.from, part.from_mm + 8);
      include(box, part.to, part.to_mm + 8);
    }
  }
  const TriangleMesh grown = surface_of(box, [&](const Vec3& p) {
    double generated = 1e9;
    for (const Finger& parts : fingers) {
      double least = 1e9;
      for (const Capsule& part : parts) least = std::min(least, part.distance_to(p));
      generated = melted(generated, least);
    }
    const double beyond = rim.beyond(p);
    const double share = smooth_step(beyond / kOutlineMm);
    if (share >= 1) return generated;
    const double under = outline.distance_to(p, 1) + kUnderMm;
    return under + (generated - under) * share;
  });
  return largest_piece(mesh::clipped(grown, rim.middle - rim.outwards * kWithinMm, rim.outwards));
}

TriangleMesh forearm_from(const Rim& rim, const Vec3& way) {
  const RimOutline outline(rim, way);
  Aabb box;
  for (const Vec3& c : rim.corners) {
    include(box, c, 4);
    include(box, rim.middle + (c - rim.middle) * (1 + kWidenPerMm * kForearmMm) + way * kForearmMm,
            2);
  }
  const TriangleMesh grown = surface_of(box, [&](const Vec3& p) {
    const double widened = 1 + kWidenPerMm * std::max(0.0, rim.beyond(p));
    return outline.distance_to(p, widened) + kUnderMm;
  });
  TriangleMesh open = mesh::clipped(grown, rim.middle - rim.outwards * kWithinMm, rim.outwards);
  open = mesh::clipped(open, rim.middle + way * (kForearmMm - 4), -rim.outwards);
  return largest_piece(open);
}

}  // namespace

LimbBeyondScan limb_beyond_scan(const cases::CaseData& data) {
  LimbBeyondScan limb;
  // x proximal, y radial in a right wrist, z volar: docs/units_and_frames.md.
  const Mat3 to_patient = data.wrist_from_patient.inverse().rotation;
  const Vec3 distal = -(to_patient * Vec3{1, 0, 0});
  const Vec3 dorsal = -(to_patient * Vec3{0, 0, 1});
  const std::vector<Rim> rims = rims_of(data.skin);
  std::array<std::optional<Shaft>, kRays.size()> shafts;
  for (std::size_t i = 0; i < kRays.size(); ++i) {
    shafts[i] = shaft_of(data, kRays[i].metacarpal, distal);
  }
  double palm_mm = 0;
  for (const Rim& rim : rims) {
    // The wrist's origin is the radius's distal end.
    const double proximal_mm = (data.wrist_from_patient * Point<frame::Patient>{rim.middle}).v.x;
    const bool is_forearm = proximal_mm > 10 && dot(rim.outwards, distal) < -0.5;
    if (is_forearm) append(limb.forearm, forearm_from(rim, -distal));
    if (dot(rim.outwards, distal) > 0.5) palm_mm = std::max(palm_mm, breadth_of(rim));
  }
  const double size = palm_mm > 0 ? std::clamp(palm_mm / kPalmMm, 0.8, 1.2) : 1;
  // Each ray goes on from the rim through which its shaft leaves.
  std::vector<std::vector<Finger>> fingers(rims.size());
  std::vector<Vec3> ways(rims.size());
  std::vector<std::optional<Capsule>> beside(rims.size());
  const Vec3 middle = shafts[2] ? shafts[2]->way : distal;
  for (std::size_t i = 0; i < kRays.size(); ++i) {
    if (!shafts[i]) continue;
    const Vec3 end = shafts[i]->base + shafts[i]->way * shafts[i]->seen_mm;
    std::optional<std::size_t> through;
    double nearest = 15;
    for (std::size_t r = 0; r < rims.size(); ++r) {
      if (!(dot(shafts[i]->way, rims[r].outwards) > 0.3)) continue;
      const RimOutline outline(rims[r], shafts[i]->way);
      const double apart = std::max(std::abs(rims[r].beyond(end)) - 4, outline.distance_to(end, 1));
      if (apart < nearest) {
        nearest = apart;
        through = r;
      }
    }
    if (!through) continue;
    auto& of_rim = fingers[*through];
    of_rim.push_back(finger(kRays[i], *shafts[i], middle, dorsal, size));
    ways[*through] += shafts[i]->way;
    const Capsule bone = of_rim.back().front();
    if (i > 1 && beside[*through]) {
      of_rim.push_back(palm_between(*beside[*through], bone, size));
    }
    beside[*through] = bone;
  }
  for (std::size_t r = 0; r < rims.size(); ++r) {
    if (fingers[r].empty()) continue;
    append(limb.hand, hand_from(rims[r], fingers[r], normalized_or(ways[r], rims[r].outwards)));
  }
  return limb;
}

}  // namespace carpus::reconstruct
