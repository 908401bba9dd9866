// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The whole changing state of a world but its tissue, as plain data: what undo restores apart from
// what stays spent. Each struct lists its fields once, in visit(); hashing, writing and reading a
// state all go through that list.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "core/units.hpp"
#include "geometry/vec3.hpp"
#include "haptics/virtual_coupling.hpp"
#include "procedure/situation.hpp"
#include "simulation/detail/displacement.hpp"
#include "simulation/hand_planning.hpp"
#include "simulation/snapshot.hpp"

namespace carpus::simulation::detail {

inline constexpr std::uint8_t kNoHole = 255;
inline constexpr std::size_t kMaxPasses = 64;
inline constexpr std::size_t kMaxCheckpoints = 16;
/// Farther from its place ligaments hold a fragment, and turned further than by 45 degrees (sine of
/// half of it) [E].
inline constexpr double kGreatestShiftMm = 5.0;
inline constexpr double kGreatestTurn = 0.383;

/// T, const or not.
template <typename Some, typename T>
concept Is = std::is_same_v<std::remove_const_t<Some>, T>;

/// A body through which an instrument's line now passes.
struct Crossing {
  std::uint8_t body = kNoBody;
  double at_mm = 0.0;  ///< travel at which the tip came in
};
inline constexpr std::size_t kMaxCrossings = 4;

/// Bone that came against what stands out of it.
struct Press {
  std::uint8_t body = kNoBody;
  double lever_mm = 0.0;  ///< of the place on the wire, from the first bone of its line
  Vec3 point_in_bone;     ///< of that body, where it touched
  Vec3 normal_in_bone;    ///< unit, out of it
};

/// An instrument that is out of the tray. While `body` is set its line is fixed in that body:
/// origin + direction * travel, frame Bone; else it is free and lies at tip, shaft.
struct Item {
  InstrumentIndex instrument = kNoInstrument;
  std::uint8_t hand = kNoHand;
  std::uint8_t body = kNoBody;
  std::uint8_t wire = kNoItem;  ///< on which it rides
  std::uint8_t hole = kNoHole;  ///< that it makes: Operated::track_hole
  std::uint8_t pass = 255;      ///< Spent::passes of its line, 255 when they are used up
  bool in_target = false;       ///< it entered the target on this line
  bool has_left = false;        ///< its tip is beyond the target's far surface
  bool told_seated = false;
  bool by_far_end = false;   ///< its hand holds the end that went in first, beyond the bone
  bool is_broken = false;    ///< what stood out where it went in is gone
  bool was_flush = false;    ///< it was drawn through until its near end lay level with the bone
  Vec3 tip;                  ///< frame Patient, after contact [mm]
  Vec3 shaft{0, 0, 1};       ///< unit, towards the hand
  Vec3 origin_in_bone;       ///< where the tip was when the line was fixed
  Vec3 direction_in_bone;    ///< unit, into the bone
  double travel_mm = 0.0;    ///< tip from the origin
  double entry_at_mm = 0.0;  ///< travel at which it entered the target, else the first bone
  double chord_mm = 0.0;     ///< of this line inside the target, gap included
  double cut_to_mm = 0.0;    ///< travel up to which bone was removed
  double length_mm = 0.0;    ///< tip to tail, of what is left
  double bend_rad = 0.0;     ///< by which what stands out where it went in is bent for good …
  Vec3 bend_in_bone;         ///< … this way: unit, across the line; zero while it is straight
  Press press;               ///< that bends it now
  std::uint32_t told_bodies = 0;  ///< wrong bones told of on this line, bit by body
  std::array<Crossing, kMaxCrossings> crossings{};  ///< first `crossing_count`, as they came
  std::uint8_t crossing_count = 0;

  [[nodiscard]] bool is_there() const noexcept { return instrument != kNoInstrument; }
  [[nodiscard]] bool is_fixed() const noexcept { return body != kNoBody; }
  [[nodiscard]] double depth_mm() const noexcept { return travel_mm - entry_at_mm; }
  /// Travel at which it came into the first bone of its line.
  [[nodiscard]] double first_bone_at_mm() const noexcept {
    return crossing_count > 0 && crossings[0].at_mm < entry_at_mm ? crossings[0].at_mm
                                                                  : entry_at_mm;
  }
};

template <Is<Item> SomeItem, typename Visitor>
void visit(SomeItem& item, Visitor&& v) noexcept {
  v(item.instrument);
  v(item.hand);
  v(item.body);
  v(item.wire);
  v(item.hole);
  v(item.pass);
  v(item.in_target);
  v(item.has_left);
  v(item.told_seated);
  v(item.by_far_end);
  v(item.is_broken);
  v(item.was_flush);
  v(item.tip);
  v(item.shaft);
  v(item.origin_in_bone);
  v(item.direction_in_bone);
  v(item.travel_mm);
  v(item.entry_at_mm);
  v(item.chord_mm);
  v(item.cut_to_mm);
  v(item.length_mm);
  v(item.bend_rad);
  v(item.bend_in_bone);
  v(item.press.body);
  v(item.press.lever_mm);
  v(item.press.point_in_bone);
  v(item.press.normal_in_bone);
  v(item.told_bodies);
  v(item.crossing_count);
  for (std::size_t i = 0; i < item.crossing_count && i < kMaxCrossings; ++i) {
    v(item.crossings[i].body);
    v(item.crossings[i].at_mm);
  }
}

/// What an undo brings back, but the tissue, which undoes itself (detail/tissue).
struct Operated {
  std::array<Item, kMaxItems> items{};
  std::array<std::uint8_t, kHands> held{kNoItem, kNoItem};  ///< item in each hand
  std::array<TrackView, kMaxTracks> tracks{};
  std::array<std::uint8_t, kMaxTracks> track_hole{};  ///< a hole has a track in each body it meets
  std::uint8_t track_count = 0;
  std::uint8_t hole_count = 0;
  std::array<Displacement, kMaxBodies> moved{};  ///< of fragments
  Displacement carried;                          ///< of the target, by what it is pinned to
  double gauge_reading_mm = -1.0;
  double reamed_mm = 0.0;
  double holding_share = 1.0;
  double closure_mm = 0.0;     ///< by which the screw would have drawn together what touches
  double compression_n = 0.0;  ///< of the pieces on each other
  bool is_stripped = false;    ///< its thread gave way
  std::uint32_t completed_steps = 0;
  std::array<std::uint16_t, procedure::kMaxSteps> shots_at_completion{};
};
static_assert(std::is_trivially_copyable_v<Operated>);

template <Is<Operated> SomeOperated, typename Visitor>
void visit(SomeOperated& now, Visitor&& v) noexcept {
  for (auto& item : now.items) {
    v(item.instrument);
    if (item.is_there()) visit(item, v);
  }
  for (auto& held : now.held) v(held);
  v(now.track_count);
  v(now.hole_count);
  for (std::size_t i = 0; i < now.track_count && i < kMaxTracks; ++i) {
    auto& track = now.tracks[i];
    v(track.body);
    v(track.from_in_bone);
    v(track.to_in_bone);
    v(track.from_radius_mm);
    v(track.to_radius_mm);
    v(now.track_hole[i]);
  }
  for (auto& moved : now.moved) visit_displacement(moved, v);
  visit_displacement(now.carried, v);
  v(now.gauge_reading_mm);
  v(now.reamed_mm);
  v(now.holding_share);
  v(now.closure_mm);
  v(now.compression_n);
  v(now.is_stripped);
  v(now.completed_steps);
  for (auto& shots : now.shots_at_completion) v(shots);
}

/// One way into bone: procedure::Pass.
struct PassState {
  InstrumentIndex instrument = kNoInstrument;
  std::uint8_t first_body = kNoBody;
  bool was_undone = false;
  std::uint32_t bodies_entered = 0;
  std::uint32_t far_exits = 0;
  double far_exit_mm = 0.0;
  double follower_exit_mm = 0.0;  ///< likewise, of what ran over the wire
  double shortest_exit_mm = 0.0;
};

/// A hand between two ticks.
struct HandState {
  HandInput wish;  ///< newest good input
  HandPlan plan;   ///< on its way there
  bool has_wish = false;
  bool forward_is_held = false;  ///< driver forward since the last tick
  bool reverse_is_held = false;  ///< in reverse since what it held came out: let go first
  bool slip_is_told = false;     ///< since the driver started
  std::uint8_t touched_body = kNoBody;
  Vec3 contact_normal;  ///< frame Patient
  haptics::VirtualCoupling coupling;
};

template <Is<HandState> SomeHand, typename Visitor>
void visit(SomeHand& hand, Visitor&& v) noexcept {
  v(hand.wish.tip_in_patient);
  v(hand.wish.shaft_in_patient);
  v(hand.wish.thrust_n);
  v(hand.wish.driver);
  v(hand.wish.guidance);
  visit(hand.plan, v);
  v(hand.has_wish);
  v(hand.forward_is_held);
  v(hand.reverse_is_held);
  v(hand.slip_is_told);
  v(hand.touched_body);
  v(hand.contact_normal);
  visit_coupling(hand.coupling, v);
}

/// What an undo does not bring back.
struct Spent {
  Tick tick = 0;
  std::uint32_t undos = 0;
  std::uint32_t shot_count = 0;
  std::uint32_t looks = 0;
  std::uint32_t pulses = 0;
  std::uint32_t live_ticks = 0;  ///< since the pedal went down; 0 while it is up
  std::uint32_t live_look = 0;   ///< its number
  CArmInput c_arm;
  /// 0 while it goes on, 1 once finished; declined: besides, bit i + 1 for the procedure's reason
  /// i.
  std::uint8_t ended = 0;
  procedure::TubeSetting tube = procedure::kUsualTube;
  std::uint64_t dose_units = 0;  ///< of all pulses
  std::uint8_t aids = 0;         ///< bit i: procedure::Aid i was used
  std::uint32_t aids_used = 0;
  bool wrist_is_told = false;  ///< that it came to its limit or is held
  WristPose wrist;             ///< as it is held now
  std::array<HandState, kHands> hands{};
  std::array<PassState, kMaxPasses> passes{};
  std::uint32_t pass_count = 0;  ///< may exceed what is kept
  double most_bend_rad = 0.0;    ///< of any wire
  std::uint32_t broken_wires = 0;
  std::uint32_t stripped_screws = 0;  ///< whose thread gave way, undone or not
  double unheld_ream_mm = 0.0;
  procedure::Judgement judgement = procedure::Judgement::None;
  std::array<Tick, procedure::kMaxSteps> first_done{};  ///< by step; 0: never
  std::uint32_t tissue_revision = 0;
  std::uint64_t hash = 0;
};
static_assert(std::is_trivially_copyable_v<Spent>);

template <Is<Spent> SomeSpent, typename Visitor>
void visit(SomeSpent& spent, Visitor&& v) noexcept {
  v(spent.tick);
  v(spent.undos);
  v(spent.shot_count);
  v(spent.looks);
  v(spent.pulses);
  v(spent.live_ticks);
  v(spent.live_look);
  v(spent.c_arm.rotation_deg);
  v(spent.c_arm.tilt_deg);
  v(spent.c_arm.pedal_is_down);
  v(spent.ended);
  v(spent.tube);
  v(spent.dose_units);
  v(spent.aids);
  v(spent.aids_used);
  v(spent.wrist_is_told);
  v(spent.wrist.flexion_rad);
  v(spent.wrist.radial_deviation_rad);
  v(spent.wrist.pronation_rad);
  v(spent.wrist.traction_n);
  for (auto& hand : spent.hands) visit(hand, v);
  v(spent.pass_count);
  for (std::size_t i = 0; i < spent.pass_count && i < kMaxPasses; ++i) {
    auto& pass = spent.passes[i];
    v(pass.instrument);
    v(pass.first_body);
    v(pass.was_undone);
    v(pass.bodies_entered);
    v(pass.far_exits);
    v(pass.far_exit_mm);
    v(pass.follower_exit_mm);
    v(pass.shortest_exit_mm);
  }
  v(spent.most_bend_rad);
  v(spent.broken_wires);
  v(spent.stripped_screws);
  v(spent.unheld_ream_mm);
  v(spent.judgement);
  for (auto& tick : spent.first_done) v(tick);
  v(spent.tissue_revision);
  v(spent.hash);
}

template <typename SomeShot, typename Visitor>
void visit_shot(SomeShot& shot, Visitor&& v) noexcept {
  v(shot.rotation_deg);
  v(shot.tilt_deg);
  v(shot.tick);
  v(shot.shows_wire);
  v(shot.shows_screw);
  v(shot.along_aim);
  v(shot.wrist.flexion_rad);
  v(shot.wrist.radial_deviation_rad);
  v(shot.wrist.pronation_rad);
  v(shot.wrist.traction_n);
  v(shot.look);
  v(shot.pulses);
  v(shot.tube);
}

}  // namespace carpus::simulation::detail
