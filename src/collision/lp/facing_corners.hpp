// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A separating direction tried again at a new pose with how far each body really reaches, read off
// its vertices. Where turning one body used up a proof's margin this costs a third of a pivot.
#pragma once

#include <cstdint>

#include "collision/closest/support.hpp"
#include "collision/lp/pair_proofs.hpp"
#include "collision/lp/relative_pose.hpp"

namespace carpus::collision {

/// The vertices of a pair that face each other along a separating direction; remembered by the
/// pair, to begin with at the next pose.
class FacingCorners {
 public:
  /// To be called where a proof was found by other means.
  void forget() noexcept { has_second_ = has_first_ = false; }

  /// Keeps the proof's direction n in the first body's frame, turns the other half-space to the
  /// pose, and measures the second body's reach; the first's once for each n. True where that is a
  /// proof again; else the proof is unchanged.
  /// @param proof  of another pose of the pair.
  [[nodiscard]] bool turn(const SupportGraph& first,
                          const SupportGraph& second,
                          const RelativePose& pose,
                          double second_radius_mm,
                          SeparationProof& proof) noexcept;

 private:
  std::uint32_t second_ = 0;
  bool has_first_ = false;
  bool has_second_ = false;
};

}  // namespace carpus::collision
