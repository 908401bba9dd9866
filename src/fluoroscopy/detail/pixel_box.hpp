// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The part of a picture that something can fall on.
#pragma once

#include <cstddef>
#include <span>

#include "fluoroscopy/c_arm.hpp"
#include "fluoroscopy/metal.hpp"

namespace carpus::fluoroscopy::detail {

/// Columns left to right and rows top to bottom, inclusive; may reach beyond the picture.
struct PixelBox {
  int left = 0;
  int top = 0;
  int right = -1;
  int bottom = -1;

  [[nodiscard]] bool holds(std::size_t i, std::size_t j) const {
    return static_cast<int>(i) >= left && static_cast<int>(i) <= right &&
           static_cast<int>(j) >= top && static_cast<int>(j) <= bottom;
  }
  [[nodiscard]] bool is_empty() const { return left > right || top > bottom; }
  /// Its part of a picture of so many pixels a side.
  [[nodiscard]] PixelBox within(int pixels) const;
};

/// Around a rod.
[[nodiscard]] PixelBox box_of(const MetalCylinder& rod, const CArmPose& pose);

/// Around the convex hull of points; the whole picture where one is level with the source or behind
/// it.
[[nodiscard]] PixelBox box_of(std::span<const Vec3> points_in_patient, const CArmPose& pose);

}  // namespace carpus::fluoroscopy::detail
