// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The nearest point of the Minkowski difference in twice the digits, for the few poses at which
// rounding hides from doubles which feature is nearest.
#pragma once

#include <array>
#include <cstddef>

#include "convex/pair_query.hpp"
#include "survey/closest/posed_pair.hpp"
#include "survey/closest/simplex.hpp"

namespace carpus::survey {

struct WideNearest {
  convex::Verdict verdict = convex::Verdict::Unknown;
  std::array<DifferencePoint, 4> points{};
  std::size_t count = 0;
  SimplexNearest<Vec3> nearest;  ///< of `points`, rounded to double
};

/// @param points  `count` corners to begin with, 1 to 4; their positions are computed afresh.
/// @param gap_mm  the answer is Apart only if the distance is proven to within this much.
/// Cost: some 2 us an iteration, at most 64.
[[nodiscard]] WideNearest wide_nearest(const PosedPair& pair,
                                       const std::array<DifferencePoint, 4>& points,
                                       std::size_t count,
                                       double gap_mm) noexcept;

}  // namespace carpus::survey
