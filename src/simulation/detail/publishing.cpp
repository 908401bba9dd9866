// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The snapshot, the force and the hash that each tick leaves.
#include <cstdint>

#include "core/state_hash.hpp"
#include "simulation/detail/wire_bend.hpp"
#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {

using detail::Item;

namespace {

/// Adds every field that it is shown, in that order.
struct HashFields {
  StateHash& hash;
  void operator()(const Vec3& v) const noexcept {
    hash.add(v.x);
    hash.add(v.y);
    hash.add(v.z);
  }
  void operator()(double value) const noexcept { hash.add(value); }
  template <typename T>
  void operator()(const T& value) const noexcept {
    hash.add(static_cast<std::uint64_t>(value));
  }
};

}  // namespace

void World::State::publish_item(const Model& model, std::size_t index) noexcept {
  const Item& item = now.items[index];
  ItemView& view = snapshot.items[index];
  view = ItemView{};
  if (!item.is_there()) return;
  view.instrument = item.instrument;
  view.hand = item.hand;
  view.body = item.body;
  view.wire = item.wire;
  view.tip_in_patient = item.tip;
  view.shaft_in_patient = item.shaft;
  view.length_mm = item.length_mm;
  view.bent_at_mm = item.length_mm;
  view.outer_shaft_in_patient = item.shaft;
  if (!item.is_fixed()) return;
  view.in_target = item.in_target;
  view.entry_in_patient = (poses[item.body] * Point<frame::Bone>{entry_in_bone(item)}).v;
  view.depth_mm = item.depth_mm();
  view.by_far_end = item.by_far_end;
  if (kind_of(model, item).work == instruments::Work::Drill) {
    view.near_end_is_out = is_near_end_out(model, item);
    view.far_end_is_out = is_far_end_out(model, item);
    view.bend_rad = item.bend_rad;
    if (item.bend_rad > 0.0) {
      view.bent_at_mm = item.travel_mm - item.first_bone_at_mm();
      const Vec3 aside = (poses[item.body] * Direction<frame::Bone>{item.bend_in_bone}).v;
      view.outer_shaft_in_patient = detail::bent(item.shaft, aside, item.bend_rad);
    }
  }
  if (kind_of(model, item).work == instruments::Work::Thread) {
    view.buried_mm = buried_mm(model, item);
  }
  // Only what is driven changes from tick to tick.
  const Touched at_tip = surface_at(item.tip);
  view.tip_body = at_tip.body != kNoBody && at_tip.distance_mm <= 0.0 ? at_tip.body : kNoBody;
  view.tip_hu = density_hu(model, item.tip);
}

void World::State::publish_hand(const Model& model, std::size_t hand) noexcept {
  detail::HandState& held = spent.hands[hand];
  HandView& view = snapshot.hands[hand];
  view.item = now.held[hand];
  const Item* item = in_hand(hand);
  const bool is_free = item != nullptr && !item->is_fixed();
  view.touching = is_free && held.touched_body != kNoBody;
  view.touched_body = view.touching ? held.touched_body : kNoBody;
  view.contact_normal_in_patient = view.touching ? held.contact_normal : Vec3{};
  const Vec3& wish = held.plan.tip;
  view.contact_depth_mm = view.touching ? distance(wish, item->tip) : 0.0;
  view.force_in_patient = {};
  scope_state.felt[hand] = {};
  if (item == nullptr) {
    held.coupling.release(wish);
    return;
  }
  // The hand is tied to where its instrument could go: free, to beside the bone; in bone to its
  // line, along which it goes as far as the bone lets it.
  view.force_in_patient = held.coupling.force_n(item->tip, wish, haptics::kForceLimitN);
  // In joints walls and tissue move a tip by themselves; recordings of bone keep their forces.
  if (enters_joints(model, *item) && item->tip == wish) held.coupling.let_go();
  view.force_in_patient += hook_force(model, hand);
  scope_state.felt[hand] = view.force_in_patient;
  faults.forces_zeroed += held.coupling.take_faults();
}

/// All but what the hands feel, which belongs to the tick that made it.
void World::State::publish_state(const Model& model) noexcept {
  snapshot.tick = spent.tick;
  snapshot.completed_steps = now.completed_steps;
  const auto& steps = model.procedure.steps;
  // What was left out before a step that passes over it cannot be made up for any more.
  std::size_t current = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (steps[i].passes_over_earlier && (now.completed_steps >> i & 1U) != 0) current = i;
  }
  while (current < steps.size() && (now.completed_steps >> current & 1U) != 0) ++current;
  snapshot.step = static_cast<std::uint8_t>(spent.ended != 0 ? steps.size() : current);
  for (std::size_t i = 0; i < kMaxItems; ++i) publish_item(model, i);
  if (model.map != nullptr) publish_sheets(model);
  for (std::size_t b = 0; b < snapshot.body_count; ++b) snapshot.patient_from_bone[b] = poses[b];
  snapshot.wrist = spent.wrist;
  if (snapshot.tissue_revision != spent.tissue_revision ||
      snapshot.track_count != now.track_count) {
    snapshot.tracks = now.tracks;
    snapshot.track_count = now.track_count;
    snapshot.tissue_revision = spent.tissue_revision;
  }
  snapshot.gauge_reading_mm = now.gauge_reading_mm;
  snapshot.holding_share = now.holding_share;
  snapshot.compression_n = now.compression_n;
  snapshot.passes = spent.pass_count;
  snapshot.judgement = spent.judgement;
  snapshot.c_arm = spent.c_arm;
  snapshot.shots = spent.shot_count;
  snapshot.looks = spent.looks;
  snapshot.pulses = spent.pulses;
  snapshot.dose_units = spent.dose_units;
  snapshot.tube = spent.tube;
  publish_scope(model);
  publish_skin(model);
  snapshot.aids = spent.aids;
  snapshot.undos = spent.undos;
  snapshot.can_undo = checkpoint_count > 0 && spent.ended == 0;
  snapshot.returnable_steps = returnable_steps();
  snapshot.finished = spent.ended != 0;
}

void World::State::publish(const Model& model) noexcept {
  for (std::size_t h = 0; h < kHands; ++h) publish_hand(model, h);
  publish_state(model);
}

void World::State::update_hash(const Model& model) noexcept {
  StateHash hash;
  hash.add(model.seed);
  hash.add(static_cast<std::uint64_t>(model.mode));
  // Where nothing was prepared hashes stay as they were before anything could be.
  if (model.prepared) {
    hash.add(model.prepared->seed);
    for (const std::uint8_t grade : model.prepared->grades) hash.add(std::uint64_t{grade});
  }
  const HashFields fields{hash};
  visit(now, fields);
  visit(spent, fields);
  // A case without structures keeps the hashes that it had before there were any.
  if (structure_state.count > 0) visit(structure_state, fields);
  // Nor do procedures in which nothing enters joints.
  if (model.map != nullptr) {
    visit(scope_state, fields);
    for (std::size_t s = 0; s < model.sheets.size(); ++s) {
      yielding::NetState::visit(sheets[s], model.sheets[s].net.size(), fields);
    }
    if (scope_state.look_count > 0) detail::visit_look(looks[scope_state.look_count - 1], fields);
    if (model.procedure.drill) visit(drill_state, fields);
    if (model.float_count > 0) visit(loose_state, fields);
    if (!model.pieces().empty()) visit(shaving_state, fields);
    if (model.has_punch) visit(punch_state, fields);
    if (model.procedure.fluid) visit(fluid, fields);
    if (model.procedure.controls_screw) visit(screw_state, fields);
    if (model.makes_portals()) visit(making, fields);
    if (model.goes_in_by_own()) visit_ways(making, fields);
  }
  if (spent.shot_count > 0) detail::visit_shot(shots[spent.shot_count - 1], fields);
  tissue.cuts().add_to(hash);
  for (const HandView& hand : snapshot.hands) fields(hand.force_in_patient);
  spent.hash = hash.value();
  snapshot.state_hash = spent.hash;
}

}  // namespace carpus::simulation
