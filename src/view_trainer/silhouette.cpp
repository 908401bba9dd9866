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
  Projector(const PosedView& view, const Pose<frame::Patient, frame::Bone>& patient_from_bone)
      : c_arm_(view.c_arm), patient_from_bone_(patient_from_bone) {}
  explicit Projector(const PosedView& view) : Projector(view, view.patient_from_scaphoid) {}
  [[nodiscard]] Vec2 operator()(const Vec3& in_bone) const {
    const auto p =
        fluoroscopy::project_point(c_arm_, patient_from_bone_ * Point<frame::Bone>{in_bone});
    return p ? Vec2{p->x, p->y} : Vec2{};
  }

 private:
  const fluoroscopy::CArmPose& c_arm_;
  const Pose<frame::Patient, frame::Bone>& patient_from_bone_;
};

/// The shadow of two rims, which is convex.
class RimShadow {
 public:
  template <typename Project>
  void add(const Vec3& centre, const Vec3& axis, double radius, const Project& project) {
    constexpr int kAround = 64;
    const Vec3 a = any_perpendicular(axis);
    const Vec3 b = cross(axis, a);
    for (int i = 0; i < kAround; ++i) {
      const double angle = 2 * std::numbers::pi * i / kAround;
      points_.push_back(project(centre + (a * std::cos(angle) + b * std::sin(angle)) * radius));
    }
  }
  [[nodiscard]] Polygon outline() const {
    const auto hull = hull::build_planar_hull(points_, hull::PlanarAlgorithm::GrahamScan);
    Polygon outline;
    for (const std::uint32_t corner : hull.corners) outline.push_back(points_[corner]);
    return outline;
  }

 private:
  std::vector<Vec2> points_;
};

}  // namespace

OutlineMap silhouette_of(const ScaphoidSurface& scaphoid, const PosedView& view) {
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
    const auto body = static_cast<std::size_t>(part - scaphoid.data().bones.data());
    const Projector project(view, view.patient_from_bone.at(body));
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
  const Projector project(view);
  constexpr double kGapPointMm = 0.25;  // points lie 0.3 mm apart
  for (const Vec3& p : scaphoid.gap_points()) {
    map.add_disc(project(p), kGapPointMm / lattice.mm_per_pixel);
  }
  map.finish();
  return map;
}

Polygon screw_outline(const PlacedScrew& placed, const PosedView& view) {
  return screw_part_outline(placed, 0.0, placed.instrument().length_mm, view);
}

Polygon screw_part_outline(const PlacedScrew& placed,
                           double from_mm,
                           double to_mm,
                           const PosedView& view) {
  const Projector project(view);
  const instruments::Instrument& screw = placed.instrument();
  RimShadow shadow;
  for (const double z : {from_mm, to_mm}) {
    const double along = z / screw.length_mm;
    const double diameter = screw.tip_diameter_mm * (1 - along) + screw.tail_diameter_mm * along;
    shadow.add(placed.tip + placed.shaft * z, placed.shaft, diameter / 2, project);
  }
  return shadow.outline();
}

Polygon rod_outline(const fluoroscopy::MetalCylinder& rod, const fluoroscopy::CArmPose& c_arm) {
  const auto project = [&](const Vec3& in_patient) {
    const auto p = fluoroscopy::project_point(c_arm, Point<frame::Patient>{in_patient});
    return p ? Vec2{p->x, p->y} : Vec2{};
  };
  const Vec3 axis = normalized_or(rod.end - rod.start, {0, 0, 1});
  RimShadow shadow;
  shadow.add(rod.start, axis, rod.start_radius_mm, project);
  shadow.add(rod.end, axis, rod.end_radius_mm, project);
  return shadow.outline();
}

}  // namespace carpus::view_trainer
