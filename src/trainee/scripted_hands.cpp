// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the hands of a scripted trainee do in each phase; scripted_trainee.cpp is what it thinks.
#include <algorithm>
#include <cstdint>

#include "trainee/detail/hand_commands.hpp"
#include "trainee/scripted_trainee.hpp"

namespace carpus::trainee {
namespace {

using detail::kind_of;
using detail::kWristTicks;
using detail::of_hand;
using detail::take;
using instruments::InstrumentIndex;
using instruments::Work;
using simulation::CommandKind;
using simulation::Driver;
using simulation::HandInput;
using simulation::Input;
using simulation::ItemView;
using simulation::Snapshot;

constexpr double kGreatestPushN = 58.0;

}  // namespace

/// Lets go, and takes the wire at its other end.
void ScriptedTrainee::take_end(CommandKind end, Phase next, const Snapshot& now, Input& input) {
  constexpr Tick kLetGoAt = 1;
  constexpr Tick kTakeAt = 600;
  if (in_phase_ == kLetGoAt) {
    taken_item_ = now.hands[0].item;
    input.command = of_hand(CommandKind::PutDown, 0);
  }
  if (in_phase_ == kTakeAt) {
    input.command = of_hand(end, 0);
    input.command.index = taken_item_;
  }
  if (in_phase_ <= kTakeAt + 1) return;
  // Where it could not be taken there, it is taken where it went in, and the operation goes on.
  if (held(now).instrument == instruments::kNoInstrument) {
    input.command = of_hand(CommandKind::PickUp, 0);
    input.command.index = taken_item_;
    next = Phase::DrawBack;
  }
  enter(next, now);
}

void ScriptedTrainee::draw_through(const Snapshot& now, Input& input) {
  constexpr double kThrustN = 30.0;
  HandInput& hand = input.hands[0];
  hand.thrust_n = kThrustN;
  switch (phase_) {
    case Phase::DriveThrough:
    case Phase::PushBack:
    case Phase::HoldWire:
      hand.driver = Driver::Forward;
      lean(held(now).depth_mm);
      hand.thrust_n = std::min(kGreatestPushN, kThrustN + lean_n_);
      if (phase_ == Phase::PushBack) wrist_ = opening_.wrist;
      return;
    case Phase::TakeFarEnd:
      return take_end(CommandKind::PickUpFarEnd, Phase::DrawThrough, now, input);
    case Phase::TakeNearEnd:
      return take_end(CommandKind::PickUp, Phase::DrawBack, now, input);
    case Phase::DrawThrough:
    case Phase::DrawBack:
      hand.driver = Driver::Reverse;
      return;
    case Phase::LookExtended:
      if (in_phase_ > kWristTicks && shoot(input)) {
        wrist_ = opening_.wrist;
        if (in_phase_ > 2 * kWristTicks) enter(Phase::PushBack, now);
      }
      return;
    default:
      return;
  }
}

void ScriptedTrainee::drill(const Snapshot& now, Input& input) {
  HandInput& hand = input.hands[0];
  const ItemView wire = held(now);
  hand.driver = Driver::Forward;
  lean(wire.depth_mm);
  hand.thrust_n = std::min(kGreatestPushN, thrust_n_ + lean_n_);
  if (phase_ != Phase::Drive || !wire.in_target || wire.depth_mm <= 0.5) return;
  if (stop_depth_mm_ < 0) {  // how far to go on this line, as read off the pictures
    stop_depth_mm_ = std::max(8.0, true_chord(now, wire) - draw(profile_.stop_before_far_mm));
  }
  // Slower near the end, and just enough push to go on.
  if (stop_depth_mm_ - wire.depth_mm < 2.0) {
    hand.thrust_n = std::min(hand.thrust_n, now.hands[0].resistance_n + 4.0 + lean_n_);
  }
}

/// Where nothing moves for a while, the hand pushes harder; once it moves, it eases off.
void ScriptedTrainee::lean(double depth_mm) {
  constexpr Tick kPatience = 200;
  constexpr double kMovedMm = 0.05;
  constexpr double kMoreN = 4.0;
  if (in_phase_ % kPatience != 0) return;
  if (depth_mm - last_depth_mm_ < kMovedMm) {
    lean_n_ = std::min(lean_n_ + kMoreN, kGreatestPushN);
  } else {
    lean_n_ = std::max(0.0, lean_n_ - kMoreN);
  }
  last_depth_mm_ = depth_mm;
}

/// The second hand takes the gauge, reads it on the wire and puts it down again.
void ScriptedTrainee::measure(const Snapshot& now, Input& input) {
  constexpr Tick kTakeAt = 100;
  constexpr Tick kReadAt = 900;
  constexpr Tick kPutDownAt = 1500;
  constexpr Tick kDoneAt = 1800;
  if (in_phase_ == kTakeAt) input.command = take(1, gauge_);
  if (in_phase_ == kReadAt) input.command = of_hand(CommandKind::ReadGauge, 1);
  if (in_phase_ == kPutDownAt) input.command = of_hand(CommandKind::PutDown, 1);
  if (in_phase_ < kDoneAt) return;
  enter(drill_ == instruments::kNoInstrument ? Phase::Choose
        : is_drawn_through_                  ? Phase::HoldWire
                                             : Phase::Ream,
        now);
}

void ScriptedTrainee::ream(const Snapshot& now, Input& input) {
  constexpr double kThrustN = 24.0;
  constexpr Tick kTakeAt = 1;
  if (in_phase_ == kTakeAt) {
    input.command = take(0, drill_);
    return;
  }
  HandInput& hand = input.hands[0];
  if (held(now).instrument != drill_) {  // it did not go over the wire
    enter(Phase::Choose, now);
    return;
  }
  hand.driver = Driver::Forward;
  lean(held(now).depth_mm);
  hand.thrust_n = std::min(kGreatestPushN, kThrustN + lean_n_);
}

/// The longest screw that is shorter than measured by what this trainee takes off, the first of
/// equals; the shortest where none is.
void ScriptedTrainee::choose_screw(const Snapshot& now, Input& input) {
  const double measured = now.gauge_reading_mm > 0 ? now.gauge_reading_mm : held(now).depth_mm;
  InstrumentIndex best = instruments::kNoInstrument;
  InstrumentIndex shortest = instruments::kNoInstrument;
  for (const InstrumentIndex index : procedure_.tray) {
    if (kind_of(index).work != Work::Thread) continue;
    const double length = kind_of(index).length_mm;
    if (shortest == instruments::kNoInstrument || length < kind_of(shortest).length_mm) {
      shortest = index;
    }
    if (length <= measured - profile_.screw_deduction_mm &&
        (best == instruments::kNoInstrument || length > kind_of(best).length_mm)) {
      best = index;
    }
  }
  input.command = take(0, best != instruments::kNoInstrument ? best : shortest);
}

void ScriptedTrainee::insert(const Snapshot& now, Input& input) {
  constexpr double kThrustN = 22.0;
  const ItemView screw = held(now);
  if (screw.instrument >= instruments::catalogue().size() ||
      kind_of(screw.instrument).work != Work::Thread) {
    enter(Phase::Finish, now);
    return;
  }
  HandInput& hand = input.hands[0];
  hand.driver = Driver::Forward;
  lean(screw.depth_mm);
  hand.thrust_n = std::min(kGreatestPushN, kThrustN + lean_n_);
  if (bury_mm_ - screw.buried_mm < 1.5) {
    hand.thrust_n = std::min(hand.thrust_n, now.hands[0].resistance_n + 4.0 + lean_n_);
  }
}

/// Takes hold of the wire that is left in the bone; where there is none, goes on.
void ScriptedTrainee::take_wire(const Snapshot& now, Input& input) {
  for (std::uint8_t i = 0; i < simulation::kMaxItems; ++i) {
    const ItemView& item = now.items[i];
    if (item.instrument >= instruments::catalogue().size() || !item.in_target ||
        !item.near_end_is_out || kind_of(item.instrument).work != Work::Drill) {
      continue;
    }
    input.command = of_hand(CommandKind::PickUp, 0);
    input.command.index = i;
    enter(Phase::DrawWire, now);
    return;
  }
  enter(Phase::Finish, now);
}

/// The second hand keeps beside the first.
HandPose ScriptedTrainee::second_hand() const {
  constexpr double kBesideMm = 60.0;
  return {hand_.tip + hand_.shaft * kBesideMm, hand_.shaft};
}

/// What the hand does in this phase, once it has reacted.
void ScriptedTrainee::act(const Snapshot& now, Input& input) {
  switch (phase_) {
    case Phase::Survey:
    case Phase::LookReduced:
      return look_at_bone(now, input);
    case Phase::Reduce:
      if (reducing_.next(now, input)) enter(Phase::LookReduced, now);
      return;
    case Phase::FreeFragment:
      if (reducing_.next(now, input)) enter(after_freeing_, now);
      return;
    case Phase::PlaceSleeve:
      if (sleeve_.next(now, input) && move_.is_over(in_move_)) enter(Phase::GoToStandoff, now);
      return;
    case Phase::PutSleeveDown:
      sleeve_.put_down(input);
      enter(after_sleeve_, now);
      return;
    case Phase::Engage:
    case Phase::Drive:
      return drill(now, input);
    case Phase::Check:
      if (shoot(input)) enter(Phase::Judge, now);
      return;
    case Phase::DriveThrough:
    case Phase::TakeFarEnd:
    case Phase::DrawThrough:
    case Phase::LookExtended:
    case Phase::PushBack:
    case Phase::TakeNearEnd:
    case Phase::DrawBack:
    case Phase::HoldWire:
      return draw_through(now, input);
    case Phase::Withdraw:
    case Phase::DrillOut:
    case Phase::DrawWire:
      input.hands[0].driver = Driver::Reverse;
      return;
    case Phase::Measure:
      return measure(now, input);
    case Phase::Ream:
      return ream(now, input);
    case Phase::Choose:
      choose_screw(now, input);
      enter(Phase::Insert, now);
      return;
    case Phase::Insert:
      return insert(now, input);
    case Phase::LetGo:
      input.command = of_hand(CommandKind::PutDown, 0);
      enter(Phase::TakeWire, now);
      return;
    case Phase::TakeWire:
      return take_wire(now, input);
    case Phase::Verify:
      if (shoot(input)) enter(Phase::LetGo, now);
      return;
    case Phase::Finish:
      input.command = of_hand(CommandKind::Finish, 0);
      phase_ = Phase::Done;
      return;
    default:
      return;
  }
}

}  // namespace carpus::trainee
