// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "geometry/swept_tool.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carpus {

void SweptTool::add(const AxisKnot& knot) noexcept {
  if (count_ > 0 && knot.z_mm <= knots_[count_ - 1].z_mm) return;  // the same ball again
  if (count_ < knots_.size()) knots_[count_++] = knot;
}

void SweptTool::check() noexcept {
  is_sound_ = is_finite(origin_) && is_finite(axis_) && count_ > 0;
  for (const AxisKnot& knot : knots()) {
    is_sound_ = is_sound_ && std::isfinite(knot.z_mm) && std::isfinite(knot.radius_mm) &&
                knot.radius_mm >= 0;
  }
}

SweptTool SweptTool::bar(const Vec3& a,
                         double radius_at_a_mm,
                         const Vec3& b,
                         double radius_at_b_mm) noexcept {
  SweptTool tool;
  const double way = distance(a, b);
  tool.origin_ = a;
  tool.axis_ = normalized_or(b - a, {0, 0, 1});
  if (std::abs(radius_at_b_mm - radius_at_a_mm) < way) {
    tool.add({0, radius_at_a_mm});
    tool.add({way, radius_at_b_mm});
  } else if (radius_at_a_mm >= radius_at_b_mm) {
    tool.add({0, radius_at_a_mm});
  } else {
    tool.add({way, radius_at_b_mm});
  }
  tool.check();
  tool.is_sound_ = tool.is_sound_ && is_finite(b) && radius_at_a_mm >= 0 && radius_at_b_mm >= 0;
  return tool;
}

SweptTool SweptTool::whole(const InstrumentShape& shape,
                           const Pose<frame::Bone, frame::Tool>& bone_from_tool,
                           double travel_mm) noexcept {
  SweptTool tool;
  tool.origin_ = bone_from_tool.translation;
  tool.axis_ = bone_from_tool.rotation.column(2);
  for (const AxisKnot& knot : shape.knots()) tool.add(knot);
  if (travel_mm > 0) tool.add({shape.back_z_mm() + travel_mm, shape.greatest_radius_mm()});
  tool.check();
  tool.is_sound_ = tool.is_sound_ && travel_mm >= 0;
  return tool;
}

SweptTool SweptTool::advance(const InstrumentShape& shape,
                             const Pose<frame::Bone, frame::Tool>& bone_from_tool,
                             double travel_mm) noexcept {
  SweptTool tool;
  tool.origin_ = bone_from_tool.translation;
  tool.axis_ = bone_from_tool.rotation.column(2);
  for (const AxisKnot& knot : shape.knots()) {
    tool.add(knot);
    if (knot.radius_mm >= shape.greatest_radius_mm()) break;
  }
  if (travel_mm > 0) {
    tool.add({tool.knots_[tool.count_ - 1].z_mm + travel_mm, shape.greatest_radius_mm()});
  }
  tool.is_back_known_ = true;
  tool.check();
  tool.is_sound_ = tool.is_sound_ && travel_mm >= 0;
  return tool;
}

SweptTool SweptTool::widened(double by_mm) const noexcept {
  SweptTool wider = *this;
  for (std::size_t i = 0; i < count_; ++i) wider.knots_[i].radius_mm += by_mm;
  wider.check();
  wider.is_sound_ = wider.is_sound_ && is_sound_ && by_mm >= 0;
  return wider;
}

double SweptTool::greatest_radius_mm() const noexcept {
  double greatest = 0;
  for (const AxisKnot& knot : knots()) greatest = std::max(greatest, knot.radius_mm);
  return greatest;
}

Aabb SweptTool::bounds() const noexcept {
  Aabb box;
  for (const AxisKnot& knot : knots()) {
    const Vec3 centre = origin_ + axis_ * knot.z_mm;
    const Vec3 r{knot.radius_mm, knot.radius_mm, knot.radius_mm};
    box.include(centre - r);
    box.include(centre + r);
  }
  return box;
}

double SweptTool::signed_distance(const Vec3& point_in_bone) const noexcept {
  const Vec3 from = point_in_bone - origin_;
  const double along = dot(from, axis_);
  const double off_axis = length(from - axis_ * along);
  const auto to_ball = [&](double z, double radius) {
    return std::sqrt(off_axis * off_axis + (along - z) * (along - z)) - radius;
  };
  double best = std::numeric_limits<double>::infinity();
  if (count_ == 1) best = to_ball(knots_[0].z_mm, knots_[0].radius_mm);
  for (std::size_t i = 1; i < count_; ++i) {
    const AxisKnot& a = knots_[i - 1];
    const AxisKnot& b = knots_[i];
    // The nearest ball lies where the line to the point meets the hull, not the axis, squarely.
    const double slope = (b.radius_mm - a.radius_mm) / (b.z_mm - a.z_mm);
    const double lean = slope / std::sqrt(1 - slope * slope);
    const double z = std::clamp(along + off_axis * lean, a.z_mm, b.z_mm);
    best = std::min(best, to_ball(z, a.radius_mm + slope * (z - a.z_mm)));
  }
  return best;
}

}  // namespace carpus
