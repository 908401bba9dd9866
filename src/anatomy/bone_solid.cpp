// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Steps: each fragment is voxelised (geometry/voxels_inside.hpp); the union is dilated and eroded
// by half the bridged gap with exact Euclidean distance transforms; surface samples deep inside the
// result are fracture faces and dropped; lines are intersected with the triangles themselves.
#include "anatomy/bone_solid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "anatomy/detail/outline.hpp"
#include "core/error.hpp"
#include "geometry/aabb.hpp"
#include "geometry/trilinear.hpp"
#include "geometry/voxels_inside.hpp"
#include "imaging/distance_transform.hpp"

namespace carpus {
namespace {

constexpr double kVoxelMm = 0.4;          // half the thinnest lip of a fracture face
constexpr double kSampleSpacingMm = 0.5;  // 0.25^2 / (2 * 4 mm radius) = 8 um of radial error
constexpr double kFaceDepthMm = 1.0;      // deeper than this under the outside: a fracture face

GridGeometry geometry_around(const Aabb& box) {
  const Aabb padded = box.grown(kBridgedGapMm * 0.5 + 3 * kVoxelMm);
  GridGeometry geometry;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    geometry.size[axis] = static_cast<int>(padded.extent()[axis] / kVoxelMm) + 2;
  }
  geometry.spacing = {kVoxelMm, kVoxelMm, kVoxelMm};
  geometry.origin = padded.low;
  return geometry;
}

/// Morphological closing by a ball of `radius_mm`, in place.
void close_mask(Grid<std::uint8_t>& mask, double radius_mm) {
  const Grid<float> from_inside = imaging::distance_to_value(mask.view(), 1);
  for (std::size_t i = 0; i < mask.values().size(); ++i)
    mask[i] = from_inside[i] <= radius_mm ? 1 : 0;
  const Grid<float> from_outside = imaging::distance_to_background(mask.view());
  for (std::size_t i = 0; i < mask.values().size(); ++i)
    mask[i] = from_outside[i] > radius_mm ? 1 : 0;
}

/// A point of a fragment's surface and the outward normal there.
struct SurfaceSample {
  Vec3 point;
  Vec3 normal;
  double area_mm2;
};

/// Samples of a triangle at most kSampleSpacingMm apart: a lattice, or the middle of a small one.
void sample_triangle(const Vec3& a, const Vec3& b, const Vec3& c, std::vector<SurfaceSample>& out) {
  const Vec3 twice_area = cross(b - a, c - a);
  const Vec3 normal = normalized_or(twice_area, {0, 0, 0});
  const double longest = std::max({distance(a, b), distance(b, c), distance(c, a)});
  const int n = std::clamp(static_cast<int>(std::ceil(longest / kSampleSpacingMm)), 1, 64);
  const double area = 0.5 * length(twice_area) / (n == 1 ? 1 : (n + 1) * (n + 2) / 2);
  if (n == 1) {
    out.push_back({(a + b + c) / 3.0, normal, area});
    return;
  }
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; i + j <= n; ++j) {
      const Vec3 p = a + (b - a) * (double{1} * i / n) + (c - a) * (double{1} * j / n);
      out.push_back({p, normal, area});
    }
  }
}

bool holds(const Grid<std::uint8_t>& mask, const Vec3& point) noexcept {
  return voxel_at(mask, point, std::uint8_t{0}) != 0;
}

/// Whether the surface looks into another fragment across the gap: then it is a fracture face.
bool faces_another(const SurfaceSample& sample,
                   std::size_t own,
                   const std::vector<Grid<std::uint8_t>>& fragments) {
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    if (i == own) continue;
    for (double t = 0; t <= kBridgedGapMm; t += kVoxelMm) {
      if (holds(fragments[i], sample.point + sample.normal * t)) return true;
    }
  }
  return false;
}

/// Moller and Trumbore's line-triangle intersection: t along the line, or nothing.
std::optional<double> intersect(const Vec3& point,
                                const Vec3& direction,
                                const Vec3& a,
                                const Vec3& b,
                                const Vec3& c) {
  const Vec3 p = cross(direction, c - a);
  const double determinant = dot(b - a, p);
  if (determinant == 0) return std::nullopt;
  const double u = dot(point - a, p) / determinant;
  const Vec3 q = cross(point - a, b - a);
  const double v = dot(direction, q) / determinant;
  if (!(u >= 0 && v >= 0 && u + v <= 1)) return std::nullopt;
  return dot(c - a, q) / determinant;
}

/// The line's intervals inside one closed surface, appended; what finds no room is left out.
void append_intervals(const TriangleMesh& mesh,
                      const Vec3& point,
                      const Vec3& direction,
                      LineIntervals& out) noexcept {
  struct Crossing {
    double t;
    bool enters;
  };
  constexpr std::size_t kMost = 2 * LineIntervals::kMost;
  std::array<Crossing, kMost> crossings{};
  std::size_t count = 0;
  for (const Triangle& f : mesh.facets) {
    const Vec3 &a = mesh.vertices[f[0]], &b = mesh.vertices[f[1]], &c = mesh.vertices[f[2]];
    const auto t = intersect(point, direction, a, b, c);
    if (!t || count == kMost) continue;
    crossings[count++] = {*t, dot(cross(b - a, c - a), direction) < 0};
  }
  std::sort(crossings.begin(), crossings.begin() + static_cast<std::ptrdiff_t>(count),
            [](const Crossing& a, const Crossing& b) { return a.t < b.t; });
  // An edge that is met twice gives a repeated enter or leave: only a change of side counts.
  bool inside = false;
  for (std::size_t i = 0; i < count; ++i) {
    const Crossing& crossing = crossings[i];
    if (crossing.enters && !inside) out.add({crossing.t, crossing.t});
    if (!crossing.enters && inside && out.count > 0) {
      out.intervals[out.count - 1].leave_mm = crossing.t;
    }
    inside = crossing.enters;
  }
}

/// Of these the one that holds t = 0, or the nearest, the longer of equals; nullptr of none.
const LineInterval* nearest_to_zero(std::span<const LineInterval> intervals) noexcept {
  const LineInterval* best = nullptr;
  double best_distance = 0;
  for (const LineInterval& interval : intervals) {
    const double away = std::max({interval.enter_mm, -interval.leave_mm, 0.0});
    if (best == nullptr || away < best_distance ||
        (away == best_distance &&
         interval.leave_mm - interval.enter_mm > best->leave_mm - best->enter_mm)) {
      best = &interval;
      best_distance = away;
    }
  }
  return best;
}

}  // namespace

BoneSolid::BoneSolid(std::span<const MeshIn<frame::Bone>* const> fragments) {
  Aabb box;
  for (const TriangleMesh* mesh : fragments) {
    box.include(bounds_of(mesh->vertices));
    fragments_.push_back(*mesh);
  }
  if (box.is_empty()) {
    throw InvalidInput("bone solid: the bone has no surface; reconstruct the case again");
  }
  closed_ = Grid<std::uint8_t>(geometry_around(box));
  std::vector<Grid<std::uint8_t>> masks;
  for (const TriangleMesh& mesh : fragments_) {
    const Grid<std::uint8_t>& mask = masks.emplace_back(voxels_inside(mesh, closed_.geometry()));
    for (std::size_t i = 0; i < mask.values().size(); ++i) closed_[i] |= mask[i];
  }
  close_mask(closed_, kBridgedGapMm * 0.5);

  const Grid<float> depth = imaging::distance_to_background(closed_.view());
  for (std::size_t own = 0; own < fragments_.size(); ++own) {
    const TriangleMesh& mesh = fragments_[own];
    const auto first = static_cast<std::uint32_t>(outer_surface_.vertices.size());
    outer_surface_.vertices.insert(outer_surface_.vertices.end(), mesh.vertices.begin(),
                                   mesh.vertices.end());
    std::vector<SurfaceSample> samples;
    for (const Triangle& f : mesh.facets) {
      samples.clear();
      sample_triangle(mesh.vertices[f[0]], mesh.vertices[f[1]], mesh.vertices[f[2]], samples);
      bool is_outer = false;
      for (const SurfaceSample& sample : samples) {
        const Vec3 v = closed_.geometry().voxel_from_patient(sample.point);
        const VoxelIndex nearest{static_cast<int>(std::lround(v.x)),
                                 static_cast<int>(std::lround(v.y)),
                                 static_cast<int>(std::lround(v.z))};
        if (depth[nearest] <= kFaceDepthMm && !faces_another(sample, own, masks)) {
          outer_points_.push_back({sample.point, sample.area_mm2});
          is_outer = true;
        }
      }
      if (is_outer) outer_surface_.facets.push_back({first + f[0], first + f[1], first + f[2]});
    }
  }
}

bool BoneSolid::contains(const Vec3& point) const noexcept { return holds(closed_, point); }

LineIntervals BoneSolid::merged_intervals(const Vec3& point, const Vec3& direction) const noexcept {
  LineIntervals found;
  for (const TriangleMesh& mesh : fragments_) append_intervals(mesh, point, direction, found);
  std::sort(found.intervals.begin(),
            found.intervals.begin() + static_cast<std::ptrdiff_t>(found.count),
            [](const LineInterval& a, const LineInterval& b) { return a.enter_mm < b.enter_mm; });
  LineIntervals merged;
  for (const LineInterval& next : found.all()) {
    const LineInterval* last = merged.count > 0 ? &merged.intervals[merged.count - 1] : nullptr;
    const bool bridged = last != nullptr &&
                         (next.enter_mm <= last->leave_mm ||
                          (next.enter_mm - last->leave_mm <= kBridgedGapMm &&
                           contains(point + direction * (0.5 * (next.enter_mm + last->leave_mm)))));
    if (bridged) {
      merged.intervals[merged.count - 1].leave_mm = std::max(last->leave_mm, next.leave_mm);
    } else {
      merged.add(next);
    }
  }
  return merged;
}

std::vector<LineInterval> BoneSolid::intervals_along(const Vec3& point,
                                                     const Vec3& direction) const {
  const LineIntervals merged = merged_intervals(point, direction);
  return {merged.all().begin(), merged.all().end()};
}

std::optional<LineInterval> BoneSolid::chord_through(const Vec3& point,
                                                     const Vec3& direction) const noexcept {
  const LineIntervals merged = merged_intervals(point, direction);
  const LineInterval* nearest = nearest_to_zero(merged.all());
  return nearest != nullptr ? std::optional(*nearest) : std::nullopt;
}

double BoneSolid::way_inside_mm(const Vec3& point, const Vec3& direction) const noexcept {
  const auto chord = chord_through(point, direction);
  return chord && chord->leave_mm > 0.0 ? chord->leave_mm : 0.0;
}

bool BoneSolid::encloses(const Vec3& point) const noexcept {
  // Any direction will do; this one runs along no axis in which meshes have their edges.
  const Vec3 direction = normalized_or({0.5377, 0.6211, 0.5702}, {0, 0, 1});
  for (const TriangleMesh& mesh : fragments_) {
    LineIntervals found;
    append_intervals(mesh, point, direction, found);
    for (const LineInterval& interval : found.all()) {
      if (interval.enter_mm <= 0.0 && interval.leave_mm >= 0.0) return true;
    }
  }
  return fragments_.size() > 1 && contains(point);
}

BoneSection BoneSolid::section_at(const Vec3& point, const Vec3& normal) const {
  if (fragments_.size() == 1) return detail::outline_around(fragments_.front(), point, normal);
  return section_with_gap(point, normal);
}

/// By the voxels: the part that is connected with the point.
BoneSection BoneSolid::section_with_gap(const Vec3& point, const Vec3& normal) const {
  constexpr double kStepMm = 0.25;
  constexpr int kHalf = 72;  // 18 mm to each side: wider than any scaphoid
  constexpr int kWidth = 2 * kHalf + 1;
  const Vec3 a = any_perpendicular(normal);
  const Vec3 b = cross(normal, a);
  const auto inside = [&](int i, int j) {
    return contains(point + a * ((i - kHalf) * kStepMm) + b * ((j - kHalf) * kStepMm));
  };
  if (!inside(kHalf, kHalf)) return {};
  std::vector<std::uint8_t> seen(static_cast<std::size_t>(kWidth) * kWidth, 0);
  std::vector<std::pair<int, int>> stack;
  const auto visit = [&](int i, int j) {
    if (i < 0 || j < 0 || i >= kWidth || j >= kWidth) return;
    auto& mark = seen[static_cast<std::size_t>(i) * kWidth + static_cast<std::size_t>(j)];
    if (mark != 0 || !inside(i, j)) return;
    mark = 1;
    stack.emplace_back(i, j);
  };
  visit(kHalf, kHalf);
  std::size_t count = 0;
  Vec3 sum;
  while (!stack.empty()) {
    const auto [i, j] = stack.back();
    stack.pop_back();
    ++count;
    sum += a * ((i - kHalf) * kStepMm) + b * ((j - kHalf) * kStepMm);
    visit(i + 1, j);
    visit(i - 1, j);
    visit(i, j + 1);
    visit(i, j - 1);
  }
  const auto cells = static_cast<double>(count);
  return {cells * kStepMm * kStepMm, point + sum / cells};
}

}  // namespace carpus
