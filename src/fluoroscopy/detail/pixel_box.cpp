// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "fluoroscopy/detail/pixel_box.hpp"

#include <algorithm>
#include <limits>
#include <optional>

namespace carpus::fluoroscopy::detail {
namespace {

int pixel_of(double value) { return static_cast<int>(std::clamp(value, -1e6, 1e6)); }

PixelBox whole_picture(const CArmPose& pose) {
  return {0, 0, pose.geometry.pixels - 1, pose.geometry.pixels - 1};
}

}  // namespace

PixelBox PixelBox::within(int pixels) const {
  return {std::max(left, 0), std::max(top, 0), std::min(right, pixels - 1),
          std::min(bottom, pixels - 1)};
}

PixelBox box_of(const MetalCylinder& rod, const CArmPose& pose) {
  const std::optional<PixelPosition> a = project_point(pose, {rod.start});
  const std::optional<PixelPosition> b = project_point(pose, {rod.end});
  if (!a || !b) return whole_picture(pose);
  // A rod's edge is at most twice as far out as in a parallel beam while it keeps clear of the
  // source by half its distance; nearer ones get the whole picture.
  const Vec3 source = pose.source_in_patient().v;
  const double nearest = std::min(distance(rod.start, source), distance(rod.end, source));
  if (nearest < pose.geometry.source_to_receptor_mm / 4) return whole_picture(pose);
  const double radius = std::max(rod.start_radius_mm, rod.end_radius_mm);
  const double reach =
      2 + 2 * radius * pose.geometry.source_to_receptor_mm / nearest / pose.geometry.pixel_mm();
  return {pixel_of(std::min(a->x, b->x) - reach), pixel_of(std::min(a->y, b->y) - reach),
          pixel_of(std::max(a->x, b->x) + reach), pixel_of(std::max(a->y, b->y) + reach)};
}

PixelBox box_of(std::span<const Vec3> points_in_patient, const CArmPose& pose) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  double left = kInfinite;
  double top = kInfinite;
  double right = -kInfinite;
  double bottom = -kInfinite;
  for (const Vec3& p : points_in_patient) {
    const std::optional<PixelPosition> at = project_point(pose, {p});
    if (!at) return whole_picture(pose);
    left = std::min(left, at->x);
    right = std::max(right, at->x);
    top = std::min(top, at->y);
    bottom = std::max(bottom, at->y);
  }
  return {pixel_of(left) - 1, pixel_of(top) - 1, pixel_of(right) + 1, pixel_of(bottom) + 1};
}

}  // namespace carpus::fluoroscopy::detail
