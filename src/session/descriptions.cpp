// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "session/descriptions.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "core/units.hpp"
#include "instruments/instrument.hpp"
#include "session/body_names.hpp"
#include "session/scope_message.hpp"
#include "session/skin_message.hpp"

namespace carpus::session {

namespace {

// The enumerations of protocol.json are in the order of the instruments'.
static_assert(static_cast<int>(protocol::Material::Glove) ==
              static_cast<int>(instruments::Material::Glove));
static_assert(static_cast<int>(protocol::Work::Thread) ==
              static_cast<int>(instruments::Work::Thread));
static_assert(static_cast<int>(protocol::Drive::ByHand) ==
              static_cast<int>(instruments::Drive::ByHand));

protocol::InstrumentPart message_of(const instruments::DrawnPart& part) {
  protocol::InstrumentPart message;
  message.from_mm = part.from_mm;
  message.to_mm = part.to_mm;
  message.radius_mm = part.radius_mm;
  message.end_radius_mm = part.end_radius_mm;
  message.is_threaded = part.is_threaded;
  message.pitch_mm = part.pitch_mm;
  message.end_pitch_mm = part.end_pitch_mm;
  message.material = static_cast<protocol::Material>(part.material);
  message.only_in_hand = part.only_in_hand;
  message.origin_mm = part.origin_mm;
  message.axis = part.axis;
  message.squash = part.squash;
  return message;
}

protocol::Instrument message_of(const instruments::Instrument& instrument) {
  protocol::Instrument message;
  message.id = instrument.id;
  message.name = instrument.name;
  message.use = instrument.use;
  message.length_mm = instrument.length_mm;
  message.work = static_cast<protocol::Work>(instrument.work);
  message.drive = static_cast<protocol::Drive>(instrument.drive);
  message.rides_on_wire = instrument.bore_radius_mm > 0.0 && !instrument.is_sleeve;
  message.is_gauge = instrument.is_gauge;
  message.is_joystick = instrument.is_joystick;
  message.is_sleeve = instrument.is_sleeve;
  message.has_jaws = instrument.has_jaws;
  message.has_bite = instrument.bite.has_value();
  if (instrument.skin) {
    // One more: none.
    message.skin_work =
        static_cast<protocol::SkinWork>(static_cast<std::uint8_t>(instrument.skin->work) + 1U);
  }
  message.has_mouth = instrument.mouth.has_value();
  message.stays = instrument.stays;
  message.family = instrument.family;
  message.tip_diameter_mm = instrument.tip_diameter_mm;
  message.tail_diameter_mm = instrument.tail_diameter_mm;
  message.is_confirmed = instrument.is_confirmed;
  for (const instruments::DrawnPart& part : instrument.parts) {
    message.parts.push_back(message_of(part));
  }
  return message;
}

protocol::ProcedureSummary summary_of(const procedure::Procedure& procedure) {
  return {procedure.id, procedure.title, procedure.summary};
}

protocol::Step message_of(const procedure::Step& step) {
  protocol::Step message{step.id, step.title, step.instruction, step.actions, {}};
  const auto all = instruments::catalogue();
  if (step.instrument < all.size()) message.instrument = all[step.instrument].id;
  return message;
}

/// To a thousandth: a person reads them.
protocol::Range degrees(const anatomy::Interval& radians) noexcept {
  const auto read = [](double value) {
    return std::round(1000 * degrees_from_radians(value)) / 1000;
  };
  return {read(radians.low), read(radians.high)};
}

protocol::WristLimits message_of(const anatomy::HandLimits& limits) noexcept {
  return {degrees(limits.flexion_rad), degrees(limits.radial_deviation_rad),
          degrees(limits.pronation_rad),
          protocol::Range{limits.traction_n.low, limits.traction_n.high}};
}

/// None where the procedure is after no line.
std::optional<protocol::Ideal> ideal_of(const procedure::Aim& aim, const BodyNames& bodies) {
  if (aim.body >= bodies.size()) return std::nullopt;
  protocol::Ideal ideal{bodies.name(aim.body), aim.entry, aim.direction,
                        aim.chord_mm,          {},        aim.screw_tail_mm};
  const auto all = instruments::catalogue();
  if (aim.screw < all.size()) ideal.screw = all[aim.screw].id;
  return ideal;
}

}  // namespace

protocol::WristPose message_of(const procedure::WristPose& wrist) noexcept {
  return {degrees_from_radians(wrist.flexion_rad), degrees_from_radians(wrist.radial_deviation_rad),
          degrees_from_radians(wrist.pronation_rad), wrist.traction_n};
}

protocol::CaseDescription case_description(const cases::CaseData& data) {
  protocol::CaseDescription description;
  description.pseudonym = data.pseudonym;
  description.simulated = data.provenance.simulated;
  description.side = data.side == Side::Left ? protocol::Side::Left : protocol::Side::Right;
  description.source = data.provenance.source;
  const auto& pose = data.wrist_from_patient;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      description.wrist_from_patient[4 * row + column] = pose.rotation.rows[row][column];
    }
    description.wrist_from_patient[4 * row + 3] = pose.translation[row];
  }
  description.wrist_from_patient[15] = 1.0;
  const anatomy::HandPose& scan = data.hand_motion.scan;
  description.scan = message_of(procedure::WristPose{scan.flexion_rad, scan.radial_deviation_rad,
                                                     scan.pronation_rad, scan.traction_n});
  for (const cases::Bone& bone : data.bones) {
    description.bones.emplace_back(name_of(bone.bone, bone.part));
  }
  return description;
}

protocol::ProcedureList procedure_list(const procedure::ProcedureList& procedures) {
  protocol::ProcedureList list;
  for (const procedure::Procedure* procedure : procedures.all()) {
    list.procedures.push_back(summary_of(*procedure));
  }
  return list;
}

protocol::InstrumentList instrument_list() {
  protocol::InstrumentList list;
  for (const instruments::Instrument& instrument : instruments::catalogue()) {
    list.instruments.push_back(message_of(instrument));
  }
  return list;
}

std::vector<protocol::Finding> findings_of(const arthroscopy::PathologyTable& table) {
  std::vector<protocol::Finding> findings;
  for (std::size_t f = 0; f < table.findings.size(); ++f) {
    const arthroscopy::Scale& scale = table.scale_of(f);
    protocol::Finding finding{table.findings[f].id, table.findings[f].label, scale.name, {}};
    for (const arthroscopy::Grade& grade : scale.grades) {
      finding.grades.push_back({grade.id, grade.label});
    }
    findings.push_back(std::move(finding));
  }
  return findings;
}

protocol::Exercise exercise_message(const cases::CaseData& data,
                                    const procedure::Procedure& procedure,
                                    const procedure::Aim& aim,
                                    const simulation::Snapshot& opening) {
  protocol::Exercise message;
  message.mode = static_cast<protocol::Mode>(opening.mode);
  message.procedure = summary_of(procedure);
  if (procedure.making) {
    message.task = with_second_portal(procedure.making->task, data, procedure, opening.seed);
  }
  for (const procedure::Step& step : procedure.steps) {
    message.steps.push_back(message_of(step));
    std::string& said = message.steps.back().instruction;
    said = with_second_portal(std::move(said), data, procedure, opening.seed);
  }
  for (const procedure::NamedView& view : procedure.views) {
    message.views.push_back({view.id, view.label, view.rotation_deg, view.tilt_deg,
                             view.flexion_deg, view.radial_deviation_deg});
  }
  const auto all = instruments::catalogue();
  for (const instruments::InstrumentIndex index : procedure.tray) {
    message.tray.push_back(all[index].id);
    message.instruments.push_back(message_of(all[index]));
  }
  const BodyNames names(data);
  for (std::size_t body = 0; body < names.size(); ++body) {
    message.bodies.push_back(
        {names.name(body), names.words(body), data.bones[body].bone == procedure.target});
  }
  if (opening.mode == procedure::Mode::Practice) message.ideal = ideal_of(aim, names);
  message.arthroscopy = arthroscopy_of(data, procedure, opening.seed, opening.prepared);
  message.wrist_limits = message_of(data.hand_motion.limits);
  for (const procedure::DeclineReason& reason : procedure.decline.reasons) {
    message.decline_reasons.push_back({reason.id, reason.label});
  }
  return message;
}

}  // namespace carpus::session
