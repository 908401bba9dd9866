// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Each tick the velocity is drawn towards the one that leads to the next way point and still lets
// the hand stop there; by no more than the acceleration allows. Way points are left before they are
// reached, so corners are round.
#include "simulation/hand_planning.hpp"

#include <cmath>

#include "core/units.hpp"

namespace carpus::simulation {

namespace {

constexpr double kTickS = 0.001;
/// So near to the point above its start the hand begins to cross ...
constexpr double kLiftedMm = 6.0;
/// ... and so near to the point above its goal to come down.
constexpr double kCrossedMm = 1.0;

struct Limits {
  double speed;         ///< [1/s]
  double acceleration;  ///< [1/s2]
};
constexpr Limits kTipLimits{kHandMmPerS, kHandMmPerS2};
constexpr Limits kShaftLimits{kHandRadPerS, kHandRadPerS2};

/// What stopping may use of the acceleration: the rest keeps the way straight.
constexpr double kBraking = 0.7;

/// The greatest speed from which ticks of constant deceleration stop within `far`: after n ticks
/// they have covered a t^2 n (n + 1) / 2. Nearer than one such tick, the one that lands there.
double stopping_speed(double far, const Limits& limits) noexcept {
  const double step = kBraking * limits.acceleration * kTickS;
  const double ticks = std::sqrt(0.25 + 2.0 * far / (step * kTickS)) - 0.5;
  const double speed = ticks * step;
  const double landing = far / kTickS;
  const double slower = speed < landing ? speed : landing;
  return slower < limits.speed ? slower : limits.speed;
}

/// One tick of a point on its way to `goal`.
void approach(Vec3& point, Vec3& velocity, const Vec3& goal, const Limits& limits) noexcept {
  const Vec3 ahead = goal - point;
  const double far = length(ahead);
  const Vec3 wanted = far > 0.0 ? ahead * (stopping_speed(far, limits) / far) : Vec3{};
  const Vec3 change = wanted - velocity;
  const double size = length(change);
  const double most = limits.acceleration * kTickS;
  if (size > most) {
    velocity += change * (most / size);
    point += velocity * kTickS;
    return;
  }
  velocity = wanted;
  // Not by way of the velocity, whose rounding would leave the hand beside its goal.
  const bool lands = far <= length(wanted) * kTickS * (1.0 + 1e-9);
  point = lands ? goal : point + velocity * kTickS;
}

void turn(HandPlan& plan, const Vec3& goal) noexcept {
  Vec3 wanted = goal;
  // Opposite directions have no way between them: leave by any perpendicular.
  if (dot(plan.shaft, goal) < -0.99) wanted = any_perpendicular(plan.shaft);
  approach(plan.shaft, plan.shaft_velocity, wanted, kShaftLimits);
  plan.shaft = plan.shaft == goal ? goal : normalized_or(plan.shaft, goal);
  // What would change its length is no turning.
  plan.shaft_velocity -= plan.shaft * dot(plan.shaft_velocity, plan.shaft);
}

void begin_flight(HandPlan& plan) noexcept {
  if (plan.phase == HandPhase::Lifting) return;
  if (plan.phase != HandPhase::Following) {  // above the bone already
    plan.phase = HandPhase::Crossing;
    return;
  }
  plan.lifted = plan.tip + plan.shaft * kLiftMm;
  plan.phase = HandPhase::Lifting;
}

}  // namespace

HandPlan resting_at(const Vec3& tip_in_patient, const Vec3& shaft) noexcept {
  HandPlan plan;
  plan.tip = tip_in_patient;
  plan.shaft = shaft;
  plan.last_wish = tip_in_patient;
  return plan;
}

void advance(HandPlan& plan, const HandInput& wish, bool is_free) noexcept {
  const Vec3 shaft = normalized_or(wish.shaft_in_patient, plan.shaft);
  if (wish.guidance == Guidance::Direct) {
    plan = resting_at(wish.tip_in_patient, shaft);
    return;
  }
  if (!is_free) {
    plan.phase = HandPhase::Following;
  } else if (distance(wish.tip_in_patient, plan.last_wish) > kSlideMm) {
    begin_flight(plan);
  }
  plan.last_wish = wish.tip_in_patient;
  const Vec3 above = wish.tip_in_patient + shaft * kLiftMm;
  if (plan.phase == HandPhase::Lifting && distance(plan.tip, plan.lifted) < kLiftedMm) {
    plan.phase = HandPhase::Crossing;
  }
  if (plan.phase == HandPhase::Crossing && distance(plan.tip, above) < kCrossedMm) {
    plan.phase = HandPhase::Lowering;
  }
  if (plan.phase == HandPhase::Lowering && plan.tip == wish.tip_in_patient) {
    plan.phase = HandPhase::Following;
  }
  const Vec3 goal = plan.phase == HandPhase::Lifting
                        ? plan.lifted
                        : (plan.phase == HandPhase::Crossing ? above : wish.tip_in_patient);
  approach(plan.tip, plan.tip_velocity, goal, kTipLimits);
  turn(plan, shaft);
}

}  // namespace carpus::simulation
