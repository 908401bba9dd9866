// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "session/page_input.hpp"

#include "arthroscopy/pathology_table.hpp"

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/units.hpp"
#include "instruments/instrument.hpp"
#include "procedure/aid.hpp"
#include "simulation/c_arm_angles.hpp"
#include "simulation/questions.hpp"

namespace carpus::session {

using simulation::Command;
using simulation::CommandKind;

namespace {

// The enumerations of protocol.json are in the order of the simulation's.
static_assert(static_cast<int>(protocol::Driver::Reverse) ==
              static_cast<int>(simulation::Driver::Reverse));
static_assert(static_cast<int>(protocol::Aid::Hint) == static_cast<int>(procedure::Aid::Hint));
static_assert(static_cast<std::size_t>(protocol::DoseLevel::High) + 1 ==
              procedure::kDoseHalves.size());
static_assert(static_cast<int>(protocol::Guidance::Planned) ==
              static_cast<int>(simulation::Guidance::Planned));

std::optional<CommandKind> kind_of(protocol::ActionId id) noexcept {
  switch (id) {
    case protocol::ActionId::Take:
      return CommandKind::Take;
    case protocol::ActionId::PickUp:
      return CommandKind::PickUp;
    case protocol::ActionId::PickUpFarEnd:
      return CommandKind::PickUpFarEnd;
    case protocol::ActionId::PutDown:
      return CommandKind::PutDown;
    case protocol::ActionId::ReadGauge:
      return CommandKind::ReadGauge;
    case protocol::ActionId::Undo:
      return CommandKind::Undo;
    case protocol::ActionId::ReturnToStep:
      return CommandKind::ReturnToStep;
    case protocol::ActionId::Finish:
      return CommandKind::Finish;
    case protocol::ActionId::UseAid:
      return CommandKind::UseAid;
    case protocol::ActionId::Decline:
      return CommandKind::Decline;
    case protocol::ActionId::Judge:
      return CommandKind::Judge;
    case protocol::ActionId::TakeShot:
      break;
  }
  return std::nullopt;
}

std::optional<std::size_t> place_of(const procedure::DeclineRules& decline, std::string_view id) {
  for (std::size_t i = 0; i < decline.reasons.size(); ++i) {
    if (decline.reasons[i].id == id) return i;
  }
  return std::nullopt;
}

double room_rotation_of(protocol::AngleReference reference,
                        double rotation_deg,
                        const simulation::WristPose& wrist) noexcept {
  return reference == protocol::AngleReference::Room
             ? rotation_deg
             : simulation::room_rotation_deg(rotation_deg, wrist.pronation_rad);
}

}  // namespace

HeldInput resting(const simulation::Snapshot& now) noexcept {
  HeldInput held;
  held.wrist = now.wrist;
  held.c_arm = now.c_arm;
  held.c_arm.pedal_is_down = false;
  for (std::size_t hand = 0; hand < kHands; ++hand) {
    const std::uint8_t item = now.hands[hand].item;
    if (item >= simulation::kMaxItems) continue;
    held.hands[hand].tip_in_patient = now.items[item].tip_in_patient;
    held.hands[hand].shaft_in_patient = now.items[item].shaft_in_patient;
  }
  return held;
}

void hold(HeldInput& held, const protocol::Hand& message) noexcept {
  const auto hand = static_cast<std::size_t>(message.hand);
  if (hand >= kHands) return;
  held.hands[hand] = {message.tip_mm, message.shaft, message.thrust_n,
                      static_cast<simulation::Driver>(message.driver),
                      static_cast<simulation::Guidance>(message.guidance)};
  ++held.heard[hand];
}

void hold(HeldInput& held, const protocol::Wrist& message) noexcept {
  held.wrist = {radians_from_degrees(message.flexion_deg),
                radians_from_degrees(message.radial_deviation_deg),
                radians_from_degrees(message.pronation_deg), message.traction_n};
}

void hold(HeldInput& held,
          const protocol::CArm& message,
          const simulation::WristPose& wrist) noexcept {
  held.c_arm.rotation_deg = room_rotation_of(message.reference, message.rotation_deg, wrist);
  held.c_arm.tilt_deg = message.tilt_deg;
}

void hold(HeldInput& held, const protocol::Pedal& message) noexcept {
  held.c_arm.pedal_is_down = message.down;
  ++held.pedal_heard;
}

Result<Command> command_of(const protocol::Act& message, const procedure::Procedure& procedure) {
  const auto kind = kind_of(message.id);
  if (!kind) return Refusal{"A picture is asked for with take_shot"};
  Command command;
  command.kind = *kind;
  command.hand = static_cast<std::uint8_t>(message.hand.value_or(0));
  if (*kind == CommandKind::Take) {
    if (!message.instrument) return Refusal{"take needs an instrument"};
    const auto index = instruments::instrument_of(*message.instrument);
    if (!index) return Refusal{"There is no instrument '" + *message.instrument + "'"};
    command.index = *index;
  }
  if (*kind == CommandKind::Decline) {
    for (const std::string& said : message.reasons.value_or(std::vector<std::string>{})) {
      const std::optional<std::size_t> place = place_of(procedure.decline, said);
      if (!place) return Refusal{"There is no reason '" + said + "'"};
      command.index = static_cast<std::uint8_t>(command.index | (1U << *place));
    }
  }
  if (*kind == CommandKind::UseAid) {
    if (!message.aid) return Refusal{"use_aid needs an aid"};
    command.index = static_cast<std::uint8_t>(*message.aid);
  }
  if (*kind == CommandKind::Judge) {
    if (!message.displaced) return Refusal{"judge needs to know what: displaced or not"};
    command.index = static_cast<std::uint8_t>(*message.displaced ? procedure::Judgement::Displaced
                                                                 : procedure::Judgement::Aligned);
  }
  if (*kind == CommandKind::ReturnToStep) {
    if (!message.item) return Refusal{"return_to_step needs a step"};
    command.index = static_cast<std::uint8_t>(*message.item);
  }
  if (*kind == CommandKind::PickUp || *kind == CommandKind::PickUpFarEnd) {
    if (!message.item) return Refusal{"pick_up needs an item"};
    command.index = static_cast<std::uint8_t>(*message.item);
  }
  return command;
}

Command command_of(const protocol::Tube& message) noexcept {
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < procedure::kTubeKv.size(); ++i) {
    const auto away = [&](std::size_t at) {
      return std::abs(message.tube_kv - static_cast<double>(procedure::kTubeKv[at]));
    };
    if (away(i) < away(nearest)) nearest = i;
  }
  Command command;
  command.kind = CommandKind::SetTube;
  command.index = static_cast<std::uint8_t>(nearest * procedure::kDoseHalves.size() +
                                            static_cast<std::size_t>(message.dose_level));
  return command;
}

Command command_of(const protocol::TurnScope& message) noexcept {
  Command command;
  command.kind = CommandKind::TurnScope;
  command.rotation_deg = message.shaft_deg;
  command.tilt_deg = message.camera_deg;
  return command;
}

Command command_of(const protocol::TurnMouth& message) noexcept {
  Command command;
  command.kind = CommandKind::TurnMouth;
  command.hand = static_cast<std::uint8_t>(message.hand);
  command.rotation_deg = message.mouth_deg;
  return command;
}

Command command_of(const protocol::SetFluid& message) noexcept {
  Command command;
  command.kind = CommandKind::SetFluid;
  command.index = simulation::fluid_index(static_cast<procedure::FluidControl>(message.control),
                                          static_cast<std::uint8_t>(message.value));
  return command;
}

Result<Command> command_of(const protocol::Answer& message, const procedure::Procedure& procedure) {
  static const arthroscopy::PathologyTable kNothing;
  const arthroscopy::PathologyTable* asked = simulation::questions_of(procedure);
  const arthroscopy::PathologyTable& table = asked != nullptr ? *asked : kNothing;
  for (std::size_t f = 0; f < table.findings.size(); ++f) {
    if (table.findings[f].id != message.finding) continue;
    Command command;
    command.kind = CommandKind::Answer;
    if (message.grade.empty()) {
      command.index = simulation::answer_index(f, simulation::kNoGrade);
      return command;
    }
    const auto& grades = table.scale_of(f).grades;
    for (std::uint8_t g = 0; g < grades.size(); ++g) {
      if (grades[g].id != message.grade) continue;
      command.index = simulation::answer_index(f, g);
      return command;
    }
    return Refusal{"Of " + message.finding + " there is no grade '" + message.grade + "'"};
  }
  return Refusal{"Nothing is asked of '" + message.finding + "'"};
}

Command command_of(const protocol::TakeShot& message, const simulation::WristPose& wrist) noexcept {
  Command command;
  command.kind = CommandKind::TakeShot;
  command.rotation_deg = room_rotation_of(message.reference, message.rotation_deg, wrist);
  command.tilt_deg = message.tilt_deg;
  return command;
}

}  // namespace carpus::session
