// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/detail/possible_state.hpp"

#include <algorithm>
#include <cstdint>

#include "procedure/aid.hpp"
#include "procedure/shots.hpp"
#include "simulation/c_arm_angles.hpp"
#include "simulation/detail/bodies.hpp"
#include "simulation/recording.hpp"
#include "simulation/world.hpp"

namespace carpus::simulation::detail {
namespace {

/// A hand's wish lies within 1 m of the CT's origin and moves at 350 mm/s; nothing else is larger.
constexpr double kGreatest = 1e5;
/// Rounding of a unit vector is far less.
constexpr double kUnitTolerance = 1e-6;
/// From one end of the wrist's motion to the other a carpal bone's centre goes less far [mm].
constexpr double kCarriedMm = 200.0;

bool is_in(std::uint8_t index, std::size_t count) noexcept { return index == 255 || index < count; }

bool is_near(double value) noexcept { return absolute(value) <= kGreatest; }
bool is_near(const Vec3& v) noexcept { return is_near(v.x) && is_near(v.y) && is_near(v.z); }
bool is_unit(const Vec3& v) noexcept {
  return absolute(squared_length(v) - 1.0) <= 2 * kUnitTolerance;
}
bool is_unit_or_none(const Vec3& v) noexcept { return v == Vec3{} || is_unit(v); }

bool is_line_possible(const Item& item, std::size_t bodies) noexcept {
  if (!item.is_fixed()) return true;
  if (item.crossing_count > kMaxCrossings) return false;
  for (std::size_t c = 0; c < item.crossing_count; ++c) {
    if (item.crossings[c].body >= bodies || !is_near(item.crossings[c].at_mm)) return false;
  }
  return is_unit(item.direction_in_bone) && is_near(item.origin_in_bone) &&
         is_near(item.travel_mm) && is_near(item.entry_at_mm) && is_near(item.chord_mm) &&
         is_near(item.cut_to_mm) && item.length_mm >= 0.0 && is_near(item.length_mm) &&
         item.bend_rad >= 0.0 && is_near(item.bend_rad) && is_unit_or_none(item.bend_in_bone) &&
         (item.bend_rad == 0.0 || is_unit(item.bend_in_bone)) && is_in(item.press.body, bodies) &&
         item.press.lever_mm >= 0.0 && is_near(item.press.lever_mm) &&
         is_near(item.press.point_in_bone) && is_unit_or_none(item.press.normal_in_bone) &&
         (item.press.body == kNoBody || item.press.lever_mm > 0.0);
}

bool is_item_possible(std::uint8_t index,
                      const Operated& now,
                      const Spent& spent,
                      const StateBounds& bounds) noexcept {
  const Item& item = now.items[index];
  if (!is_in(item.instrument, bounds.instruments)) return false;
  if (!item.is_there()) return true;
  const std::size_t passes = std::min<std::size_t>(spent.pass_count, kMaxPasses);
  const bool is_known = is_in(item.hand, kHands) && is_in(item.body, bounds.bodies) &&
                        is_in(item.wire, kMaxItems) && item.wire != index &&
                        is_in(item.hole, now.hole_count) && is_in(item.pass, passes) &&
                        item.crossing_count <= kMaxCrossings;
  if (!is_known || !is_near(item.tip) || !is_unit(item.shaft)) return false;
  if (!is_line_possible(item, bounds.bodies)) return false;
  if (item.hand < kHands && now.held[item.hand] != index) return false;
  if (item.wire == kNoItem) return true;
  const Item& wire = now.items[item.wire];
  return wire.is_there() && wire.is_fixed() && wire.wire == kNoItem && item.is_fixed();
}

bool is_turn(const Displacement& moved) noexcept {
  const double size = moved.w * moved.w + squared_length(moved.turn);
  return absolute(size - 1.0) <= kUnitTolerance;
}

/// A turn about the scan's origin shifts what lies far from it by much: what counts is its centre.
bool takes_no_farther(const Displacement& moved, const Vec3& centre, double mm) noexcept {
  const Vec3 way = (moved.pose() * Point<frame::Bone>{centre}).v - centre;
  return squared_length(way) <= mm * mm;
}

/// What no push moves is where the wrist's motion takes it; a fragment goes as far as its gap lets
/// it.
bool are_displacements_possible(const Operated& now, const StateBounds& bounds) noexcept {
  for (std::uint8_t b = 0; b < kMaxBodies; ++b) {
    const Displacement& moved = now.moved[b];
    if (moved.is_none()) continue;
    const bool is_fragment = b < bounds.bodies && (bounds.fragments & bit_of(b)) != 0;
    if (!is_fragment || !is_turn(moved) ||
        squared_length(moved.turn) > kGreatestTurn * kGreatestTurn ||
        !takes_no_farther(moved, bounds.centres[b], kGreatestShiftMm)) {
      return false;
    }
  }
  if (now.carried.is_none()) return true;
  if (bounds.target == 0 || !is_turn(now.carried)) return false;
  return takes_no_farther(now.carried, bounds.centres[first_of(bounds.target)], kCarriedMm);
}

bool is_hand_possible(const HandState& hand, const StateBounds& bounds) noexcept {
  const HandInput& wish = hand.wish;
  const HandPlan& plan = hand.plan;
  return wish.driver <= Driver::Reverse && wish.guidance <= Guidance::Planned &&
         plan.phase <= HandPhase::Lowering && is_in(hand.touched_body, bounds.bodies) &&
         wish.thrust_n >= 0.0 && is_near(wish.thrust_n) && is_near(wish.tip_in_patient) &&
         is_unit(wish.shaft_in_patient) && is_near(plan.tip) && is_unit(plan.shaft) &&
         is_near(plan.tip_velocity) && is_near(plan.shaft_velocity) && is_near(plan.last_wish) &&
         is_near(plan.lifted) && is_unit_or_none(hand.contact_normal);
}

bool are_tracks_possible(const Operated& now, std::size_t bodies) noexcept {
  if (now.track_count > kMaxTracks) return false;
  for (std::size_t i = 0; i < now.track_count; ++i) {
    const TrackView& track = now.tracks[i];
    const bool is_known = track.body < bodies && is_in(now.track_hole[i], now.hole_count);
    if (!is_known || !is_near(track.from_in_bone) || !is_near(track.to_in_bone) ||
        !(track.from_radius_mm >= 0.0) || !is_near(track.from_radius_mm) ||
        !(track.to_radius_mm >= 0.0) || !is_near(track.to_radius_mm)) {
      return false;
    }
  }
  return true;
}

bool are_passes_possible(const Spent& spent, const StateBounds& bounds) noexcept {
  const std::size_t kept = std::min<std::size_t>(spent.pass_count, kMaxPasses);
  for (std::size_t i = 0; i < kept; ++i) {
    const PassState& pass = spent.passes[i];
    if (pass.instrument >= bounds.instruments || pass.first_body >= bounds.bodies ||
        !is_near(pass.far_exit_mm) || !is_near(pass.follower_exit_mm) ||
        !is_near(pass.shortest_exit_mm)) {
      return false;
    }
  }
  return true;
}

bool are_counts_possible(const Operated& now, const Spent& spent, std::size_t steps) noexcept {
  if (spent.tick > kMaxRecordedTicks || spent.shot_count > kMaxShots) return false;
  // While the pedal is down a look is on record, begun at a tick that was.
  const bool is_live_possible =
      spent.live_ticks == 0 || (spent.shot_count > 0 && spent.live_look <= spent.looks);
  if (!is_live_possible || spent.live_ticks > spent.tick) return false;
  if (spent.judgement > procedure::Judgement::Displaced || !is_near(spent.unheld_ream_mm)) {
    return false;
  }
  for (const Tick tick : spent.first_done) {
    if (tick > spent.tick) return false;
  }
  // One command in a tick, one line begun or hole opened by each hand.
  if (spent.undos > spent.tick || spent.aids_used > spent.tick) return false;
  const std::uint64_t hand_ticks = kHands * spent.tick;
  if (spent.pass_count > hand_ticks || now.hole_count > hand_ticks ||
      spent.broken_wires > kMaxItems * spent.tick || spent.stripped_screws > hand_ticks) {
    return false;
  }
  for (const std::uint16_t shots : now.shots_at_completion) {
    if (shots > spent.shot_count) return false;
  }
  return steps >= 32 || now.completed_steps >> steps == 0;
}

bool are_held_items_possible(const Operated& now) noexcept {
  for (std::uint8_t h = 0; h < kHands; ++h) {
    const std::uint8_t held = now.held[h];
    if (!is_in(held, kMaxItems)) return false;
    if (held < kMaxItems && (!now.items[held].is_there() || now.items[held].hand != h)) {
      return false;
    }
  }
  return true;
}

/// Each within its interval. Between two poses of the envelope a wrist may pass without it.
bool is_wrist_possible(const WristPose& wrist, const anatomy::HandLimits& limits) noexcept {
  return limits.flexion_rad.clamp(wrist.flexion_rad) == wrist.flexion_rad &&
         limits.radial_deviation_rad.clamp(wrist.radial_deviation_rad) ==
             wrist.radial_deviation_rad &&
         limits.pronation_rad.clamp(wrist.pronation_rad) == wrist.pronation_rad &&
         limits.traction_n.clamp(wrist.traction_n) == wrist.traction_n;
}

}  // namespace

bool is_possible(const Operated& now, const Spent& spent, const StateBounds& bounds) noexcept {
  for (std::uint8_t i = 0; i < kMaxItems; ++i) {
    if (!is_item_possible(i, now, spent, bounds)) return false;
  }
  for (const HandState& hand : spent.hands) {
    if (!is_hand_possible(hand, bounds)) return false;
  }
  if (!are_displacements_possible(now, bounds)) return false;
  if (spent.ended != 0 && (spent.ended & 1U) == 0) return false;
  if (spent.tube >= procedure::kTubeSettings || spent.aids >> procedure::kAidCount != 0)
    return false;
  return are_held_items_possible(now) && are_tracks_possible(now, bounds.bodies) &&
         are_passes_possible(spent, bounds) && are_counts_possible(now, spent, bounds.steps) &&
         is_near(now.gauge_reading_mm) && is_near(now.reamed_mm) && is_near(now.holding_share) &&
         now.closure_mm >= 0.0 && is_near(now.closure_mm) && now.compression_n >= 0.0 &&
         is_near(now.compression_n) && is_wrist_possible(spent.wrist, bounds.wrist) &&
         can_stand(spent.c_arm.rotation_deg, spent.c_arm.tilt_deg);
}

bool are_possible(std::span<const procedure::Shot> shots, const Spent& spent) noexcept {
  std::uint64_t looks = 0;
  std::uint64_t pulses = 0;
  std::uint64_t dose_units = 0;
  Tick before = 0;
  for (const procedure::Shot& shot : shots) {
    if (shot.look > procedure::Look::LiveOn || shot.tick < before || shot.tick > spent.tick ||
        !is_near(shot.rotation_deg) || !is_near(shot.tilt_deg)) {
      return false;
    }
    before = shot.tick;
    looks += shot.look == procedure::Look::LiveOn ? 0 : 1;
    if (shot.tube >= procedure::kTubeSettings) return false;
    pulses += shot.pulses;
    dose_units += procedure::dose_units_of(shot);
  }
  return looks == spent.looks && pulses == spent.pulses && dose_units == spent.dose_units;
}

}  // namespace carpus::simulation::detail
