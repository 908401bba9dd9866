// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Which steps of the procedure are done: its own predicates on the facts of this tick.
#include <algorithm>
#include <cstdint>

#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {

using detail::bit_of;
using detail::Item;

procedure::LineFacts World::State::facts_of(const Model& model, const Item& item) const noexcept {
  procedure::LineFacts facts;
  facts.instrument = item.instrument;
  facts.body = item.body;
  facts.in_hand = item.hand != kNoHand;
  facts.in_target = item.in_target;
  facts.entry_in_bone = entry_in_bone(item);
  const std::uint8_t aim = model.opening.aim.body;
  if (item.is_fixed() && aim != procedure::kNoBody) {
    const Vec3 entry = (poses[item.body] * Point<frame::Bone>{facts.entry_in_bone}).v;
    facts.from_aim_mm =
        length(entry - (poses[aim] * Point<frame::Bone>{model.opening.aim.entry}).v);
  }
  facts.direction_in_bone = item.direction_in_bone;
  facts.depth_mm = item.depth_mm();
  facts.chord_mm = item.chord_mm;
  facts.was_flush = item.was_flush;
  const bool is_wire = kind_of(model, item).work == instruments::Work::Drill;
  facts.far_end_is_out = is_wire && is_far_end_out(model, item);
  facts.near_end_out_mm = item.length_mm - item.depth_mm();
  if (kind_of(model, item).work == instruments::Work::Thread) {
    facts.buried_mm = buried_mm(model, item);
  }
  return facts;
}

void World::State::gather(const Model& model, Facts& facts) const noexcept {
  procedure::Situation& situation = facts.situation;
  std::size_t count = 0;
  for (const Item& item : now.items) {
    if (item.is_there() && item.is_fixed()) facts.lines[count++] = facts_of(model, item);
  }
  situation.lines = {facts.lines.data(), count};
  situation.tick = spent.tick;
  for (std::size_t h = 0; h < kHands; ++h) {
    const std::uint8_t held = now.held[h];
    if (held >= kMaxItems) continue;
    const std::uint8_t body = spent.hands[h].touched_body;
    const bool in_target = body != kNoBody && (model.kinds.target & bit_of(body)) != 0;
    situation.hands[h] = {now.items[held].instrument, body, in_target};
  }
  situation.shots = {shots.data(), spent.shot_count};
  situation.completed_steps = now.completed_steps;
  situation.gauge_reading_mm = now.gauge_reading_mm;
  situation.reamed_mm = now.reamed_mm;
  situation.wrist = spent.wrist;
  situation.fracture = fracture_now(model);
  situation.judgement = spent.judgement;
  situation.aim = model.opening.aim;
  situation.scope = scope_facts(model);
  situation.making = making_facts(model);
  situation.is_finishing = is_finishing;
}

void World::State::tick_off_steps(const Model& model) noexcept {
  Facts facts;
  gather(model, facts);
  const std::vector<procedure::Step>& steps = model.procedure.steps;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const std::uint32_t bit = 1U << i;
    const procedure::Step& step = steps[i];
    facts.situation.completed_steps = now.completed_steps;
    const std::size_t since =
        i == 0 ? 0 : std::min<std::size_t>(now.shots_at_completion[i - 1], spent.shot_count);
    facts.situation.recent_shots = facts.situation.shots.subspan(since);
    if ((now.completed_steps & bit) != 0) {
      if (step.is_lost != nullptr && step.is_lost(facts.situation)) now.completed_steps &= ~bit;
    } else if (step.is_done(facts.situation)) {
      now.completed_steps |= bit;
      if (spent.first_done[i] == 0) spent.first_done[i] = spent.tick;
      now.shots_at_completion[i] = static_cast<std::uint16_t>(spent.shot_count);
      emit(EventKind::StepCompleted, kNoItem, static_cast<std::int32_t>(i), 0.0);
    }
  }
}

}  // namespace carpus::simulation
