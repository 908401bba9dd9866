// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One tick: check the input -> carry out the command -> move what the hand holds (free wire, wire
// in bone, or screw) -> tick off steps -> force, limited last -> snapshot and hash.
#include "simulation/world.hpp"

#include <algorithm>
#include <array>

#include "anatomy/bone_solid.hpp"
#include "core/error.hpp"
#include "geometry/trilinear.hpp"
#include "haptics/contact_force.hpp"
#include "instruments/drilling_resistance.hpp"
#include "instruments/guide_wire.hpp"
#include "procedure/screw_catalogue.hpp"
#include "simulation/detail/bone_contact.hpp"
#include "simulation/detail/operation_state.hpp"

namespace carpus::simulation {
namespace {

using detail::NearBones;
using detail::Operated;
using detail::Spent;
using detail::SurfacePoint;
using detail::WireLine;
using detail::WirePose;
using procedure::Step;

constexpr double kWorkspaceMm = 1000.0;    // beyond this from the CT's origin a tip makes no sense
constexpr double kGreatestThrustN = 60.0;  // protocol/protocol.json
constexpr double kSubstepMm = 0.25;        // below half the wire's diameter: no tunnelling
constexpr int kMaxSubsteps = 24;           // 6 mm a tick is 6 m/s; a farther target is chased
constexpr double kTurnPerTick = 0.01;      // rad: 0.8 mm at the far end of the wire
constexpr double kTouchingMm = 0.05;       // tip this near the surface counts as resting on it
constexpr double kLookAheadMm = 0.3;       // the trocar's edges cut this far before its middle
constexpr double kDeepestMm = 90.0;        // no wire goes further
constexpr double kWrongBoneMm = 0.3;       // deeper than a scratch
constexpr double kFarExitMm = 0.3;         // voxels of the closed solid are 0.4 mm
constexpr double kEngageThrustN = 1.0;     // less is a touch
constexpr double kDriveDoneShare = 0.6;    // of the line's length inside the scaphoid
constexpr double kGaugeStepMm = 0.5;       // scale of the depth gauge
constexpr double kSoftTissueHu = 40.0;
constexpr double kWaitingMm = 60.0;  // over skin and bones

std::uint32_t bit(Step step) noexcept { return 1U << static_cast<unsigned>(step); }

double absolute(double value) noexcept { return value < 0 ? -value : value; }

}  // namespace

struct World::Model {
  explicit Model(const cases::CaseData& data)
      : posed_case(data), ct(data.ct.view()), contact(data), scaphoid(solid_of(data)) {
    for (const procedure::Screw& screw : procedure::screw_catalogue()) {
      if (screw_count == screw_lengths.size()) break;
      screw_lengths[screw_count++] = screw.length_mm;
    }
  }

  static BoneSolid solid_of(const cases::CaseData& data) {
    std::vector<const TriangleMesh*> fragments;
    for (const cases::Bone* part : cases::scaphoid_parts(data)) fragments.push_back(&part->surface);
    if (fragments.empty()) throw InvalidInput("simulation: the case has no scaphoid to operate on");
    if (data.ct.values().empty()) {
      throw InvalidInput("simulation: the case has no CT; resistance and pictures come from it");
    }
    return BoneSolid(fragments);
  }

  /// Length of the line from `entry` along `direction` inside the scaphoid [mm].
  [[nodiscard]] double chord_mm(const Vec3& entry, const Vec3& direction) const noexcept {
    constexpr double kStepMm = 0.1;
    constexpr int kSteps = 600;
    double last_inside = 0.0;
    for (int i = 1; i <= kSteps; ++i) {
      const double t = i * kStepMm;
      if (scaphoid.contains(entry + direction * t)) last_inside = t;
    }
    return last_inside;
  }

  const cases::CaseData& posed_case;
  GridView<const std::int16_t> ct;
  detail::BoneContact contact;
  BoneSolid scaphoid;
  std::array<double, 256> screw_lengths{};
  std::size_t screw_count = 0;
  procedure::ProcedureId procedure = procedure::ProcedureId::DorsalScaphoidFixation;
  std::uint64_t seed = 0;
};

/// Everything that changes, and what changes it.
struct World::State {
  Operated now;
  Spent spent;
  Snapshot snapshot;
  TickFaults faults;
  haptics::ForceLimiter limiter;
  std::array<procedure::Shot, kMaxShots> shots{};
  std::array<Operated, detail::kMaxCheckpoints> checkpoints{};
  std::size_t checkpoint_count = 0;

  void step(Model& model, const Input& raw) noexcept;

 private:
  [[nodiscard]] Input checked(const Input& raw) noexcept;
  void emit(EventKind kind, std::int32_t detail, double value) noexcept;
  void refuse(CommandKind kind) noexcept;
  void save_checkpoint() noexcept;

  void obey(const Model& model, const Command& command) noexcept;
  void take_shot(const Command& command) noexcept;
  void measure(const Model& model) noexcept;
  void select_screw(const Model& model, std::int32_t index) noexcept;
  void undo() noexcept;
  void finish() noexcept;

  void move_free_wire(Model& model, const Input& input) noexcept;
  void chase(Model& model, const NearBones& near, const Vec3& target) noexcept;
  void turn_towards(const Vec3& shaft) noexcept;
  void rest_or_engage(const Model& model, const NearBones& near, const Input& input) noexcept;
  void engage(const Model& model, const SurfacePoint& surface) noexcept;
  void enter_scaphoid(const Model& model) noexcept;
  void drive_wire(const Model& model, const Input& input) noexcept;
  void note_tip(const Model& model) noexcept;
  void withdraw() noexcept;
  void drive_screw(const Model& model, const Input& input) noexcept;
  void unload_screw() noexcept;

  void tick_off_steps() noexcept;
  [[nodiscard]] bool are_views_enough(std::uint32_t first_shot, bool needs_oblique) const noexcept;
  void complete(Step step) noexcept;
  void publish(const Model& model, const Input& input, const Vec3& hand_velocity) noexcept;
  void publish_wire(const Model& model) noexcept;
  void update_hash(const Model& model) noexcept;

  [[nodiscard]] Vec3 entry() const noexcept {
    return now.wire.origin + now.wire.direction * now.wire.entry_at_mm;
  }
  [[nodiscard]] Vec3 wire_tip() const noexcept {
    return now.wire.origin + now.wire.direction * now.wire.travel_mm;
  }
  [[nodiscard]] double depth_mm() const noexcept {
    return now.wire.travel_mm - (now.wire.in_scaphoid ? now.wire.entry_at_mm : 0.0);
  }
  [[nodiscard]] double buried_mm() const noexcept {
    return now.screw.advance_mm - now.screw.length_mm;
  }
};

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

void World::State::save_checkpoint() noexcept {
  if (checkpoint_count == checkpoints.size()) {  // the oldest is forgotten
    for (std::size_t i = 1; i < checkpoints.size(); ++i) checkpoints[i - 1] = checkpoints[i];
    --checkpoint_count;
  }
  checkpoints[checkpoint_count++] = now;
}

void World::State::obey(const Model& model, const Command& command) noexcept {
  switch (command.kind) {
    case CommandKind::None:
      return;
    case CommandKind::TakeShot:
      return take_shot(command);
    case CommandKind::Measure:
      return measure(model);
    case CommandKind::SelectScrew:
      return select_screw(model, command.index);
    case CommandKind::Undo:
      return undo();
    case CommandKind::Finish:
      return finish();
  }
  refuse(command.kind);
}

void World::State::take_shot(const Command& command) noexcept {
  const bool is_in_range =
      absolute(command.rotation_deg) <= 180.0 && absolute(command.tilt_deg) <= 60.0;
  if (!is_in_range || spent.shot_count >= kMaxShots) return refuse(CommandKind::TakeShot);
  procedure::Shot& shot = shots[spent.shot_count++];
  shot.rotation_deg = command.rotation_deg;
  shot.tilt_deg = command.tilt_deg;
  shot.tick = spent.tick;
  shot.wire_in_bone = (now.completed_steps & bit(Step::Drive)) != 0;
  shot.screw_in = now.screw.index >= 0 && buried_mm() >= 0.0;
  emit(EventKind::ShotTaken, static_cast<std::int32_t>(spent.shot_count), 0.0);
}

void World::State::measure(const Model& /*model*/) noexcept {
  const bool can_read = now.wire.in_scaphoid && !now.wire.has_left && depth_mm() > 0.0;
  if (!can_read) return refuse(CommandKind::Measure);
  const auto steps = static_cast<std::int64_t>(depth_mm() / kGaugeStepMm + 0.5);
  now.measured_mm = static_cast<double>(steps) * kGaugeStepMm;
  emit(EventKind::Measured, 0, now.measured_mm);
}

void World::State::select_screw(const Model& model, std::int32_t index) noexcept {
  const bool is_known = index >= 0 && static_cast<std::size_t>(index) < model.screw_count;
  if (!is_known || !now.wire.in_scaphoid || now.screw.advance_mm > 0.0) {
    return refuse(CommandKind::SelectScrew);
  }
  save_checkpoint();
  now.screw = {index, model.screw_lengths[static_cast<std::size_t>(index)], 0.0, false};
  now.instrument = Instrument::ScrewDriver;
  emit(EventKind::ScrewSelected, index, now.screw.length_mm);
}

void World::State::undo() noexcept {
  if (checkpoint_count == 0) return refuse(CommandKind::Undo);
  now = checkpoints[--checkpoint_count];
  ++spent.undos;
  emit(EventKind::Undone, 0, 0.0);
}

void World::State::finish() noexcept {
  const bool was_verified =
      spent.shot_count > 0 && shots[spent.shot_count - 1].screw_in && buried_mm() >= 0.0;
  if (was_verified && now.screw.index >= 0) complete(Step::Verify);
  complete(Step::Finished);
  spent.finished = true;
  emit(EventKind::Finished, 0, 0.0);
}

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
  now.completed_steps &= ~(bit(Step::Aim) | bit(Step::Drive) | bit(Step::Check) |
                           bit(Step::Measure) | bit(Step::Choose) | bit(Step::Insert));
  spent.touched_label = 0;
  emit(EventKind::WireWithdrawn, 0, 0.0);
}

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
    now.completed_steps &= ~bit(Step::Insert);
  }
  now.shaft = -now.wire.direction;
  now.tip = entry() + now.wire.direction * buried_mm();
}

/// Backed out to the start, the screw comes off and the wire is in the driver again.
void World::State::unload_screw() noexcept {
  now.screw = detail::ScrewOnWire{};
  now.instrument = Instrument::GuideWire;
  now.tip = wire_tip();
  now.completed_steps &= ~(bit(Step::Choose) | bit(Step::Insert));
  spent.reverse_is_held = true;
}

void World::State::complete(Step step) noexcept {
  if ((now.completed_steps & bit(step)) != 0) return;
  now.completed_steps |= bit(step);
  emit(EventKind::StepCompleted, static_cast<std::int32_t>(step), 0.0);
}

/// Whether the shots from `first_shot` on hold two different views, and the oblique if needed.
bool World::State::are_views_enough(std::uint32_t first_shot, bool needs_oblique) const noexcept {
  bool has_two = false;
  bool has_oblique = !needs_oblique;
  for (std::uint32_t i = first_shot; i < spent.shot_count; ++i) {
    const procedure::Shot& shot = shots[i];
    const procedure::Shot& first = shots[first_shot];
    has_two = has_two ||
              absolute(shot.rotation_deg - first.rotation_deg) >= procedure::kDifferentViewDeg ||
              absolute(shot.tilt_deg - first.tilt_deg) >= procedure::kDifferentViewDeg;
    has_oblique = has_oblique || procedure::shows(procedure::View::PronatedOblique,
                                                  shot.rotation_deg, shot.tilt_deg);
  }
  return has_two && has_oblique;
}

void World::State::tick_off_steps() noexcept {
  if ((now.completed_steps & bit(Step::Survey)) == 0 && are_views_enough(0, false)) {
    complete(Step::Survey);
  }
  const bool is_driven = now.wire.in_scaphoid && depth_mm() >= kDriveDoneShare * now.wire.chord_mm;
  if (is_driven && (now.completed_steps & bit(Step::Drive)) == 0) {
    now.shots_before_drive = spent.shot_count;
    complete(Step::Drive);
  }
  if ((now.completed_steps & bit(Step::Drive)) != 0 &&
      (now.completed_steps & bit(Step::Check)) == 0 &&
      are_views_enough(now.shots_before_drive, true)) {
    complete(Step::Check);
  }
  if (now.measured_mm >= 0.0) complete(Step::Measure);
  if (now.screw.index >= 0) complete(Step::Choose);
  if (now.screw.index >= 0 && buried_mm() >= 0.0) complete(Step::Insert);
}

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
  int current = 0;
  while (current < static_cast<int>(Step::Finished) && (now.completed_steps >> current & 1U) != 0) {
    ++current;
  }
  snapshot.step = spent.finished ? Step::Finished : static_cast<Step>(current);
  snapshot.instrument = now.instrument;
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
  const Vec3 dorsal = posed_case.wrist_from_patient.rotation.transposed() * Vec3{0, 0, -1};
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
