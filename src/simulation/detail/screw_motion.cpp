// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The screw, driven over the wire.
#include <algorithm>

#include "geometry/trilinear.hpp"
#include "instruments/drilling_resistance.hpp"
#include "instruments/guide_wire.hpp"
#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {
namespace {

using procedure::Step;

constexpr double kLookAheadMm = 0.3;  // the trocar's edges cut this far before its middle
constexpr double kDeepestMm = 90.0;   // no wire goes further
constexpr double kSoftTissueHu = 40.0;

}  // namespace

void World::State::drive_screw(const Model& model, const Input& input) noexcept {
  const Vec3 tip = entry() + now.wire.direction * now.screw.advance_mm;
  const double hu = sample_at(model.ct, tip + now.wire.direction * kLookAheadMm, kSoftTissueHu);
  const double resistance = instruments::screw_resistance_n(hu);
  if (input.driver == Driver::Forward) {
    if (now.screw.advance_mm <= 0.0 && !spent.forward_is_held) save_checkpoint();
    const double feed = instruments::screw_feed_mm_per_s(input.thrust_n, resistance);
    now.screw.advance_mm = std::min(now.screw.advance_mm + feed * kTickSeconds, kDeepestMm);
    snapshot.resistance_n = std::min(input.thrust_n, resistance);
  } else if (input.driver == Driver::Reverse && !spent.reverse_is_held) {
    now.screw.advance_mm -= instruments::kScrewBackMmPerS * kTickSeconds;
    snapshot.resistance_n = 0.0;
    if (now.screw.advance_mm <= 0.0) return unload_screw();
  } else {
    snapshot.resistance_n = std::min(input.thrust_n, resistance);
  }
  if (buried_mm() >= 0.0 && !now.screw.told_seated) {
    now.screw.told_seated = true;
    emit(EventKind::ScrewSeated, now.screw.index, buried_mm());
  }
  if (buried_mm() < 0.0) {
    now.screw.told_seated = false;
    now.completed_steps &= ~detail::step_bit(Step::Insert);
  }
  now.shaft = -now.wire.direction;
  now.tip = entry() + now.wire.direction * buried_mm();
}

/// Backed out to the start, the screw comes off and the wire is in the driver again.
void World::State::unload_screw() noexcept {
  now.screw = detail::ScrewOnWire{};
  now.instrument = Instrument::GuideWire;
  now.tip = wire_tip();
  now.completed_steps &= ~(detail::step_bit(Step::Choose) | detail::step_bit(Step::Insert));
  spent.reverse_is_held = true;
}

}  // namespace carpus::simulation
