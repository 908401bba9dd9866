// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A world's state as bytes, for keyframes: every field in the order of its struct's visit(), all
// little-endian (of structures only where the case has any, of a scope only in an arthroscopy, of
// its exercises and what floats where there are any), then the tissue's changes, then a checksum.
// Undo does not reach back before one.
#include <algorithm>
#include <bit>
#include <cstdint>
#include <memory>
#include <type_traits>

#include "core/state_hash.hpp"
#include "simulation/detail/bytes.hpp"
#include "simulation/detail/possible_counts.hpp"
#include "simulation/detail/possible_state.hpp"
#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {

namespace {

struct WriteFields {
  detail::Writer& out;
  void operator()(const Vec3& v) const {
    out.put(v.x);
    out.put(v.y);
    out.put(v.z);
  }
  void operator()(double value) const { out.put(value); }
  template <typename T>
  void operator()(const T& value) const {
    out.put(static_cast<std::uint64_t>(value), sizeof(T));
  }
};

/// Refuses numbers that are not finite: no tick left them.
struct ReadFields {
  detail::Reader& in;
  bool& is_sound;
  void operator()(double& value) const {
    value = in.get_double();
    is_sound = is_sound && is_finite(Vec3{value, 0, 0});
  }
  void operator()(Vec3& v) const {
    (*this)(v.x);
    (*this)(v.y);
    (*this)(v.z);
  }
  template <typename T>
  void operator()(T& value) const {
    const std::uint64_t bits = in.get(sizeof(T));
    if constexpr (std::is_same_v<T, bool>) {
      is_sound = is_sound && bits <= 1;
      value = bits != 0;
    } else {
      value = static_cast<T>(bits);
    }
  }
};

}  // namespace

std::vector<std::byte> World::write_state() const {
  const State& state = *state_;
  detail::Writer out;
  const WriteFields fields{out};
  visit(state.now, fields);
  visit(state.spent, fields);
  if (state.structures.size() > 0) visit(state.structure_state, fields);
  if (model_->map != nullptr) {
    visit(state.scope_state, fields);
    visit(state.conduct, fields);
    for (std::size_t s = 0; s < model_->sheets.size(); ++s) {
      yielding::NetState::visit(state.sheets[s], model_->sheets[s].net.size(), fields);
    }
    for (std::size_t i = 0; i < state.scope_state.look_count; ++i) {
      detail::visit_look(state.looks[i], fields);
    }
    if (model_->procedure.drill) visit(state.drill_state, fields);
    if (model_->float_count > 0) visit(state.loose_state, fields);
    if (!model_->pieces().empty()) visit(state.shaving_state, fields);
    if (model_->has_punch) visit(state.punch_state, fields);
    if (model_->procedure.fluid) visit(state.fluid, fields);
    if (model_->procedure.controls_screw) visit(state.screw_state, fields);
    if (model_->makes_portals()) visit(state.making, fields);
    if (model_->goes_in_by_own()) visit_ways(state.making, fields);
  }
  for (std::size_t i = 0; i < state.spent.shot_count; ++i) {
    detail::visit_shot(state.shots[i], fields);
  }
  state.tissue.cuts().write_to(out.bytes());
  StateHash hash;
  hash.add_bytes(out.bytes());
  out.put(hash.value(), 8);
  return std::move(out.bytes());
}

Result<bool> World::read_state(std::span<const std::byte> bytes) {
  constexpr std::size_t kChecksum = 8;
  if (bytes.size() < kChecksum) return carpus::Refusal{"keyframe: cut off"};
  const std::span<const std::byte> body = bytes.first(bytes.size() - kChecksum);
  StateHash hash;
  hash.add_bytes(body);
  detail::Reader end(bytes.last(kChecksum));
  if (end.get(8) != hash.value())
    return carpus::Refusal{"keyframe: damaged, its checksum does not match"};

  // A State takes megabytes: it is made for what was looked at.
  const auto now = std::make_unique<detail::Operated>();
  const auto spent = std::make_unique<detail::Spent>();
  detail::Reader in(body);
  bool is_sound = true;
  const ReadFields fields{in, is_sound};
  visit(*now, fields);
  visit(*spent, fields);
  detail::StructureState structures;
  if (state_->structures.size() > 0) visit(structures, fields);
  detail::ScopeState scope;
  detail::ScopeConduct conduct;
  std::array<yielding::NetState, kMaxSheets> sheets;
  detail::DrillState drill;
  detail::LooseState loose;
  detail::ShavingState shaving;
  detail::PunchState punch;
  detail::JointFluid fluid;
  detail::ScrewState screw;
  detail::MakingState making;
  std::vector<procedure::ScopeLook> looks;
  const Tick passed = spent->tick;
  if (model_->map != nullptr) {
    visit(scope, fields);
    visit(conduct, fields);
    for (std::size_t s = 0; s < model_->sheets.size(); ++s) {
      sheets[s].reset(model_->sheets[s].net);
      yielding::NetState::visit(sheets[s], model_->sheets[s].net.size(), fields);
    }
    is_sound = is_sound && detail::is_possible(scope, model_->map->portals.size()) &&
               detail::is_possible(conduct, model_->data.bones.size(), model_->catalogue.size()) &&
               are_counts_possible(scope, passed, *model_->map,
                                   model_->lesions ? model_->lesions->lesions.size() : 0) &&
               are_counts_possible(conduct, passed);
    if (is_sound) looks.resize(scope.look_count);
    for (procedure::ScopeLook& look : looks) detail::visit_look(look, fields);
    if (const auto& declared = model_->procedure.drill) {
      visit(drill, fields);
      is_sound =
          is_sound && detail::is_possible(drill, *declared) && are_counts_possible(drill, passed);
    }
    if (model_->float_count > 0) {
      visit(loose, fields);
      is_sound = is_sound &&
                 detail::is_possible(loose, model_->float_count, model_->map->portals.size()) &&
                 are_counts_possible(loose, passed);
    }
    if (!model_->pieces().empty()) {
      visit(shaving, fields);
      is_sound = is_sound && detail::is_possible(shaving, model_->pieces()) &&
                 are_counts_possible(shaving, passed);
    }
    if (model_->has_punch) {
      visit(punch, fields);
      is_sound = is_sound && detail::is_possible(punch, model_->map->joints.size()) &&
                 are_counts_possible(punch, passed);
    }
    if (model_->procedure.fluid) {
      visit(fluid, fields);
      is_sound = is_sound &&
                 detail::is_possible(fluid, detail::FluidTable::generic(),
                                     model_->map->joints.size(), model_->map->portals.size()) &&
                 are_counts_possible(fluid, passed);
    }
    if (model_->procedure.controls_screw) {
      visit(screw, fields);
      is_sound = is_sound && detail::is_possible(screw);
    }
    if (model_->makes_portals()) {
      visit(making, fields);
      is_sound = is_sound && detail::is_possible(making);
    }
    if (model_->goes_in_by_own()) {
      visit_ways(making, fields);
      is_sound = is_sound && detail::are_possible_ways(making, model_->map->joints.size());
    }
    is_sound = is_sound && are_counts_possible(making, passed);
  }
  const detail::StateBounds bounds{model_->data.bones.size(),
                                   model_->catalogue.size(),
                                   model_->procedure.steps.size(),
                                   model_->data.hand_motion.limits,
                                   model_->centres,
                                   model_->kinds.fragments,
                                   model_->kinds.target};
  is_sound = is_sound && !in.is_spoilt() && detail::is_possible(*now, *spent, bounds) &&
             detail::is_possible(structures, state_->structures.size(), bounds.instruments);
  if (!is_sound) return carpus::Refusal{"keyframe: its state is not one that a tick could leave"};
  auto next = std::make_unique<State>(*model_);
  next->now = *now;
  next->spent = *spent;
  next->structure_state = structures;
  next->scope_state = scope;
  next->conduct = conduct;
  next->drill_state = drill;
  next->loose_state = loose;
  next->shaving_state = shaving;
  next->punch_state = punch;
  next->fluid = fluid;
  next->screw_state = screw;
  next->making = making;
  if (model_->map != nullptr) next->sheets = sheets;
  next->cut_disc_as_left(*model_);
  std::copy(looks.begin(), looks.end(), next->looks.begin());
  for (std::size_t i = 0; i < next->spent.shot_count; ++i) {
    detail::visit_shot(next->shots[i], fields);
  }
  const std::span<const procedure::Shot> shots(next->shots.data(), next->spent.shot_count);
  if (!is_sound || in.is_spoilt() || !detail::are_possible(shots, next->spent)) {
    return carpus::Refusal{"keyframe: its shots are cut off or do not add up"};
  }
  const Result<std::size_t> tissue = next->tissue.cuts().read_from(body.subspan(in.at()));
  if (!tissue) return carpus::Refusal{"keyframe: " + tissue.error()};
  next->pose_bodies(*model_);
  next->lay_sheets(*model_);
  next->carry_fixed_items();
  for (std::uint8_t h = 0; h < kHands; ++h) {
    if (const detail::Item* item = next->in_hand(h)) {
      next->scene.set_instrument(h, next->kind_of(*model_, *item).shape);
    }
  }
  next->snapshot.state_hash = next->spent.hash;
  next->publish_state(*model_);
  state_ = std::move(next);
  return true;
}

}  // namespace carpus::simulation
