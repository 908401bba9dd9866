// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a pair of bodies keeps from one query of the growth program to the next.
#pragma once

#include <array>

#include "convex/features/feature_pair.hpp"
#include "convex/growth/growth_basis.hpp"
#include "convex/growth/pair_proofs.hpp"

namespace carpus::convex {

/// Where to go on from, and the last proofs that were found.
struct GrowthMemory {
  std::array<GrowthRow, 4> rows;  ///< the last basis; the first body's rows stand first
  int first_rows = 0;             ///< so many are the first body's; 0: there is no basis
  bool has_features = false;
  FeaturePair features;  ///< on the way to those that touch
  SeparationProof separation;
  CommonBallProof ball;

  [[nodiscard]] bool has_basis() const noexcept { return first_rows != 0; }
};

}  // namespace carpus::convex
