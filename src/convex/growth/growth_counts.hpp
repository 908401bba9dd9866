// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What answered the queries of the growth program.
#pragma once

#include <cstdint>

namespace carpus::convex {

/// Sums over queries, for researchers.
struct GrowthCounts {
  std::uint64_t queries = 0;
  std::uint64_t by_last_proof = 0;  ///< the last proof held at the new pose
  std::uint64_t by_walking = 0;     ///< its direction or its point did, measured anew
  std::uint64_t by_last_rows = 0;   ///< the last four rows, or their point, did
  std::uint64_t by_features = 0;    ///< those of the features that a walk from the last ended on
  std::uint64_t by_spheres = 0;
  std::uint64_t cold_starts = 0;
  std::uint64_t repairs = 0;  ///< a kept basis had to change one row to be of use
  std::uint64_t pivots = 0;
  std::uint64_t walk_steps = 0;    ///< facets stepped to
  std::uint64_t exact = 0;         ///< decided by exact arithmetic: touching, nearly
  std::uint64_t exact_rounds = 0;  ///< of these, pairs of vertices beyond the features
  std::uint64_t pivot_limits = 0;  ///< of these, where the pivots ran out
};

}  // namespace carpus::convex
