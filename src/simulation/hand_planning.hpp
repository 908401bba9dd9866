// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How a wish becomes a hand's motion: a pointer jumps, a hand does not. Short ways are followed
// straight, so that a tip slides along bone; farther ones are lifted off it, crossed above and
// lowered, at a hand's speed, with a hand's acceleration. Every tick, so it uses only + - * / and
// sqrt, and its state is plain data that is recorded with the world's.
#pragma once

#include <cstdint>
#include <type_traits>

#include "geometry/vec3.hpp"
#include "simulation/input.hpp"

namespace carpus::simulation {

/// A hand moves at most this fast. [E]
inline constexpr double kHandMmPerS = 350.0;
/// ... and speeds up and slows down at most so fast: 0.6 g. [E]
inline constexpr double kHandMmPerS2 = 6000.0;
/// The wrist that holds an instrument turns it at most this fast. [E]
inline constexpr double kHandRadPerS = 5.0;
inline constexpr double kHandRadPerS2 = 60.0;
/// A wish that jumps farther than this is another place, to be reached over the bone. [E]
inline constexpr double kSlideMm = 4.0;
/// By so much, along the shaft: over the highest rim of a wrist's bones. [E]
inline constexpr double kLiftMm = 18.0;

/// Where a hand is on its way.
enum class HandPhase : std::uint8_t { Following = 0, Lifting = 1, Crossing = 2, Lowering = 3 };

struct HandPlan {
  HandPhase phase = HandPhase::Following;
  Vec3 tip;             ///< where the hand holds the instrument's tip now [mm]
  Vec3 shaft{0, 0, 1};  ///< unit, from the tip towards the hand
  Vec3 tip_velocity;    ///< [mm/s]
  Vec3 shaft_velocity;  ///< of the unit vector [1/s]
  Vec3 last_wish;       ///< tip of the newest wish [mm]
  Vec3 lifted;          ///< way point over where the flight began [mm]
  bool operator==(const HandPlan&) const = default;
};
static_assert(std::is_trivially_copyable_v<HandPlan>);

/// Names its fields once, for hashing, writing and reading a state.
template <typename SomePlan, typename Visitor>
  requires std::is_same_v<std::remove_const_t<SomePlan>, HandPlan>
void visit(SomePlan& plan, Visitor&& v) noexcept {
  v(plan.phase);
  v(plan.tip);
  v(plan.shaft);
  v(plan.tip_velocity);
  v(plan.shaft_velocity);
  v(plan.last_wish);
  v(plan.lifted);
}

/// At rest there: at the beginning, and whenever the instrument is put somewhere else (undo).
/// @param shaft  unit.
[[nodiscard]] HandPlan resting_at(const Vec3& tip_in_patient, const Vec3& shaft) noexcept;

/// Moves the hand on by one tick. Direct guidance is followed as it is.
/// @param wish     finite; its shaft need not be normalised.
/// @param is_free  false while what it holds is fixed in bone: then nothing is lifted.
void advance(HandPlan& plan, const HandInput& wish, bool is_free) noexcept;

}  // namespace carpus::simulation
