// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A canvas of depths for pictures of bodies: triangles are filled pixel by pixel with interpolated
// depth, nearest wins; lines and dots over them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "cli/png_file.hpp"
#include "geometry/aabb.hpp"
#include "geometry/vec3.hpp"

namespace carpus::cli {

using Colour = std::array<double, 3>;  ///< red, green, blue, 0 to 1
inline constexpr Colour kPaper{1, 1, 1};

/// x and y in pixels, y down; z towards the viewer, in pixels too.
class Canvas {
 public:
  Canvas(std::uint32_t width, std::uint32_t height)
      : width_(width),
        height_(height),
        colour_(std::size_t{width} * height, kPaper),
        depth_(colour_.size(), -std::numeric_limits<double>::infinity()) {}

  /// Nearest wins; opaque.
  void plot(int x, int y, double z, const Colour& c) {
    if (!is_inside(x, y) || z <= depth_[at(x, y)]) return;
    depth_[at(x, y)] = z;
    colour_[at(x, y)] = c;
  }
  void blend(int x, int y, const Colour& c, double opacity) {
    if (!is_inside(x, y)) return;
    for (std::size_t i = 0; i < 3; ++i) {
      double& value = colour_[at(x, y)][i];
      value += opacity * (c[i] - value);
    }
  }

  /// Calls pixel(x, y, z) for each pixel whose centre is in the triangle.
  template <typename Pixel>
  void fill(const Vec3& a, const Vec3& b, const Vec3& c, Pixel pixel) const {
    const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (area == 0) return;
    const auto [x0, x1] = pixels_between(std::array{a.x, b.x, c.x}, width_);
    const auto [y0, y1] = pixels_between(std::array{a.y, b.y, c.y}, height_);
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        const double u = ((b.x - x) * (c.y - y) - (b.y - y) * (c.x - x)) / area;
        const double v = ((c.x - x) * (a.y - y) - (c.y - y) * (a.x - x)) / area;
        const double w = 1 - u - v;
        if (u >= 0 && v >= 0 && w >= 0) pixel(x, y, u * a.z + v * b.z + w * c.z);
      }
    }
  }

  void line(const Vec3& a, const Vec3& b, const Colour& c, double opacity) {
    const double steps = std::ceil(std::max({std::abs(b.x - a.x), std::abs(b.y - a.y), 1.0}));
    for (double i = 0; i < steps; ++i) {  // the last pixel belongs to the next line
      const Vec3 p = a + (b - a) * (i / steps);
      blend(static_cast<int>(std::lround(p.x)), static_cast<int>(std::lround(p.y)), c, opacity);
    }
  }

  /// A round-ended stroke with soft edges, over everything.
  void stroke(const Vec3& a, const Vec3& b, double width, const Colour& c, double opacity = 1) {
    const double radius = width / 2;
    const auto [x0, x1] = pixels_between(
        std::array{std::min(a.x, b.x) - radius - 1, std::max(a.x, b.x) + radius + 1}, width_);
    const auto [y0, y1] = pixels_between(
        std::array{std::min(a.y, b.y) - radius - 1, std::max(a.y, b.y) + radius + 1}, height_);
    const double dx = b.x - a.x;
    const double dy = b.y - a.y;
    const double squared = std::max(dx * dx + dy * dy, 1e-12);
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        const double along = std::clamp(((x - a.x) * dx + (y - a.y) * dy) / squared, 0.0, 1.0);
        const double away = std::hypot(x - a.x - along * dx, y - a.y - along * dy);
        blend(x, y, c, opacity * std::clamp(radius + 0.5 - away, 0.0, 1.0));
      }
    }
  }

  /// A disc with soft edges, over everything.
  void disc(const Vec3& centre, double radius, const Colour& c) {
    stroke(centre, centre, 2 * radius, c);
  }

  void dot(const Vec3& p, const Colour& c) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        plot(static_cast<int>(std::lround(p.x)) + dx, static_cast<int>(std::lround(p.y)) + dy, p.z,
             c);
      }
    }
  }

  [[nodiscard]] Picture picture() const {
    Picture result{width_, height_, {}};
    result.rgb.reserve(3 * colour_.size());
    for (const Colour& c : colour_) {
      for (const double v : c) {
        result.rgb.push_back(static_cast<std::uint8_t>(std::lround(255 * std::clamp(v, 0.0, 1.0))));
      }
    }
    return result;
  }

 private:
  template <std::size_t N>
  static std::array<int, 2> pixels_between(const std::array<double, N>& values,
                                           std::uint32_t count) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return {static_cast<int>(std::max(0.0, std::floor(*low))),
            static_cast<int>(std::min(static_cast<double>(count) - 1, std::ceil(*high)))};
  }
  [[nodiscard]] bool is_inside(int x, int y) const {
    return x >= 0 && y >= 0 && x < static_cast<int>(width_) && y < static_cast<int>(height_);
  }
  [[nodiscard]] std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * width_ + static_cast<std::size_t>(x);
  }
  std::uint32_t width_;
  std::uint32_t height_;
  std::vector<Colour> colour_;
  std::vector<double> depth_;
};

/// A rectangle of a picture [pixels].
struct PixelArea {
  double left = 0;
  double top = 0;
  double width = 0;
  double height = 0;
};

/// Where the viewer of a hull stands: in front (-y) of the Patient frame (LPS), a little to the
/// left
/// (+x) and above (+z).
inline constexpr Vec3 kInFront{0.5, -0.8, 0.35};

/// Turns points to the viewer, without perspective, and fits what is to be seen into an area.
class View {
 public:
  /// @param towards  from the scene to the viewer, not along z; +z is up.
  View(std::span<const Vec3> seen, const PixelArea& area, const Vec3& towards = kInFront)
      : towards_(normalized_or(towards, {0, -1, 0})),
        right_(normalized_or(cross({0, 0, 1}, towards_), {1, 0, 0})),
        up_(cross(towards_, right_)),
        middle_{area.left + area.width / 2, area.top + area.height / 2, 0} {
    Aabb box;
    for (const Vec3& p : seen) box.include(turn(p));
    const Vec3 size = box.extent();
    const double least = std::numeric_limits<double>::min();
    scale_ = std::min(area.width / std::max(size.x, least), area.height / std::max(size.y, least));
    centre_ = box.low + size * 0.5;
  }
  /// x and y in pixels, y down; z towards the viewer, in pixels too.
  [[nodiscard]] Vec3 operator()(const Vec3& p) const {
    const Vec3 d = (turn(p) - centre_) * scale_;
    return {middle_.x + d.x, middle_.y - d.y, d.z};
  }
  [[nodiscard]] double pixels_per_mm() const { return scale_; }
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
  Vec3 middle_;
  double scale_ = 1;
  Vec3 centre_;
};

inline Colour shaded(const Colour& c, double brightness) {
  return {c[0] * brightness, c[1] * brightness, c[2] * brightness};
}

}  // namespace carpus::cli
