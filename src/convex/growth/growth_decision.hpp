// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// In which order a pair's verdict is looked for, where its last proof does not hold as it is:
// cheapest first, and where bodies are about to touch as soon as it is likely to be of use.
#pragma once

#include "convex/exact_meeting.hpp"
#include "convex/growth/growth_counts.hpp"
#include "convex/growth/growth_memory.hpp"
#include "convex/growth/growth_program.hpp"
#include "convex/growth/proof_body.hpp"
#include "convex/growth/ready_proof.hpp"
#include "convex/growth/touching_features.hpp"
#include "convex/pair_query.hpp"
#include "convex/relative_pose.hpp"

namespace carpus::convex {

/// Both bodies in one frame, as exact arithmetic takes them.
struct PlacedPair {
  PlacedBody first;
  PlacedBody second;
};

/// Where a pair is, as ready proofs and as the program take it.
struct PairPlace {
  const PairPose& pose;
  const RelativePose& relative;
  double slack_mm = 0;  ///< how far any point of the second body may be from where `pose` puts it
};

/// Exact numbers decide.
/// @param hint  in the first body's frame.
template <typename Placed>
[[nodiscard]] Verdict decide_exactly(ExactHint hint,
                                     Placed placed,
                                     ReadyProof& ready,
                                     GrowthCounts& counts) noexcept {
  const PlacedPair pair = placed();
  hint.direction = pair.first.rotation * hint.direction;
  const ExactAnswer answer = exactly_meet(pair.first, pair.second, hint);
  ++counts.exact;
  counts.exact_rounds += answer.rounds;
  ready.set_unknown();
  return answer.verdict;
}

/// Do the last proofs still hold, measured anew by walks? Else Unknown. Bodies about to touch go
/// back and forth, but a last separation is the better bet; one that is new comes after the rows.
[[nodiscard]] inline Verdict walk_last_proofs(const ProofBody& first,
                                              const ProofBody& second,
                                              const PairPose& pose,
                                              double slack_mm,
                                              ReadyProof& ready,
                                              GrowthCounts& counts) noexcept {
  const Verdict last = ready.last();
  if (last == Verdict::Unknown) return last;
  if ((last == Verdict::Meet && ready.meets(first, pose, slack_mm)) ||
      (!ready.is_new() && ready.parts(second, pose, slack_mm))) {
    ++counts.by_walking;
    return ready.last();
  }
  return Verdict::Unknown;
}

/// The pair's verdict, exact for the poses that `placed` gives.
/// After walk_last_proofs().
/// @param placed  PlacedPair(); called where doubles cannot tell.
template <typename Placed>
[[nodiscard]] Verdict decide_pair(const ProofBody& first,
                                  const ProofBody& second,
                                  const PairPlace& place,
                                  Placed placed,
                                  ReadyProof& ready,
                                  GrowthMemory& memory,
                                  GrowthCounts& counts) noexcept {
  const GrowthProgram program(first, second);
  const auto found_apart = [&] {
    ready.set(memory.separation, first, second, place.pose.translation);
    return Verdict::Apart;
  };
  const auto found_common = [&] {
    ready.set(memory.ball, first, second, place.pose.translation);
    return Verdict::Meet;
  };
  const auto touching = [&](const FeaturePair& features) {
    const PlacedPair pair = placed();
    const Verdict verdict = touching_features_meet(pair.first, pair.second, features);
    if (verdict != Verdict::Unknown) {
      ++counts.exact;
      ready.set_unknown();
    }
    return verdict;
  };
  FeaturePair of_rows;

  GrowthLook look = program.look_at_rows(place.relative, memory);
  if (look == GrowthLook::Apart) {
    ++counts.by_last_rows;
    return found_apart();
  }
  if (look == GrowthLook::Touching && program.find_features_of_rows(memory, of_rows)) {
    const Verdict verdict = touching(of_rows);
    if (verdict != Verdict::Unknown) return verdict;
  }
  const Verdict last = ready.last();
  if ((last != Verdict::Unknown && ready.is_new() &&
       ready.parts(second, place.pose, place.slack_mm)) ||
      (last == Verdict::Apart && ready.meets(first, place.pose, place.slack_mm))) {
    ++counts.by_walking;
    return ready.last();
  }
  look = program.look_at_features(place.relative, memory, counts);
  if (look == GrowthLook::Apart) return found_apart();
  if (look == GrowthLook::Meet) return found_common();
  if (look == GrowthLook::Touching) {
    const Verdict verdict = touching(memory.features);
    if (verdict != Verdict::Unknown) return verdict;
  }
  Verdict verdict = program.decide_by_pivots(place.relative, memory, counts);
  if (verdict == Verdict::Apart) return found_apart();
  if (verdict == Verdict::Meet) return found_common();
  if (!program.find_features_of_rows(memory, of_rows)) {
    return decide_exactly({}, placed, ready, counts);
  }
  verdict = touching(of_rows);
  return verdict == Verdict::Unknown
             ? decide_exactly(program.hint_at(memory, of_rows), placed, ready, counts)
             : verdict;
}

}  // namespace carpus::convex
