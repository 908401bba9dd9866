// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/case_messages.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/units.hpp"
#include "fluoroscopy/c_arm.hpp"
#include "procedure/views.hpp"
#include "server/event_text.hpp"
#include "server/exercise.hpp"

namespace carpus::server {

namespace {

// The enumerations of protocol.json are in the order of the simulation's.
static_assert(static_cast<int>(protocol::StepId::Finished) ==
              static_cast<int>(procedure::Step::Finished));
static_assert(static_cast<int>(protocol::InstrumentId::None) ==
              static_cast<int>(simulation::Instrument::None));
static_assert(static_cast<int>(protocol::Driver::Reverse) ==
              static_cast<int>(simulation::Driver::Reverse));

void write_wire(const simulation::WireState& wire, bool broken, protocol::Snapshot& message) {
  message.wire_engaged = wire.engaged;
  message.wire_entry_mm = wire.entry_in_patient;
  message.wire_tip_mm = wire.tip_in_patient;
  message.wire_direction = wire.direction_in_patient;
  message.wire_depth_mm = wire.depth_mm;
  message.wire_passes = wire.passes;
  message.wire_tip_hu = wire.tip_hu;
  message.wire_tip_bone = bone_name_of_label(wire.tip_label, broken);
}

}  // namespace

bool has_broken_scaphoid(const cases::CaseData& data) {
  return cases::scaphoid_parts(data).size() > 1;
}

protocol::Snapshot snapshot_message(const LoopState& state, bool paused, bool broken_scaphoid) {
  const simulation::Snapshot& now = state.snapshot;
  protocol::Snapshot message;
  message.tick = static_cast<std::int64_t>(now.tick);
  message.state_hash = hexadecimal(now.state_hash);
  message.paused = paused;
  message.finished = now.finished;
  message.step = static_cast<protocol::StepId>(now.step);
  message.completed_steps = now.completed_steps;
  message.instrument = static_cast<protocol::InstrumentId>(now.instrument);
  message.tip_mm = now.tip_in_patient;
  message.shaft = now.shaft_in_patient;
  message.touching = now.contact.touching;
  message.touched_bone = bone_name_of_label(now.contact.label, broken_scaphoid);
  message.contact_depth_mm = std::max(0.0, now.contact.depth_mm);
  message.contact_normal = now.contact.normal_in_patient;
  message.force_n = now.force_in_patient;
  message.resistance_n = std::max(0.0, now.resistance_n);
  write_wire(now.wire, broken_scaphoid, message);
  message.screw_index = now.screw.index;
  message.screw_length_mm = now.screw.length_mm;
  message.screw_advance_mm = now.screw.advance_mm;
  message.screw_buried_mm = now.screw.buried_mm;
  message.measured_mm = now.measured_mm;
  message.shots = now.shots;
  message.dose_cgy_cm2 = now.shots * procedure::kDosePerShotCgyCm2;
  message.undos = now.undos;
  message.tick_rate_hz = state.timing.rate_hz;
  message.tick_p99_us = state.timing.p99_us;
  message.late_ticks = static_cast<std::int64_t>(state.timing.late_ticks);
  return message;
}

protocol::CaseDescription case_description(const cases::CaseData& posed_case) {
  protocol::CaseDescription description;
  description.pseudonym = posed_case.pseudonym;
  description.simulated = posed_case.provenance.simulated;
  description.side = posed_case.side == Side::Left ? protocol::Side::Left : protocol::Side::Right;
  description.source = posed_case.provenance.source;
  description.broken_scaphoid = has_broken_scaphoid(posed_case);
  description.flexion_deg =
      degrees_from_radians(posed_case.operative_posture.flexion_from_scan_rad);
  const auto pose = cases::held_wrist_from_patient(posed_case);
  auto& matrix = description.held_wrist_from_patient;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      matrix[4 * row + column] = pose.rotation.rows[row][column];
    }
    matrix[4 * row + 3] = pose.translation[row];
  }
  matrix[15] = 1.0;
  for (const cases::Bone& bone : posed_case.bones) {
    description.bones.emplace_back(name_of(bone.bone, bone.part));
  }
  for (const fluoroscopy::NamedView& view : fluoroscopy::kNamedViews) {
    description.views.push_back({std::string(view.id), std::string(view.label),
                                 view.angles.rotation_deg, view.angles.tilt_deg});
  }
  return description;
}

HeldTool held_tool(const protocol::Tool& tool) noexcept {
  return {tool.tip_mm, tool.shaft, tool.thrust_n, static_cast<simulation::Driver>(tool.driver)};
}

}  // namespace carpus::server
