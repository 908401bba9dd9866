// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is done once: taking and putting down instruments, reading the gauge, undo, finish.
// Whether it may be done is decided in permission.cpp alone.
#include <cstdint>

#include "simulation/detail/world_state.hpp"
#include "simulation/permission.hpp"

namespace carpus::simulation {

using detail::Item;

void World::State::obey(const Model& model, const Command& command) noexcept {
  if (command.kind == CommandKind::None) return;
  const Refusal refusal = why_not(model.procedure, snapshot, command);
  if (refusal != Refusal::None) {
    emit(EventKind::Refused, kNoItem, static_cast<std::int32_t>(refusal), 0.0);
    return;
  }
  switch (command.kind) {
    case CommandKind::None:
      return;
    case CommandKind::TakeShot:
      return take_shot(model, command);
    case CommandKind::Take:
      return take(model, command.hand, command.index);
    case CommandKind::PickUp:
      return pick_up(model, command.hand, command.index);
    case CommandKind::PickUpFarEnd:
      return pick_up_far_end(model, command.hand, command.index);
    case CommandKind::PutDown:
      return put_down(model, command.hand);
    case CommandKind::ReadGauge:
      return read_gauge(model, command.hand);
    case CommandKind::Undo:
      return undo(model);
    case CommandKind::ReturnToStep:
      return return_to_step(model, command.index);
    case CommandKind::UseAid:
      spent.aids = static_cast<std::uint8_t>(spent.aids | (1U << command.index));
      ++spent.aids_used;
      return emit(EventKind::AidUsed, now.held[command.hand], command.index, 0.0);
    case CommandKind::SetTube:
      spent.tube = command.index;
      return;
    case CommandKind::Judge:
      spent.judgement = static_cast<procedure::Judgement>(command.index);
      return emit(EventKind::Judged, kNoItem, command.index, 0.0);
    case CommandKind::Answer: {
      const std::uint8_t grade = command.index % kGradesAFinding;
      scope_state.answers[command.index / kGradesAFinding] =
          grade == kNoGrade ? cases::kNotJudged : grade;
      note_screw_answer(model, command.index / kGradesAFinding);
      return;
    }
    case CommandKind::SetFluid:
      return detail::set(fluid, detail::FluidTable::generic(),
                         static_cast<detail::FluidControl>(command.index / kFluidValues),
                         command.index % kFluidValues);
    case CommandKind::TurnScope:
      scope_state.shaft_turn_deg = command.rotation_deg;
      scope_state.camera_turn_deg = command.tilt_deg;
      return;
    case CommandKind::TurnMouth:
      shaving_state.mouth_deg[command.hand] = command.rotation_deg;
      return;
    case CommandKind::Decline:
      spent.ended = static_cast<std::uint8_t>(command.index << 1U);
      is_finishing = true;
      return;
    case CommandKind::Finish:
      is_finishing = true;
      return;
    case CommandKind::ForgetCheckpoints:
      return forget_checkpoints();
  }
}

void World::State::take(const Model& model,
                        std::uint8_t hand,
                        InstrumentIndex instrument) noexcept {
  const instruments::Instrument& kind = model.catalogue[instrument];
  // Where it appears: where the hand is.
  Vec3 tip = spent.hands[hand].wish.tip_in_patient;
  Vec3 shaft = spent.hands[hand].wish.shaft_in_patient;
  if (const Item* held = in_hand(hand)) {
    tip = held->tip;
    shaft = held->shaft;
  }
  save_checkpoint();
  put_down(model, hand);
  std::uint8_t place = 0;
  while (place < kMaxItems && now.items[place].is_there()) ++place;
  if (place == kMaxItems) return;  // permission.cpp refused before
  Item& item = now.items[place];
  item = Item{};
  item.instrument = instrument;
  item.length_mm = kind.length_mm;
  item.hand = hand;
  now.held[hand] = place;
  item.shaft = normalized_or(shaft, {0, 0, 1});
  item.tip = tip;
  if (kind.bore_radius_mm > 0.0 && !kind.is_sleeve) {
    ride_on(model, item, wire_to_ride_on(model.catalogue, snapshot, instrument));
  } else {
    // It comes in from behind the hand, so that it starts in no bone.
    item.tip = tip + item.shaft * kind.shape.back_z_mm();
  }
  scene.set_instrument(hand, kind.shape);
  making.worked.hands[hand].waits = works_on_skin(model, item);
  emit(EventKind::Taken, place, instrument, 0.0);
}

/// Puts a reamer, gauge or screw over a wire, its tip at the wire's entry.
void World::State::ride_on(const Model& /*model*/, Item& item, std::uint8_t wire) noexcept {
  if (wire >= kMaxItems) return;
  const Item& under = now.items[wire];
  item.wire = wire;
  item.body = under.body;
  item.pass = under.pass;
  item.in_target = under.in_target;
  item.origin_in_bone = under.origin_in_bone;
  item.direction_in_bone = under.direction_in_bone;
  item.entry_at_mm = under.entry_at_mm;
  item.chord_mm = under.chord_mm;
  item.travel_mm = under.entry_at_mm;
  item.cut_to_mm = item.travel_mm;
}

void World::State::pick_up(const Model& model, std::uint8_t hand, std::uint8_t item) noexcept {
  if (Item* held = in_hand(hand)) {  // a free instrument goes back to the tray
    held->hand = kNoHand;
    held->by_far_end = false;
    if (!held->is_fixed()) *held = Item{};
  }
  now.items[item].hand = hand;
  now.held[hand] = item;
  scene.set_instrument(hand, kind_of(model, now.items[item]).shape);  // it will be free again
  emit(EventKind::Taken, item, now.items[item].instrument, 0.0);
}

void World::State::put_down(const Model& model, std::uint8_t hand) noexcept {
  Item* held = in_hand(hand);
  if (held == nullptr) return;
  const std::uint8_t place = now.held[hand];
  const InstrumentIndex instrument = held->instrument;
  leave_skin(hand);
  now.held[hand] = kNoItem;
  held->hand = kNoHand;
  held->by_far_end = false;
  if (!held->is_fixed() || !kind_of(model, *held).stays) {
    *held = Item{};
  } else {
    held->wire = kNoItem;  // it stays by itself; the wire on which it came may go
  }
  spent.hands[hand].touched_body = kNoBody;
  scene.clear_instrument(hand);
  emit(EventKind::PutDown, place, instrument, 0.0);
}

/// By how much farther one wire's tail lies out along the other than its own, had both one length.
double World::State::stands_out_more_mm(const Item& held, const Item& wire) const noexcept {
  const Vec3 tail = held.tip + held.shaft * held.length_mm;
  const Vec3 entry = (poses[wire.body] * Point<frame::Bone>{entry_in_bone(wire)}).v;
  const Vec3 other = entry + wire.shaft * (wire.length_mm - wire.depth_mm());
  return dot(tail - other, wire.shaft) + wire.length_mm - held.length_mm;
}

void World::State::read_gauge(const Model& model, std::uint8_t hand) noexcept {
  const Item& held = *in_hand(hand);
  const Item& wire = now.items[wire_to_measure(model.catalogue, snapshot, hand)];
  const instruments::Instrument& kind = kind_of(model, held);
  // The gauge's foot stands on bone where the wire went in; what of the wire is beyond it is read,
  // to the scale's step, wherever its tip may be. A wire of the same length, held beside it with
  // its tip on the bone, stands out farther by as much.
  constexpr double kRulerStepMm = 0.5;
  const double step = kind.is_gauge ? kind.gauge_step_mm : kRulerStepMm;
  const double beyond_mm = kind.is_gauge ? wire.depth_mm() : stands_out_more_mm(held, wire);
  const double steps = beyond_mm / step + 0.5;
  const auto whole = static_cast<std::int64_t>(steps < 0 ? 0.0 : steps);
  now.gauge_reading_mm = static_cast<double>(whole) * step;
  emit(EventKind::GaugeRead, now.held[hand], 0, now.gauge_reading_mm);
}

}  // namespace carpus::simulation
