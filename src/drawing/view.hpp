// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// From a scene in space to a page, without perspective.
#pragma once

#include <algorithm>
#include <limits>
#include <span>

#include "drawing/svg.hpp"
#include "geometry/aabb.hpp"
#include "geometry/vec3.hpp"

namespace carpus::drawing {

/// A rectangle of a page.
struct PageArea {
  double left = 0;
  double top = 0;
  double width = 0;
  double height = 0;
};

/// Where the viewer of a hull stands: in front (-y) of the Patient frame (LPS), a little to the
/// left (+x) and above (+z).
inline constexpr Vec3 kInFront{0.5, -0.8, 0.35};

/// Turns points to the viewer and fits what is to be seen into an area.
class View {
 public:
  /// @param towards  from the scene to the viewer, not along z; +z is up.
  View(std::span<const Vec3> seen, const PageArea& area, const Vec3& towards = kInFront)
      : towards_(normalized_or(towards, {0, -1, 0})),
        right_(normalized_or(cross({0, 0, 1}, towards_), {1, 0, 0})),
        up_(cross(towards_, right_)),
        middle_{area.left + area.width / 2, area.top + area.height / 2} {
    Aabb box;
    for (const Vec3& p : seen) box.include(turn(p));
    const Vec3 size = box.extent();
    const double least = std::numeric_limits<double>::min();
    scale_ = std::min(area.width / std::max(size.x, least), area.height / std::max(size.y, least));
    centre_ = box.low + size * 0.5;
  }
  /// On the page, y down.
  [[nodiscard]] Vec2 operator()(const Vec3& p) const {
    const Vec3 d = (turn(p) - centre_) * scale_;
    return {middle_.x + d.x, middle_.y - d.y};
  }
  /// Larger is nearer to the viewer [mm].
  [[nodiscard]] double nearness(const Vec3& p) const { return dot(towards_, p); }
  [[nodiscard]] double units_per_mm() const { return scale_; }
  /// 0 to 1: how bright a facet is that a lamp beside the viewer shines on.
  [[nodiscard]] double brightness(const Vec3& normal) const {
    const Vec3 lamp = normalized_or({-0.4, 0.5, 0.77}, {0, 0, 1});
    return 0.45 + 0.55 * std::max(0.0, dot(turn(normal), lamp));
  }
  [[nodiscard]] bool faces_viewer(const Vec3& normal) const { return turn(normal).z > 0; }

 private:
  [[nodiscard]] Vec3 turn(const Vec3& p) const {
    return {dot(right_, p), dot(up_, p), dot(towards_, p)};
  }
  Vec3 towards_;
  Vec3 right_;
  Vec3 up_;
  Vec2 middle_;
  double scale_ = 1;
  Vec3 centre_;
};

[[nodiscard]] inline Colour shaded(const Colour& c, double brightness) {
  return {c[0] * brightness, c[1] * brightness, c[2] * brightness};
}

}  // namespace carpus::drawing
