// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/permission.hpp"

#include "arthroscopy/pathology_table.hpp"

#include <algorithm>
#include <array>

#include "procedure/aid.hpp"
#include "simulation/c_arm_angles.hpp"
#include "simulation/detail/joint_fluid.hpp"
#include "simulation/questions.hpp"
#include "simulation/world.hpp"

namespace carpus::simulation {
namespace {

using procedure::Judgement;

/// A wire bent by more than this lets nothing with a bore run over it [E].
constexpr double kStraightRad = 0.1;

bool rides(const instruments::Instrument& kind) noexcept {
  return kind.bore_radius_mm > 0.0 && !kind.is_sleeve;
}

bool is_ridden(const Snapshot& now, std::size_t wire) noexcept {
  return std::any_of(now.items.begin(), now.items.end(), [&](const ItemView& item) {
    return item.instrument != kNoInstrument && item.wire == wire;
  });
}

/// What a hand holds cannot be let go of: it is in bone and would not stay there.
bool is_stuck(std::span<const instruments::Instrument> catalogue,
              const Snapshot& now,
              std::uint8_t hand) noexcept {
  const std::uint8_t held = now.hands[hand].item;
  if (held >= kMaxItems) return false;
  const ItemView& item = now.items[held];
  const instruments::Instrument& kind = catalogue[item.instrument];
  return item.body != kNoBody && !kind.stays && kind.work != instruments::Work::None &&
         item.depth_mm > 0.0;
}

bool has_room(const Snapshot& now) noexcept {
  return std::any_of(now.items.begin(), now.items.end(),
                     [](const ItemView& item) { return item.instrument == kNoInstrument; });
}

Refusal why_not_take(const procedure::Procedure& procedure,
                     const Snapshot& now,
                     const Command& command) noexcept {
  const auto catalogue = instruments::catalogue();
  const bool is_on_tray = std::find(procedure.tray.begin(), procedure.tray.end(), command.index) !=
                          procedure.tray.end();
  if (!is_on_tray || command.index >= catalogue.size()) return Refusal::NotOnTheTray;
  if (is_stuck(catalogue, now, command.hand)) return Refusal::HandIsFull;
  // What is held free makes room by going back to the tray.
  const std::uint8_t held = now.hands[command.hand].item;
  const bool makes_room = held < kMaxItems && now.items[held].body == kNoBody;
  if (!makes_room && !has_room(now)) return Refusal::TooManyItems;
  if (!rides(catalogue[command.index])) return Refusal::None;
  if (wire_to_ride_on(catalogue, now, command.index) != kNoItem) return Refusal::None;
  for (std::size_t i = 0; i < kMaxItems; ++i) {
    const ItemView& item = now.items[i];
    if (item.instrument == kNoInstrument || !item.in_target) continue;
    if (is_ridden(now, i)) return Refusal::WireIsTaken;
    if (catalogue[item.instrument].work != instruments::Work::Drill) continue;
    if (!item.near_end_is_out) return Refusal::EndIsInside;
    if (item.bend_rad > kStraightRad) return Refusal::WireIsBent;
  }
  return Refusal::NoWireToRideOn;
}

Refusal why_not_put_down(const Snapshot& now, const Command& command) noexcept {
  if (now.hands[command.hand].item >= kMaxItems) return Refusal::NothingInHand;
  return is_stuck(instruments::catalogue(), now, command.hand) ? Refusal::HandIsFull
                                                               : Refusal::None;
}

Refusal why_not_pick_up(const Snapshot& now, const Command& command) noexcept {
  if (is_stuck(instruments::catalogue(), now, command.hand)) return Refusal::HandIsFull;
  if (command.index >= kMaxItems) return Refusal::NothingThere;
  const ItemView& item = now.items[command.index];
  if (item.instrument == kNoInstrument || item.hand != kNoHand) return Refusal::NothingThere;
  if (is_ridden(now, command.index)) return Refusal::SomethingRidesOnIt;
  const instruments::Instrument& kind = instruments::catalogue()[item.instrument];
  if (command.kind == CommandKind::PickUpFarEnd) {
    return kind.is_double_pointed && item.far_end_is_out ? Refusal::None : Refusal::EndIsInside;
  }
  const bool is_wire = kind.work == instruments::Work::Drill && item.body != kNoBody;
  return is_wire && !item.near_end_is_out ? Refusal::EndIsInside : Refusal::None;
}

Refusal why_not_read(const Snapshot& now, const Command& command) noexcept {
  return wire_to_measure(instruments::catalogue(), now, command.hand) != kNoItem
             ? Refusal::None
             : Refusal::NoGaugeInHand;
}

/// Of the wires that lie in the target, beside which a hand holds this one.
std::uint8_t wire_beside(std::span<const instruments::Instrument> catalogue,
                         const Snapshot& now,
                         const ItemView& held) noexcept {
  constexpr double kBesideMm = 6.0;
  constexpr double kAlong = 0.966;  // cos 15 degrees
  for (std::uint8_t i = 0; i < kMaxItems; ++i) {
    const ItemView& wire = now.items[i];
    if (wire.instrument == kNoInstrument || !wire.in_target || !wire.near_end_is_out) continue;
    const instruments::Instrument& kind = catalogue[wire.instrument];
    if (kind.work != instruments::Work::Drill || wire.bend_rad > kStraightRad) continue;
    const bool is_near =
        squared_length(held.tip_in_patient - wire.entry_in_patient) <= kBesideMm * kBesideMm;
    if (is_near && dot(held.shaft_in_patient, wire.shaft_in_patient) >= kAlong) return i;
  }
  return kNoItem;
}

}  // namespace

std::uint8_t wire_to_ride_on(std::span<const instruments::Instrument> catalogue,
                             const Snapshot& now,
                             InstrumentIndex instrument) noexcept {
  if (instrument >= catalogue.size()) return kNoItem;
  const instruments::Instrument& kind = catalogue[instrument];
  std::uint8_t best = kNoItem;
  for (std::uint8_t i = 0; i < kMaxItems; ++i) {
    const ItemView& item = now.items[i];
    if (item.instrument == kNoInstrument || item.body == kNoBody || !item.in_target) continue;
    const instruments::Instrument& wire = catalogue[item.instrument];
    const bool fits = wire.work == instruments::Work::Drill &&
                      wire.shape.greatest_radius_mm() <= kind.bore_radius_mm;
    if (!fits || !(item.depth_mm > 0.0) || is_ridden(now, i)) continue;
    if (!item.near_end_is_out || item.bend_rad > kStraightRad) continue;
    // The one that was laid last: others were left as references.
    best = i;
  }
  return best;
}

std::uint8_t wire_to_measure(std::span<const instruments::Instrument> catalogue,
                             const Snapshot& now,
                             std::uint8_t hand) noexcept {
  const std::uint8_t held = now.hands[hand].item;
  if (held >= kMaxItems) return kNoItem;
  const ItemView& item = now.items[held];
  const instruments::Instrument& kind = catalogue[item.instrument];
  if (kind.is_gauge) return item.wire;
  const bool is_wire = kind.work == instruments::Work::Drill && kind.is_double_pointed;
  if (!is_wire || item.body != kNoBody || !now.hands[hand].touching) return kNoItem;
  return wire_beside(catalogue, now, item);
}

Refusal why_not(const procedure::Procedure& procedure,
                const Snapshot& now,
                const Command& command) noexcept {
  if (now.finished) return Refusal::Finished;
  if (command.hand >= kHands) return Refusal::NoSuchHand;
  switch (command.kind) {
    case CommandKind::None:
      return Refusal::None;
    case CommandKind::TakeShot:
      if (!can_stand(command.rotation_deg, command.tilt_deg)) return Refusal::ShotOutOfRange;
      return now.shots < kMaxShots ? Refusal::None : Refusal::TooManyShots;
    case CommandKind::Take:
      return why_not_take(procedure, now, command);
    case CommandKind::PickUp:
    case CommandKind::PickUpFarEnd:
      return why_not_pick_up(now, command);
    case CommandKind::PutDown:
      return why_not_put_down(now, command);
    case CommandKind::ReadGauge:
      return why_not_read(now, command);
    case CommandKind::Undo:
      if (now.mode == procedure::Mode::Assessed) return Refusal::NoUndoWhenAssessed;
      return now.can_undo ? Refusal::None : Refusal::NothingToUndo;
    case CommandKind::ReturnToStep:
      if (command.index >= procedure.steps.size()) return Refusal::UnknownCommand;
      if (now.mode == procedure::Mode::Assessed) return Refusal::NoUndoWhenAssessed;
      return (now.returnable_steps >> command.index & 1U) != 0 ? Refusal::None
                                                               : Refusal::NoWayBackToStep;
    case CommandKind::Decline: {
      const std::size_t known = procedure.decline.reasons.size();
      const bool is_said = command.index != 0 && (command.index >> known) == 0;
      return is_said ? Refusal::None : Refusal::NoReasonToDecline;
    }
    case CommandKind::Judge: {
      const bool is_said = command.index == static_cast<std::uint8_t>(Judgement::Aligned) ||
                           command.index == static_cast<std::uint8_t>(Judgement::Displaced);
      if (!procedure.judges_displacement || !is_said) return Refusal::UnknownCommand;
      return now.passes == 0 ? Refusal::None : Refusal::TooLateToJudge;
    }
    case CommandKind::UseAid:
      if (command.index >= procedure::kAidCount) return Refusal::UnknownCommand;
      return now.mode == procedure::Mode::Assessed ? Refusal::NoAidsWhenAssessed : Refusal::None;
    case CommandKind::Answer: {
      const arthroscopy::PathologyTable* asked = questions_of(procedure);
      if (asked == nullptr) return Refusal::UnknownCommand;
      const arthroscopy::PathologyTable& table = *asked;
      const std::size_t finding = command.index / kGradesAFinding;
      const std::uint8_t grade = command.index % kGradesAFinding;
      const bool is_asked = finding < table.findings.size() &&
                            (grade == kNoGrade || grade < table.scale_of(finding).grades.size());
      return is_asked ? Refusal::None : Refusal::UnknownCommand;
    }
    case CommandKind::TurnScope: {
      const bool is_turn = command.rotation_deg >= -180.0 && command.rotation_deg <= 180.0 &&
                           command.tilt_deg >= -180.0 && command.tilt_deg <= 180.0;
      if (!is_turn) return Refusal::UnknownCommand;
      return now.scope.hand < kHands ? Refusal::None : Refusal::NothingInHand;
    }
    case CommandKind::TurnMouth: {
      if (!(command.rotation_deg >= -180.0 && command.rotation_deg <= 180.0)) {
        return Refusal::UnknownCommand;
      }
      const std::uint8_t item = now.hands[command.hand].item;
      const bool has_mouth =
          item < kMaxItems && instruments::catalogue()[now.items[item].instrument].mouth;
      return has_mouth ? Refusal::None : Refusal::NothingInHand;
    }
    case CommandKind::SetFluid: {
      if (!procedure.fluid) return Refusal::UnknownCommand;
      if (now.scope.hand >= kHands) return Refusal::NothingInHand;
      const auto control = static_cast<procedure::FluidControl>(command.index / kFluidValues);
      return detail::can_set(arthroscopy::FluidTable::generic(), control,
                             command.index % kFluidValues)
                 ? Refusal::None
                 : Refusal::UnknownCommand;
    }
    case CommandKind::SetTube:
      return command.index < procedure::kTubeSettings ? Refusal::None : Refusal::UnknownCommand;
    case CommandKind::Finish:
    case CommandKind::ForgetCheckpoints:
      return Refusal::None;
  }
  return Refusal::UnknownCommand;
}

std::string_view name_of(Refusal refusal) noexcept {
  static constexpr std::array<std::string_view, 23> kNames{"none",
                                                           "finished",
                                                           "unknown_command",
                                                           "no_such_hand",
                                                           "shot_out_of_range",
                                                           "too_many_shots",
                                                           "not_on_the_tray",
                                                           "hand_is_full",
                                                           "too_many_items",
                                                           "no_wire_to_ride_on",
                                                           "wire_is_taken",
                                                           "nothing_in_hand",
                                                           "nothing_there",
                                                           "something_rides_on_it",
                                                           "no_gauge_in_hand",
                                                           "nothing_to_undo",
                                                           "no_undo_when_assessed",
                                                           "end_is_inside",
                                                           "wire_is_bent",
                                                           "no_reason_to_decline",
                                                           "no_aids_when_assessed",
                                                           "no_way_back_to_step",
                                                           "too_late_to_judge"};
  const auto index = static_cast<std::size_t>(refusal);
  return index < kNames.size() ? kNames[index] : kNames[2];
}

}  // namespace carpus::simulation
