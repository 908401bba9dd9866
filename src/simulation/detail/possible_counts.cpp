// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/detail/possible_counts.hpp"

#include <algorithm>
#include <cstdint>

namespace carpus::simulation::detail {
namespace {

/// What is counted hand by hand: each adds at most one in a tick.
std::uint64_t hand_ticks(Tick now) noexcept { return kHands * now; }

/// Of what is asked in turn, one of so many in a tick, and counts for all of them then.
std::uint64_t turn_ticks(Tick now, std::size_t turns) noexcept { return now + turns; }

/// Each of the first `there` for no longer than `most`, none of the others at all.
template <typename Ticks>
bool are_within(const Ticks& ticks, std::size_t there, std::uint64_t most) noexcept {
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    if (ticks[i] > (i < there ? most : 0)) return false;
  }
  return true;
}

}  // namespace

bool are_counts_possible(const ScopeState& state,
                         Tick now,
                         const cases::ArthroscopicMap& map,
                         std::size_t lesions) noexcept {
  std::uint32_t numbers = 0;
  for (const cases::TourPoint& point : map.points) numbers |= 1U << point.number;
  const std::uint64_t seen = state.points_seen | state.points_in_view | state.points_probed;
  // Each hand may hold a scope.
  const std::uint64_t most_in_view = kHands * turn_ticks(now, map.points.size());
  const std::uint64_t most_lesion = kHands * turn_ticks(now, lesions);
  return (seen & ~std::uint64_t{numbers}) == 0 &&
         (state.points_seen == 0 || most_in_view >= kSeenTicks) &&
         are_within(state.in_view_ticks, map.points.size(), most_in_view) &&
         std::uint64_t{state.lesions_seen} >> lesions == 0 &&
         (state.lesions_seen == 0 || most_lesion >= kSeenTicks) &&
         are_within(state.lesion_ticks, lesions, most_lesion) && state.entries <= hand_ticks(now) &&
         (state.pull_outs == 0 || state.pull_outs < state.entries) &&
         state.looking_ticks <= hand_ticks(now) && state.tilted_ticks <= state.looking_ticks &&
         state.warn_ticks <= hand_ticks(now) && state.injury_ticks <= state.warn_ticks &&
         state.look_count <= state.looking_ticks;
}

/// An instrument scuffs by pressing, and besides by biting or shaving.
bool are_counts_possible(const ScopeConduct& conduct, Tick now) noexcept {
  if (conduct.scuffs > 2 * hand_ticks(now) || conduct.capsule_pushes > hand_ticks(now)) {
    return false;
  }
  for (const procedure::SmoothnessFacts& led : conduct.smoothness) {
    if (led.stretches > hand_ticks(now) / kMeanTicks) return false;
  }
  Tick before = 0;
  for (std::size_t i = 0; i < std::min<std::size_t>(conduct.scuffs, kMaxScuffPlaces); ++i) {
    const Tick tick = conduct.places[i].tick;
    if (tick < before || tick > now) return false;
    before = tick;
  }
  return true;
}

bool are_counts_possible(const DrillState& state, Tick now) noexcept {
  const procedure::DrillFacts& done = state.done;
  for (const std::uint32_t count : {state.hold_ticks, state.off_hold_ticks, state.off_line_ticks,
                                    done.hold_breaks, done.wrong_touches, done.line_breaks}) {
    if (count > hand_ticks(now)) return false;
  }
  return true;
}

/// A closing catches, or lets spring away, or bites, or does nothing; what is caught can be lost.
bool are_counts_possible(const LooseState& state, Tick now) noexcept {
  const procedure::LooseFacts& done = state.done;
  const std::uint64_t closings = done.closings;
  return closings <= hand_ticks(now) && done.unseen_closings <= closings &&
         std::uint64_t{done.catches} + done.bites <= closings &&
         std::uint64_t{done.slips} + done.bites <= closings && done.out <= done.catches;
}

bool are_counts_possible(const ShavingState& state, Tick now) noexcept {
  const procedure::ShavingFacts& done = state.done;
  const std::uint64_t most_patch = turn_ticks(now, cases::kMaxPatches);
  return are_within(state.patch_ticks, done.patches, most_patch) &&
         (done.patches_seen == 0 || most_patch >= kSeenTicks) &&
         done.running_ticks <= hand_ticks(now) &&
         std::uint64_t{done.cartilage_ticks} + done.lining_ticks <= done.running_ticks &&
         done.scope_ticks <= done.running_ticks && done.way_ticks <= hand_ticks(now) &&
         done.ticks_since_cut <= now;
}

bool are_counts_possible(const PunchState& state, Tick now) noexcept {
  return state.done.bites <= hand_ticks(now);
}

bool are_counts_possible(const JointFluid& fluid, Tick now) noexcept {
  return fluid.facts.over_limit_ticks <= now && fluid.facts.watched_ticks <= now;
}

bool are_counts_possible(const MakingState& state, Tick now) noexcept {
  for (const UnderSkin& under : state.worked.hands) {
    if (under.ticks > now || under.seen_ticks > now) return false;
  }
  for (const FeltPlace& felt : state.felt) {
    if (felt.ticks > hand_ticks(now)) return false;
  }
  return std::all_of(state.facts.portal.begin(), state.facts.portal.end(),
                     [now](const procedure::PortalMade& made) {
                       return made.needle_seen_ticks <= now && made.passes <= hand_ticks(now) &&
                              made.bone_strikes <= hand_ticks(now) && made.cuts <= hand_ticks(now);
                     });
}

}  // namespace carpus::simulation::detail
