// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The wire: free over the bones, resting on one, engaged, driven and drawn back.
#include <algorithm>
#include <cstdint>

#include "geometry/trilinear.hpp"
#include "instruments/drilling_resistance.hpp"
#include "instruments/guide_wire.hpp"
#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {
namespace {

using detail::NearBones;
using detail::SurfacePoint;
using detail::WireLine;
using detail::WirePose;
using procedure::Step;

constexpr double kSubstepMm = 0.25;     // below half the wire's diameter: no tunnelling
constexpr int kMaxSubsteps = 24;        // 6 mm a tick is 6 m/s; a farther target is chased
constexpr double kTurnPerTick = 0.01;   // rad: 0.8 mm at the far end of the wire
constexpr double kTouchingMm = 0.05;    // tip this near the surface counts as resting on it
constexpr double kLookAheadMm = 0.3;    // the trocar's edges cut this far before its middle
constexpr double kDeepestMm = 90.0;     // no wire goes further
constexpr double kWrongBoneMm = 0.3;    // deeper than a scratch
constexpr double kFarExitMm = 0.3;      // voxels of the closed solid are 0.4 mm
constexpr double kEngageThrustN = 1.0;  // less is a touch
constexpr double kSoftTissueHu = 40.0;

}  // namespace

void World::State::turn_towards(const Vec3& shaft) noexcept {
  const Vec3 difference = shaft - now.shaft;
  const double far = length(difference);
  if (!(far > 0.0)) return;
  const Vec3 next = far > kTurnPerTick ? now.shaft + difference * (kTurnPerTick / far) : shaft;
  // Opposite directions have no way between them: leave by any perpendicular.
  now.shaft = normalized_or(next, any_perpendicular(now.shaft));
}

void World::State::move_free_wire(Model& model, const Input& input) noexcept {
  const WirePose before{now.tip, now.shaft};
  turn_towards(input.shaft_in_patient);
  NearBones near = model.contact.boxes_near(before, {input.tip_in_patient, now.shaft});
  if (near.count == 0) {
    now.tip = input.tip_in_patient;
    spent.touched_label = 0;
    return;
  }
  const NearBones met = model.contact.hulls_met(near, {now.tip, now.shaft});
  const detail::Resolved turned = model.contact.push_out(met, {now.tip, now.shaft});
  if (turned.is_wedged) {  // no room to turn
    ++faults.unresolved_contacts;
    now.shaft = before.shaft;
  } else {
    now.tip = turned.tip;
  }
  chase(model, near, input.tip_in_patient);
  near = model.contact.hulls_met(near, {now.tip, now.shaft});
  rest_or_engage(model, near, input);
}

/// Moves the tip towards the target in steps too short to pass through anything, pushing the wire
/// out of bone after each: so it slides along surfaces.
void World::State::chase(Model& model, const NearBones& near, const Vec3& target) noexcept {
  constexpr double kArrivedMm = 1e-9;
  constexpr double kNoProgressMm = 1e-4;
  for (int i = 0; i < kMaxSubsteps; ++i) {
    const Vec3 wanted = target - now.tip;
    const double far = length(wanted);
    const Vec3 next = far > kSubstepMm ? now.tip + wanted * (kSubstepMm / far) : target;
    const NearBones met = model.contact.hulls_met(near, {next, now.shaft});
    const detail::Resolved resolved = model.contact.push_out(met, {next, now.shaft});
    if (resolved.is_wedged) {
      ++faults.unresolved_contacts;
      return;
    }
    // A tip that the spinning driver does not turn bites: it stays while the pull along the surface
    // is within the friction cone about the last contact.
    if (!resolved.is_free && spent.touched_label != 0 && !spent.forward_is_held) {
      const double pressed = -dot(target - now.tip, spent.contact_normal);
      const Vec3 along = target - now.tip + spent.contact_normal * pressed;
      if (pressed > 0 && length(along) <= instruments::kTipFriction * pressed &&
          model.contact.push_out(met, {now.tip, now.shaft}).is_free) {
        return;
      }
    }
    const double moved = distance(resolved.tip, now.tip);
    const double nearer = far - distance(resolved.tip, target);
    now.tip = resolved.tip;
    if (far <= kArrivedMm || moved < kNoProgressMm || nearer < kNoProgressMm) return;
  }
}

void World::State::rest_or_engage(const Model& model,
                                  const NearBones& near,
                                  const Input& input) noexcept {
  const SurfacePoint surface = model.contact.surface_at(near, now.tip);
  const bool is_touching = surface.is_near && surface.distance_mm <= kTouchingMm;
  const std::uint8_t label = is_touching ? surface.label : std::uint8_t{0};
  if (label != 0 && label != spent.touched_label) {
    emit(EventKind::TouchedBone, label, 0.0);
  }
  spent.touched_label = label;
  spent.contact_normal = is_touching ? surface.normal_in_patient : Vec3{};
  if (!is_touching) return;
  const bool is_scaphoid =
      label == static_cast<std::uint8_t>(BoneId::Scaphoid) || label == kScaphoidDistalLabel;
  if (is_scaphoid) complete(Step::Entry);
  if (input.driver != Driver::Forward || input.thrust_n < kEngageThrustN) return;
  const double steepness = dot(now.shaft, surface.normal_in_patient);
  if (steepness >= instruments::kSkatingCosine) {
    engage(model, surface);
    return;
  }
  // Too flat: the tip walks along the surface, the way it is pushed.
  const Vec3 along = surface.normal_in_patient * steepness - now.shaft;
  now.tip += normalized_or(along, {}) * (instruments::kSkatingMmPerS * kTickSeconds);
  if (!spent.slip_is_told) emit(EventKind::Slipped, label, 0.0);
  spent.slip_is_told = true;
}

void World::State::engage(const Model& model, const SurfacePoint& surface) noexcept {
  save_checkpoint();
  now.wire = WireLine{};
  now.wire.engaged = true;
  now.wire.origin = now.tip;
  now.wire.direction = -now.shaft;
  ++now.passes;
  emit(EventKind::WireEngaged, surface.label, 0.0);
  const bool is_scaphoid = surface.label == static_cast<std::uint8_t>(BoneId::Scaphoid) ||
                           surface.label == kScaphoidDistalLabel;
  if (is_scaphoid) enter_scaphoid(model);
}

void World::State::enter_scaphoid(const Model& model) noexcept {
  now.wire.in_scaphoid = true;
  now.wire.entry_at_mm = now.wire.travel_mm;
  now.wire.chord_mm = model.chord_mm(entry(), now.wire.direction);
  complete(Step::Aim);
}

void World::State::drive_wire(const Model& model, const Input& input) noexcept {
  now.shaft = -now.wire.direction;
  const Vec3 ahead = wire_tip() + now.wire.direction * kLookAheadMm;
  const double hu = sample_at(model.ct, ahead, kSoftTissueHu);
  const double resistance = instruments::wire_resistance_n(hu);
  if (input.driver == Driver::Forward) {
    const double feed = instruments::wire_feed_mm_per_s(input.thrust_n, resistance);
    now.wire.travel_mm = std::min(now.wire.travel_mm + feed * kTickSeconds, kDeepestMm);
    snapshot.resistance_n = std::min(input.thrust_n, resistance);
  } else if (input.driver == Driver::Reverse && !spent.reverse_is_held) {
    now.wire.travel_mm -= instruments::kWithdrawMmPerS * kTickSeconds;
    snapshot.resistance_n = 0.0;
    if (now.wire.travel_mm <= 0.0) return withdraw();
  } else {
    snapshot.resistance_n = std::min(input.thrust_n, resistance);
  }
  note_tip(model);
  now.tip = wire_tip();
}

/// What the tip has come into or out of.
void World::State::note_tip(const Model& model) noexcept {
  WireLine& wire = now.wire;
  const SurfacePoint at_tip = model.contact.surface_at(wire_tip());
  const bool is_in_bone = at_tip.is_near && at_tip.distance_mm < 0.0;
  const bool is_scaphoid = at_tip.label == static_cast<std::uint8_t>(BoneId::Scaphoid) ||
                           at_tip.label == kScaphoidDistalLabel;
  if (is_in_bone && is_scaphoid && !wire.in_scaphoid) enter_scaphoid(model);
  if (is_in_bone && !is_scaphoid && at_tip.distance_mm < -kWrongBoneMm &&
      (wire.wrong_bones >> at_tip.label & 1U) == 0) {
    wire.wrong_bones |= 1U << at_tip.label;
    now.wrong_bones |= 1U << at_tip.label;
    emit(EventKind::WrongBone, at_tip.label, 0.0);
  }
  if (!wire.in_scaphoid) return;
  const double beyond = depth_mm() - wire.chord_mm;
  if (beyond > kFarExitMm && !wire.has_left) {
    wire.has_left = true;
    ++now.far_exits;
    emit(EventKind::WireLeftBone, static_cast<std::int32_t>(BoneId::Scaphoid), beyond);
  }
  if (beyond <= 0.0) wire.has_left = false;
  if (beyond > now.far_exit_mm) now.far_exit_mm = beyond;
}

void World::State::withdraw() noexcept {
  now.tip = now.wire.origin;
  now.wire = WireLine{};
  now.measured_mm = -1.0;
  // What was done on that line is to be done again.
  now.completed_steps &= ~(detail::step_bit(Step::Aim) | detail::step_bit(Step::Drive) |
                           detail::step_bit(Step::Check) | detail::step_bit(Step::Measure) |
                           detail::step_bit(Step::Choose) | detail::step_bit(Step::Insert));
  spent.touched_label = 0;
  emit(EventKind::WireWithdrawn, 0, 0.0);
}

}  // namespace carpus::simulation
