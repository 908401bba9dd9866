// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A cone is convex, so its shadow is the convex hull of its two rims' shadows.
#include "view_trainer/silhouette.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "hull/planar_hull.hpp"

namespace carpus::view_trainer {
namespace {

class Projector {
 public:
  explicit Projector(const PosedView& view) : view_(view) {}
  [[nodiscard]] Vec2 operator()(const Vec3& in_bone) const {
    const auto p = fluoroscopy::project_point(
        view_.c_arm, view_.patient_from_scaphoid * Point<frame::Bone>{in_bone});
    return p ? Vec2{p->x, p->y} : Vec2{};
  }

 private:
  const PosedView& view_;
};

}  // namespace

OutlineMap silhouette_of(const ScaphoidSurface& scaphoid, const PosedView& view) {
  const Projector project(view);
  const auto& geometry = view.c_arm.geometry;
  OutlineLattice lattice;
  // The scaphoid's middle is in the target's plane; its poles, 10 mm from there, are 3 % off.
  lattice.mm_per_pixel = geometry.pixel_mm() / geometry.magnification();
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Vec2 low{kFar, kFar};
  Vec2 high{-kFar, -kFar};
  std::vector<std::vector<Vec2>> projected;
  for (const cases::Bone* part : scaphoid.fragments()) {
    std::vector<Vec2>& corners = projected.emplace_back();
    for (const Vec3& vertex : part->surface.vertices) {
      const Vec2 p = project(vertex);
      corners.push_back(p);
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
  }
  const double margin = kAroundMm / lattice.mm_per_pixel;
  lattice.low = {std::floor(low.x - margin), std::floor(low.y - margin)};
  lattice.columns = static_cast<int>(std::ceil((high.x + margin - lattice.low.x) * kCellsPerPixel));
  lattice.rows = static_cast<int>(std::ceil((high.y + margin - lattice.low.y) * kCellsPerPixel));
  OutlineMap map(lattice);
  for (std::size_t i = 0; i < projected.size(); ++i) {
    for (const Triangle& f : scaphoid.fragments()[i]->surface.facets) {
      map.add_triangle(projected[i][f[0]], projected[i][f[1]], projected[i][f[2]]);
    }
  }
  constexpr double kGapPointMm = 0.25;  // points lie 0.3 mm apart
  for (const Vec3& p : scaphoid.gap_points()) {
    map.add_disc(project(p), kGapPointMm / lattice.mm_per_pixel);
  }
  map.finish();
  return map;
}

Polygon screw_outline(const PlacedScrew& placed, const PosedView& view) {
  constexpr int kAround = 64;
  const Projector project(view);
  const Vec3 a = any_perpendicular(placed.shaft);
  const Vec3 b = cross(placed.shaft, a);
  std::vector<Vec2> points;
  const auto add_rim = [&](const Vec3& centre, double radius) {
    for (int i = 0; i < kAround; ++i) {
      const double angle = 2 * std::numbers::pi * i / kAround;
      points.push_back(project(centre + (a * std::cos(angle) + b * std::sin(angle)) * radius));
    }
  };
  add_rim(placed.tip, placed.instrument().tip_diameter_mm / 2);
  add_rim(placed.tail(), placed.instrument().tail_diameter_mm / 2);
  const auto hull = hull::build_planar_hull(points, hull::PlanarAlgorithm::GrahamScan);
  Polygon outline;
  for (const std::uint32_t corner : hull.corners) outline.push_back(points[corner]);
  return outline;
}

}  // namespace carpus::view_trainer
