// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The point of a simplex nearest to the origin: the small problem inside GJK and the active set.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "geometry/vec3.hpp"

namespace carpus::survey {

/// Coordinates' type of a vector type.
template <typename V>
using ScalarOf = decltype(V::x);

/// Up to four corners; those that carry the nearest point have positive weights that sum to 1.
template <typename V>
struct SimplexNearest {
  V point;                               ///< nearest to the origin
  std::array<ScalarOf<V>, 4> weights{};  ///< [i] of corner i, 0 where it is not needed
  std::uint8_t used = 0;                 ///< bit i: corner i is needed
  bool contains_origin = false;          ///< inside a tetrahedron, beyond doubt
};

/// @param w  `count` corners, 1 to 4. Flat and repeated ones are allowed.
/// The search goes from faces to edges to corners, into a face or edge only where it separates its
/// opposite corner from the origin, so that nothing is decided by a difference of squares
/// ([montanari2017signed] does the same on projections). `point` is computed from the normal of the
/// face or by projection on the edge, hence its direction is good even where it is nearly zero.
/// Instantiated for Vec3 and WideVec3.
template <typename V>
[[nodiscard]] SimplexNearest<V> nearest_of_simplex(const std::array<V, 4>& w,
                                                   std::size_t count) noexcept;

}  // namespace carpus::survey
