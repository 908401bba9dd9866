// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Undo: instruments come back from copies of their plain state, bone by what changed. What was
// spent, and the harm that was done, stays.
#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {

void World::State::save_checkpoint() noexcept {
  if (checkpoint_count == checkpoints.size()) {  // the oldest is forgotten
    for (std::size_t i = 1; i < checkpoints.size(); ++i) {
      checkpoints[i - 1] = checkpoints[i];
      passes_at_checkpoint[i - 1] = passes_at_checkpoint[i];
    }
    --checkpoint_count;
  }
  passes_at_checkpoint[checkpoint_count] = spent.pass_count;
  checkpoints[checkpoint_count++] = now;
  tissue.cuts().checkpoint();
}

void World::State::forget_checkpoints() noexcept {
  checkpoint_count = 0;
  tissue.cuts().forget_checkpoints();
}

void World::State::undo(const Model& model) noexcept {
  --checkpoint_count;
  now = checkpoints[checkpoint_count];
  for (std::size_t i = passes_at_checkpoint[checkpoint_count];
       i < spent.pass_count && i < detail::kMaxPasses; ++i) {
    spent.passes[i].was_undone = true;
  }
  if (tissue.cuts().undo()) ++spent.tissue_revision;
  ++spent.undos;
  scene.forget();
  pose_bodies(model);  // fragments are back, and the wrist may have moved since
  carry_fixed_items();
  emit(EventKind::Undone, kNoItem, 0, 0.0);
}

}  // namespace carpus::simulation
