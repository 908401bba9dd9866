// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One tick: check the input -> carry out the command -> move what the hand holds (free wire, wire
// in bone, or screw) -> tick off steps -> force, limited last -> snapshot and hash.
#include "simulation/world.hpp"

#include <cstdint>

#include "core/error.hpp"
#include "instruments/guide_wire.hpp"
#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {
namespace {

constexpr double kWorkspaceMm = 1000.0;    // beyond this from the CT's origin a tip makes no sense
constexpr double kGreatestThrustN = 60.0;  // protocol/protocol.json
constexpr double kWaitingMm = 60.0;        // over skin and bones

double absolute(double value) noexcept { return value < 0 ? -value : value; }

}  // namespace

Input World::State::checked(const Input& raw) noexcept {
  Input input = raw;
  bool is_bad = false;
  const Vec3& t = raw.tip_in_patient;
  if (!(absolute(t.x) <= kWorkspaceMm && absolute(t.y) <= kWorkspaceMm &&
        absolute(t.z) <= kWorkspaceMm)) {
    input.tip_in_patient = spent.has_input ? spent.last_hand_tip : now.tip;
    is_bad = true;
  }
  input.shaft_in_patient = normalized_or(raw.shaft_in_patient, {0, 0, 0});
  if (!(squared_length(input.shaft_in_patient) > 0.5)) {
    input.shaft_in_patient = spent.last_hand_shaft;
    is_bad = true;
  }
  if (!(raw.thrust_n >= 0.0 && raw.thrust_n <= kGreatestThrustN)) {
    input.thrust_n = raw.thrust_n > kGreatestThrustN ? kGreatestThrustN : 0.0;
    is_bad = true;
  }
  if (static_cast<unsigned>(raw.driver) > static_cast<unsigned>(Driver::Reverse)) {
    input.driver = Driver::Off;
    is_bad = true;
  }
  if (is_bad) ++faults.bad_inputs;
  return input;
}

void World::State::emit(EventKind kind, std::int32_t detail, double value) noexcept {
  if (snapshot.event_count >= kMaxEventsPerTick) {
    ++faults.lost_events;
    return;
  }
  snapshot.events[snapshot.event_count++] = {kind, detail, value, spent.tick};
}

void World::State::refuse(CommandKind kind) noexcept {
  emit(EventKind::Refused, static_cast<std::int32_t>(kind), 0.0);
}

void World::State::step(Model& model, const Input& raw) noexcept {
  snapshot.event_count = 0;
  snapshot.events = {};
  if (spent.finished) return;
  ++spent.tick;
  const Input input = checked(raw);
  const Vec3 hand_velocity =
      spent.has_input ? (input.tip_in_patient - spent.last_hand_tip) / kTickSeconds : Vec3{};
  if (!spent.has_input) {  // the wire comes in from behind the hand, so that it starts in no bone
    now.tip = input.tip_in_patient + input.shaft_in_patient * instruments::kWireLengthMm;
    now.shaft = input.shaft_in_patient;
  }
  snapshot.resistance_n = 0.0;
  if (input.driver != Driver::Reverse) spent.reverse_is_held = false;
  obey(model, input.command);
  if (!spent.finished) {
    if (now.instrument == Instrument::ScrewDriver) {
      drive_screw(model, input);
    } else if (now.wire.engaged) {
      drive_wire(model, input);
    } else {
      move_free_wire(model, input);
    }
    tick_off_steps();
  }
  spent.forward_is_held = input.driver == Driver::Forward;
  if (!spent.forward_is_held) spent.slip_is_told = false;
  spent.last_hand_tip = input.tip_in_patient;
  spent.last_hand_shaft = input.shaft_in_patient;
  spent.has_input = true;
  publish(model, input, hand_velocity);
  update_hash(model);
}

World::World(const cases::CaseData& posed_case,
             procedure::ProcedureId procedure,
             std::uint64_t seed)
    : model_(std::make_unique<Model>(posed_case)), state_(std::make_unique<State>()) {
  model_->procedure = procedure;
  model_->seed = seed;
  // Until the first input the wire waits in the air over the back of the wrist: a host that holds
  // it where it is must not start with it across the bones.
  const Vec3 dorsal =
      cases::held_wrist_from_patient(posed_case).rotation.transposed() * Vec3{0, 0, -1};
  state_->now.tip = posed_case.scaphoid.waist + dorsal * kWaitingMm;
  state_->now.shaft = dorsal;
  state_->snapshot.tip_in_patient = state_->now.tip;
  state_->snapshot.shaft_in_patient = state_->now.shaft;
}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

const Snapshot& World::step(const Input& input) noexcept {
  state_->step(*model_, input);
  return state_->snapshot;
}

const Snapshot& World::now() const noexcept { return state_->snapshot; }

procedure::OperationRecord World::operation_record() const {
  const State& state = *state_;
  procedure::OperationRecord record;
  record.wire_in_scaphoid = state.now.wire.in_scaphoid;
  if (record.wire_in_scaphoid) {
    record.entry_in_patient = state.snapshot.wire.entry_in_patient;
    record.direction_in_patient = state.now.wire.direction;
    record.wire_depth_mm = state.snapshot.wire.depth_mm;
  }
  record.measured_mm = state.now.measured_mm;
  record.screw_index = state.now.screw.index;
  record.screw_advance_mm = state.now.screw.advance_mm;
  record.passes = state.now.passes;
  record.far_exits = state.now.far_exits;
  record.far_exit_mm = state.now.far_exit_mm;
  record.wrong_bones = state.now.wrong_bones;
  record.undos = state.spent.undos;
  record.shots.assign(state.shots.begin(), state.shots.begin() + state.spent.shot_count);
  record.ticks = state.spent.tick;
  record.completed_steps = state.now.completed_steps;
  record.finished = state.spent.finished;
  return record;
}

const TickFaults& World::faults() const noexcept { return state_->faults; }
procedure::ProcedureId World::procedure() const noexcept { return model_->procedure; }
std::uint64_t World::seed() const noexcept { return model_->seed; }
const cases::CaseData& World::posed_case() const noexcept { return model_->posed_case; }

}  // namespace carpus::simulation
