// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The directions that may still separate two bodies, after some differences of their vertices are
// known: a convex cone, cut smaller with each.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "geometry/vec3.hpp"

namespace carpus::survey {

/// A vertex of the second body minus one of the first, in common coordinates [mm]. A direction
/// separates only if it is uphill along all of these.
struct VertexDifference {
  Vec3 vector;
  std::uint32_t on_first = 0;
  std::uint32_t on_second = 0;
};

/// The cone of all directions that are uphill along every difference so far, as the cyclic list of
/// its extreme rays; between two of them runs the plane of one difference. No allocation.
class SeparatingCone {
 public:
  static constexpr std::size_t kMostCuts = 128;

  /// Starts anew with the half space of one difference, which must not be zero. It is cut off where
  /// directions are within 1e-12 of its plane: along these no gap is wider than 1e-12 times the
  /// difference.
  void start(const VertexDifference& first) noexcept;

  enum class Cut : std::uint8_t {
    Left,     ///< directions remain, or kMostCuts is reached
    Nothing,  ///< none: the origin is in the differences' convex hull, the bodies meet
  };
  /// @param least_gap_mm  a cone along which no gap can be wider than this counts as empty.
  [[nodiscard]] Cut cut(const VertexDifference& by, double least_gap_mm) noexcept;

  /// A unit vector inside: the mean of the extreme rays.
  [[nodiscard]] Vec3 centre() const noexcept;
  /// Whether `direction` is uphill along every difference that bounds the cone.
  [[nodiscard]] bool contains(const Vec3& direction) const noexcept;

  /// After cut() gave Nothing: four differences around the origin, the last cut among them. Empty
  /// where the origin is on a triangle of them, or on a line between two.
  [[nodiscard]] std::optional<std::array<VertexDifference, 4>> around_origin(
      const VertexDifference& last) const noexcept;

 private:
  // Successive rays are no more than a right angle apart: of opposite ones no sum is between them.
  struct Ray {
    Vec3 direction;           // unit
    VertexDifference beyond;  // bounds the cone between this ray and the next
  };
  static constexpr std::size_t kMostRays = 4 + 2 * kMostCuts;  // a cut adds two at most
  std::array<Ray, kMostRays> rays_;
  std::size_t count_ = 0;
};

}  // namespace carpus::survey
