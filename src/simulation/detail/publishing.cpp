// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The snapshot, the force and the hash that each tick leaves.
#include <cstdint>

#include "geometry/trilinear.hpp"
#include "haptics/contact_force.hpp"
#include "instruments/guide_wire.hpp"
#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {
namespace {

using detail::SurfacePoint;
using procedure::Step;

constexpr double kSoftTissueHu = 40.0;

}  // namespace

void World::State::publish_wire(const Model& model) noexcept {
  WireState& wire = snapshot.wire;
  wire = WireState{};
  wire.passes = now.passes;
  wire.engaged = now.wire.engaged;
  if (!now.wire.engaged) {
    wire.tip_in_patient = now.tip;
    wire.direction_in_patient = -now.shaft;
    return;
  }
  wire.entry_in_patient = now.wire.in_scaphoid ? entry() : now.wire.origin;
  wire.tip_in_patient = wire_tip();
  wire.direction_in_patient = now.wire.direction;
  wire.depth_mm = depth_mm();
  wire.tip_hu = sample_at(model.ct, wire.tip_in_patient, kSoftTissueHu);
  const SurfacePoint at_tip = model.contact.surface_at(wire.tip_in_patient);
  wire.tip_label = at_tip.is_near && at_tip.distance_mm <= 0.0 ? at_tip.label : std::uint8_t{0};
}

void World::State::publish(const Model& model,
                           const Input& input,
                           const Vec3& hand_velocity) noexcept {
  snapshot.tick = spent.tick;
  snapshot.completed_steps = now.completed_steps;
  // What was left out before a screw is in cannot be made up for any more.
  const bool is_screw_in = (now.completed_steps & detail::step_bit(Step::Insert)) != 0;
  int current = is_screw_in ? static_cast<int>(Step::Verify) : 0;
  while (current < static_cast<int>(Step::Finished) && (now.completed_steps >> current & 1U) != 0) {
    ++current;
  }
  snapshot.step = spent.finished ? Step::Finished : static_cast<Step>(current);
  // Let go with its screw seated, the driver comes off and the wire out: the final views show the
  // screw alone. Driving on takes them up again.
  const bool is_laid_down = now.instrument == Instrument::ScrewDriver && buried_mm() >= 0.0 &&
                            (input.driver == Driver::Off || spent.finished);
  snapshot.instrument = is_laid_down ? Instrument::None : now.instrument;
  snapshot.tip_in_patient = now.tip;
  snapshot.shaft_in_patient = now.shaft;
  publish_wire(model);
  snapshot.screw = {now.screw.index, now.screw.length_mm, now.screw.advance_mm,
                    now.screw.index >= 0 ? buried_mm() : 0.0};
  snapshot.measured_mm = now.measured_mm;
  snapshot.shots = spent.shot_count;
  snapshot.undos = spent.undos;
  snapshot.finished = spent.finished;

  const bool is_free = !now.wire.engaged;
  snapshot.contact.touching = is_free && spent.touched_label != 0;
  snapshot.contact.label = snapshot.contact.touching ? spent.touched_label : std::uint8_t{0};
  snapshot.contact.normal_in_patient = snapshot.contact.touching ? spent.contact_normal : Vec3{};
  snapshot.contact.depth_mm =
      snapshot.contact.touching ? distance(input.tip_in_patient, now.tip) : 0.0;

  // In bone the line is held by bone and guide; what the hand feels is the way along it.
  const Vec3 force = is_free
                         ? haptics::contact_force_n(now.tip, input.tip_in_patient, hand_velocity)
                         : now.shaft * snapshot.resistance_n;
  snapshot.force_in_patient = limiter.limited(force);
  faults.forces_zeroed = limiter.faults();
}

void World::State::update_hash(const Model& model) noexcept {
  StateHash hash;
  hash.add(spent.hash);
  hash.add(model.seed);
  detail::add_to(hash, now);
  detail::add_to(hash, spent);
  if (spent.shot_count > 0) {
    const procedure::Shot& shot = shots[spent.shot_count - 1];
    hash.add(shot.rotation_deg);
    hash.add(shot.tilt_deg);
  }
  hash.add(snapshot.force_in_patient.x);
  hash.add(snapshot.force_in_patient.y);
  hash.add(snapshot.force_in_patient.z);
  spent.hash = hash.value();
  snapshot.state_hash = hash.value();
}

}  // namespace carpus::simulation
