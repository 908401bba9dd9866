// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Undo: instruments come back from copies of their plain state, bone by what changed. What was
// spent, and the harm that was done, stays.
#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {
namespace {

/// Ink and cuts; of procedures that make no portals nothing. A portal that is made stays, and so do
/// the cuts for it, which are the first ones.
void bring_worked_back(detail::MakingState& making, const detail::Worked& before) noexcept {
  const detail::Worked later = making.worked;
  making.worked = before;
  for (std::uint8_t c = 0; c < later.cut_count && later.cuts[c].portal < making.facts.made; ++c) {
    making.worked.cuts[c] = later.cuts[c];
    if (c >= making.worked.cut_count) making.worked.cut_count = static_cast<std::uint8_t>(c + 1);
  }
}

}  // namespace

void World::State::save_checkpoint() noexcept {
  if (checkpoint_count == checkpoints.size()) {  // the oldest is forgotten
    for (std::size_t i = 1; i < checkpoints.size(); ++i) {
      checkpoints[i - 1] = checkpoints[i];
      passes_at_checkpoint[i - 1] = passes_at_checkpoint[i];
      worked_at_checkpoint[i - 1] = worked_at_checkpoint[i];
    }
    --checkpoint_count;
  }
  passes_at_checkpoint[checkpoint_count] = spent.pass_count;
  worked_at_checkpoint[checkpoint_count] = making.worked;
  checkpoints[checkpoint_count++] = now;
  tissue.cuts().checkpoint();
}

void World::State::forget_checkpoints() noexcept {
  checkpoint_count = 0;
  tissue.cuts().forget_checkpoints();
}

std::size_t World::State::checkpoint_before(std::size_t step) const noexcept {
  std::size_t kept = checkpoint_count;
  while (kept > 0 && (checkpoints[kept - 1].completed_steps >> step & 1U) != 0) --kept;
  return kept;
}

std::uint32_t World::State::returnable_steps() const noexcept {
  std::uint32_t not_done = 0;
  for (std::size_t i = 0; i < checkpoint_count; ++i) not_done |= ~checkpoints[i].completed_steps;
  return spent.ended == 0 ? now.completed_steps & not_done : 0;
}

void World::State::undo(const Model& model) noexcept {
  go_back_to(model, checkpoint_count - 1);
  emit(EventKind::Undone, kNoItem, 0, 0.0);
}

void World::State::return_to_step(const Model& model, std::uint8_t step) noexcept {
  go_back_to(model, checkpoint_before(step) - 1);
  emit(EventKind::Undone, kNoItem, step + 1, 0.0);
}

/// @param kept  checkpoints that are left; the one after them is where it goes back to.
void World::State::go_back_to(const Model& model, std::size_t kept) noexcept {
  bool has_bone_come_back = false;
  for (; checkpoint_count > kept; --checkpoint_count) {
    has_bone_come_back = tissue.cuts().undo() || has_bone_come_back;
  }
  // What jaws hold is not undone: it would come out with the hand that goes back.
  for (std::size_t i = 0; i < model.float_count; ++i) {
    if (loose_state.bodies[i].hand != kNoHand) let_go_of_loose(model, i);
  }
  now = checkpoints[kept];
  bring_worked_back(making, worked_at_checkpoint[kept]);
  for (std::size_t i = passes_at_checkpoint[kept]; i < spent.pass_count && i < detail::kMaxPasses;
       ++i) {
    spent.passes[i].was_undone = true;
  }
  if (has_bone_come_back) ++spent.tissue_revision;
  ++spent.undos;
  scene.forget();
  pose_bodies(model);  // fragments are back, and the wrist may have moved since
  carry_fixed_items();
  find_portals(model);
}

}  // namespace carpus::simulation
