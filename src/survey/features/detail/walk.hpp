// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Runs the steps of a method that walks from one pair of features to the next, and sees to it that
// this ends.
#pragma once

#include <optional>

#include "convex/features/edge_face.hpp"
#include "convex/features/feature_pair.hpp"
#include "convex/features/placement.hpp"
#include "convex/pair_query.hpp"
#include "geometry/tolerance.hpp"

namespace carpus::survey::detail {

struct WalkEnd {
  enum class Kind : std::uint8_t {
    Apart,
    Overlap,
    Cycle,  ///< a pair came back: the next step is a function of the pair, so nothing else
            ///< would ever come
    OutOfSteps,
  };
  Kind kind = Kind::OutOfSteps;
  unsigned steps = 0;
};

/// A walk gets no longer than this; over a body of two thousand faces it takes about a hundred.
inline constexpr unsigned kMaxSteps = 2000;

/// @param step  Step(FixedBody, MovedBody, FeaturePair&), a function of the pair.
/// A pair that comes back is found by Brent's method: compare with one kept pair, which is renewed
/// at every power of two [brent1980improved].
template <typename StepFunction>
[[nodiscard]] WalkEnd walk(const convex::FixedBody& first,
                           const convex::MovedBody& second,
                           convex::FeaturePair& pair,
                           unsigned max_steps,
                           StepFunction step) noexcept {
  convex::FeaturePair kept = pair;
  unsigned renew_at = 16;
  for (unsigned steps = 1; steps <= max_steps; ++steps) {
    const convex::Step found = step(first, second, pair);
    if (found == convex::Step::Apart) return {WalkEnd::Kind::Apart, steps};
    if (found == convex::Step::Overlap) return {WalkEnd::Kind::Overlap, steps};
    if (pair == kept) return {WalkEnd::Kind::Cycle, steps};
    if (steps == renew_at) {
      kept = pair;
      renew_at *= 2;
    }
  }
  return {WalkEnd::Kind::OutOfSteps, max_steps};
}

/// Nearest points may be this much farther apart than the bodies: rounding of some 1e-14 mm in the
/// vertices of bodies 100 mm wide, with room for flat corners; a tenth of kContactToleranceMm.
inline constexpr double kProofToleranceMm = 1e-10;

/// Whether the foot of a vertex lies on the face it is paired with; true for other pairs.
[[nodiscard]] inline bool foot_is_on_face(const convex::FixedBody& first,
                                          const convex::MovedBody& second,
                                          const convex::FeaturePair& pair) noexcept {
  if (pair.second.kind == convex::FeatureKind::Face) {
    return pair.first.kind == convex::FeatureKind::Vertex &&
           !convex::leave_face(second, pair.second.id, first.vertex(pair.first.id));
  }
  if (pair.first.kind == convex::FeatureKind::Face) {
    return pair.second.kind == convex::FeatureKind::Vertex &&
           !convex::leave_face(first, pair.first.id, second.vertex(pair.second.id));
  }
  return true;
}

/// After a cycle: goes around once more and takes the nearest of its pairs, if climbing to the
/// extreme vertices along its normal proves that nothing is nearer: ties between parallel features,
/// decided by rounding, lead into cycles among pairs that are all as near. Else leaves `pair` at
/// these extreme vertices: a tie may have hidden the way on, and they lie beyond it.
template <typename StepFunction>
[[nodiscard]] std::optional<convex::Closest> closest_of_cycle(const convex::FixedBody& first,
                                                              const convex::MovedBody& second,
                                                              convex::FeaturePair& pair,
                                                              StepFunction step) noexcept {
  const convex::FeaturePair start = pair;
  convex::FeaturePair at = pair;
  std::optional<convex::Closest> best;
  for (unsigned steps = 0; steps < kMaxSteps; ++steps) {
    std::optional<convex::Closest> here;
    if (foot_is_on_face(first, second, at)) here = closest_of(first, second, at);
    if (here && (!best || here->distance_mm < best->distance_mm)) {
      best = here;
      pair = at;
    }
    if (step(first, second, at) != convex::Step::Continue || at == start) break;
  }
  if (!best || best->distance_mm <= kContactToleranceMm) return best;
  const convex::GapAlong proof = convex::gap_along(first, second, pair, best->normal);
  if (best->distance_mm - proof.gap_mm <= kProofToleranceMm) return best;
  pair = proof.extremes;
  return std::nullopt;
}

/// What a walk is worth.
struct WalkAnswer {
  WalkEnd::Kind kind = WalkEnd::Kind::OutOfSteps;
  std::optional<convex::Closest>
      closest;  ///< where the kind is Apart; at most kContactToleranceMm: touching
};

/// So many cycles are left by their extreme vertices; one has always been enough in tests.
inline constexpr unsigned kMaxEscapes = 4;

/// From the end of a walk to its answer, with further walks out of cycles.
template <typename StepFunction>
[[nodiscard]] WalkAnswer answer_of(const convex::FixedBody& first,
                                   const convex::MovedBody& second,
                                   convex::FeaturePair& pair,
                                   WalkEnd end,
                                   StepFunction step) noexcept {
  for (unsigned escapes = 0; end.kind == WalkEnd::Kind::Cycle && escapes < kMaxEscapes; ++escapes) {
    if (std::optional<convex::Closest> closest = closest_of_cycle(first, second, pair, step)) {
      return {WalkEnd::Kind::Apart, closest};
    }
    end = walk(first, second, pair, kMaxSteps, step);
  }
  WalkAnswer answer{end.kind, std::nullopt};
  if (end.kind == WalkEnd::Kind::Apart) answer.closest = closest_of(first, second, pair);
  return answer;
}

}  // namespace carpus::survey::detail
