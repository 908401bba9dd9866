// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One tick: quantise and check the input -> move the wrist and its bones -> carry out the command
// -> look through the C-arm -> move what each hand holds (free, or along its line in bone) ->
// see what turns near a structure -> tick off steps -> force, limited last -> snapshot and hash.
#include "simulation/world.hpp"

#include <algorithm>
#include <cstdint>

#include "simulation/c_arm_angles.hpp"
#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {

using detail::absolute;
using detail::Item;

namespace {

constexpr double kWorkspaceMm = 1000.0;    // beyond this from the CT's origin a tip makes no sense
constexpr double kGreatestThrustN = 60.0;  // protocol/protocol.json
constexpr double kGreatestShaft = 4.0;     // by component, before it is normalised

}  // namespace

World::State::State(const Model& model) : ChangingData(model.data, model.fields) {
  structure_state.count = static_cast<std::uint8_t>(structures.size());
  snapshot.body_count = static_cast<std::uint8_t>(model.data.bones.size());
  snapshot.mode = model.mode;
  snapshot.seed = model.seed;
  snapshot.prepared = model.prepared;
  scene.set_cuts(tissue.cuts().fields());
  for (std::size_t s = 0; s < model.sheets.size(); ++s) {
    sheets[s].reset(model.sheets[s].net);
    has_sheet_moved[s] = true;
  }
  loose_state.done.there = static_cast<std::uint8_t>(model.float_count);
  shaving_state = detail::untouched(model.pieces());
  cut_disc_as_left(model);
  if (model.procedure.fluid) fluid = detail::fluid_at_first(detail::FluidTable::generic());
}

/// Until the first input the first instrument waits where the procedure says, outside all tissue: a
/// host that holds it there must not start with it across the bones.
void World::State::open(const Model& model) noexcept {
  spent.wrist = model.data.hand_motion.limits.clamp(model.opening.at_first ? *model.opening.at_first
                                                                           : model.opening.wrist);
  // PA over the forearm as it lies, as at the procedure's beginning.
  spent.c_arm.rotation_deg = room_rotation_deg(0.0, spent.wrist.pronation_rad);
  pose_bodies(model);
  lay_sheets(model);
  Item& first = now.items[0];
  first.instrument = model.procedure.tray.front();
  first.length_mm = model.catalogue[first.instrument].length_mm;
  first.hand = 0;
  const detail::BodyPose& target = poses[detail::first_of(model.kinds.target)];
  first.tip = (target * Point<frame::Bone>{model.opening.tip_in_target}).v;
  first.shaft =
      normalized_or((target * Direction<frame::Bone>{model.opening.shaft_in_target}).v, {0, 0, 1});
  now.held[0] = 0;
  scene.set_instrument(0, kind_of(model, first).shape);
  for (detail::HandState& hand : spent.hands) {
    hand.wish.tip_in_patient = first.tip;
    hand.wish.shaft_in_patient = first.shaft;
    hand.plan = resting_at(first.tip, first.shaft);
  }
  publish(model);
}

HandInput World::State::checked(std::size_t hand, const HandInput& raw) noexcept {
  HandInput input = raw;
  const detail::HandState& held = spent.hands[hand];
  bool is_bad = false;
  const Vec3& t = raw.tip_in_patient;
  if (!(absolute(t.x) <= kWorkspaceMm && absolute(t.y) <= kWorkspaceMm &&
        absolute(t.z) <= kWorkspaceMm)) {
    input.tip_in_patient = held.wish.tip_in_patient;
    is_bad = true;
  }
  const Vec3& s = raw.shaft_in_patient;
  const bool is_direction = absolute(s.x) <= kGreatestShaft && absolute(s.y) <= kGreatestShaft &&
                            absolute(s.z) <= kGreatestShaft;
  input.shaft_in_patient = is_direction ? normalized_or(s, {0, 0, 0}) : Vec3{};
  if (!(squared_length(input.shaft_in_patient) > 0.5)) {
    input.shaft_in_patient = held.wish.shaft_in_patient;
    is_bad = true;
  }
  if (!(raw.thrust_n >= 0.0 && raw.thrust_n <= kGreatestThrustN)) {
    // A little over the limit is a hand; far over it, or below nothing, is nobody's.
    const bool is_push = raw.thrust_n > kGreatestThrustN && raw.thrust_n <= 10 * kGreatestThrustN;
    input.thrust_n = is_push ? kGreatestThrustN : 0.0;
    is_bad = true;
  }
  if (static_cast<unsigned>(raw.driver) > static_cast<unsigned>(Driver::Reverse)) {
    input.driver = Driver::Off;
    is_bad = true;
  }
  if (static_cast<unsigned>(raw.guidance) > static_cast<unsigned>(Guidance::Planned)) {
    input.guidance = Guidance::Direct;
    is_bad = true;
  }
  if (is_bad) ++faults.bad_inputs;
  return input;
}

void World::State::emit(EventKind kind,
                        std::uint8_t item,
                        std::int32_t detail,
                        double value) noexcept {
  if (snapshot.event_count >= kMaxEventsPerTick) {
    ++faults.lost_events;
    return;
  }
  const InstrumentIndex instrument = item < kMaxItems ? now.items[item].instrument : kNoInstrument;
  snapshot.events[snapshot.event_count++] = {kind, item, instrument, detail, value, spent.tick};
}

void World::State::step(const Model& model, const Input& raw) noexcept {
  snapshot.event_count = 0;
  snapshot.events = {};
  if (spent.ended != 0) return;
  ++spent.tick;
  const Input input = quantised(raw);
  is_finishing = false;
  move_wrist(model, input.wrist);
  for (std::size_t h = 0; h < kHands; ++h) {
    detail::HandState& hand = spent.hands[h];
    snapshot.hands[h].resistance_n = snapshot.hands[h].torque_n_mm = 0.0;
    snapshot.hands[h].ahead = {};
    hand.wish = checked(h, input.hands[h]);
    snapshot.hands[h].thrust_n = hand.wish.thrust_n;
    Item* item = in_hand(h);
    if (!hand.has_wish) {
      // It comes in from behind the hand, so that it starts in no bone.
      hand.plan = resting_at(hand.wish.tip_in_patient, hand.wish.shaft_in_patient);
      if (item != nullptr && !item->is_fixed()) {
        item->shaft = hand.wish.shaft_in_patient;
        item->tip =
            hand.wish.tip_in_patient + item->shaft * kind_of(model, *item).shape.back_z_mm();
      }
      hand.has_wish = true;
    }
    if (hand.wish.driver != Driver::Reverse) hand.reverse_is_held = false;
    // Nothing is lifted over what it lies in.
    const bool is_in_portal = scope_state.portal[h] != kNoBody || making.worked.hands[h].is_in;
    advance(hand.plan, hand.wish, item == nullptr || !(item->is_fixed() || is_in_portal));
  }
  obey(model, input.command);
  look_through(model, input.c_arm);
  lay_sheets(model);
  find_sheets(model);
  for (std::uint8_t h = 0; h < kHands; ++h) {
    const Item* item = in_hand(h);
    if (item == nullptr) continue;
    if (item->is_fixed()) {
      drive(model, h);
    } else if (works_on_skin(model, *item)) {
      move_on_skin(model, h);
    } else {
      move_free(model, h);
    }
  }
  if (model.map != nullptr) yield_sheets(model);
  watch_structures(model);
  watch_scopes(model);
  take_tissue_away(model);
  run_fluid(model);
  move_loose_bodies(model);
  tick_off_steps(model);
  if (is_finishing) {
    spent.ended = static_cast<std::uint8_t>(spent.ended | 1U);
    emit(EventKind::Finished, kNoItem, spent.ended >> 1U, 0.0);
  }
  for (std::uint8_t h = 0; h < kHands; ++h) {
    detail::HandState& hand = spent.hands[h];
    hand.forward_is_held = hand.wish.driver == Driver::Forward;
    const Item* item = in_hand(h);
    const bool is_at_skin = item != nullptr && works_on_skin(model, *item);  // told until it is off
    if (!hand.forward_is_held && !is_at_skin) hand.slip_is_told = false;
  }
  publish(model);
  if (is_hashed) update_hash(model);
}

World::World(const cases::CaseData& data,
             const procedure::Procedure& procedure,
             std::uint64_t seed,
             procedure::Mode mode)
    : World(data, procedure, seed, mode, data.pathology) {}

World::World(const cases::CaseData& data,
             const procedure::Procedure& procedure,
             std::uint64_t seed,
             procedure::Mode mode,
             const std::optional<cases::PreparedPathology>& prepared)
    : model_(std::make_unique<Model>(data, procedure, seed, mode, prepared)),
      state_(std::make_unique<State>(*model_)) {
  state_->open(*model_);
}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

const Snapshot& World::step(const Input& input) noexcept {
  state_->step(*model_, input);
  return state_->snapshot;
}

void World::leave_out_hashes() noexcept { state_->is_hashed = false; }

const Snapshot& World::now() const noexcept { return state_->snapshot; }

procedure::OperationRecord World::operation_record() const {
  const State& state = *state_;
  procedure::OperationRecord record;
  for (const Item& item : state.now.items) {
    if (item.is_there() && item.is_fixed()) record.lines.push_back(state.facts_of(*model_, item));
  }
  for (std::size_t i = 0; i < state.spent.pass_count && i < detail::kMaxPasses; ++i) {
    const detail::PassState& pass = state.spent.passes[i];
    record.passes.push_back({pass.instrument, pass.first_body, pass.bodies_entered,
                             pass.far_exit_mm, pass.far_exits, pass.follower_exit_mm,
                             pass.shortest_exit_mm, pass.was_undone});
  }
  record.shots.assign(state.shots.begin(), state.shots.begin() + state.spent.shot_count);
  for (std::size_t i = 0; i < state.structure_state.count; ++i) {
    const detail::StructureHarm& harm = state.structure_state.harm[i];
    record.structures.push_back({i, harm.least_mm, harm.was_struck, harm.by});
  }
  record.gauge_reading_mm = state.now.gauge_reading_mm;
  record.reamed_mm = state.now.reamed_mm;
  record.holding_share = state.now.holding_share;
  record.fracture = state.fracture_now(*model_);
  if (model_->fracture)
    record.fracture_at_first = procedure::facts_of(model_->fracture->faces.offset({}));
  record.judgement = state.spent.judgement;
  const bool has_moved = std::any_of(state.now.moved.begin(), state.now.moved.end(),
                                     [](const auto& moved) { return !moved.is_none(); });
  for (std::size_t b = 0; has_moved && b < state.snapshot.body_count; ++b) {
    record.displacements.push_back(state.now.moved[b].pose());
  }
  record.compression_n = state.now.compression_n;
  record.stripped_screws = state.spent.stripped_screws;
  if (model_->makes_portals()) record.making = state.making_facts(*model_);
  if (model_->map != nullptr) record.scope = state.scope_record(*model_);
  record.most_bend_rad = state_->spent.most_bend_rad;
  record.broken_wires = state_->spent.broken_wires;
  record.undos = state.spent.undos;
  record.ticks = state.spent.tick;
  record.completed_steps = state.now.completed_steps;
  record.first_done.assign(
      state.spent.first_done.begin(),
      state.spent.first_done.begin() + static_cast<std::ptrdiff_t>(model_->procedure.steps.size()));
  record.unheld_ream_mm = state.spent.unheld_ream_mm;
  record.finished = state.spent.ended != 0;
  record.declined_for = static_cast<std::uint8_t>(state.spent.ended >> 1U);
  record.aids = state.spent.aids;
  record.aids_used = state.spent.aids_used;
  return record;
}

const TickFaults& World::faults() const noexcept { return state_->faults; }
const procedure::Procedure& World::procedure() const noexcept { return model_->procedure; }
procedure::Mode World::mode() const noexcept { return model_->mode; }
std::uint64_t World::seed() const noexcept { return model_->seed; }
const std::optional<cases::PreparedPathology>& World::prepared() const noexcept {
  return model_->prepared;
}
const cases::JointLesions* World::lesions() const noexcept {
  return model_->lesions ? &*model_->lesions : nullptr;
}
const cases::CaseData& World::case_data() const noexcept { return model_->data; }

}  // namespace carpus::simulation
