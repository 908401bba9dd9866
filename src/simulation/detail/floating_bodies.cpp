// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What lies loose in the joints: it floats where the fluid and the instruments take it, jaws take
// hold of it and bring it out, or lose it.
#include <bit>
#include <cstdint>

#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {

using detail::Item;
using detail::kMaxLooseBodies;
using detail::kNoPortal;
using detail::LooseBody;

namespace {

constexpr double kMouthMm = 0.8;     // behind the tip the jaws close
constexpr double kGripMm = 0.9;      // a body's surface so near to there is between them [E]
constexpr double kSqueezedMm = 2.5;  // ... so near it springs away
constexpr double kSpringsMmPerS = 40.0;
constexpr double kBiteMm = 0.6;           // the lining so near is between them [E]
constexpr double kStrippedMmPerS = 15.0;  // drawn faster through the capsule it is lost [E]
constexpr double kInsideMm = 1.0;         // beyond the capsule it lies then
constexpr double kFollowed = 0.01;        // of a held body's speed, a tick
constexpr double kRodMm = 40.0;
constexpr double kOpenJawsMm = 2.0;  // leave a body between them alone

}  // namespace

Vec3 World::State::lesion_middle(const Model& model, std::size_t lesion) const noexcept {
  const cases::Lesion& at = model.lesions->lesions[lesion];
  for (std::size_t i = 0; i < model.float_count; ++i) {
    if (model.floats[i] == lesion) return loose_state.bodies[i].at;
  }
  const Vec3 middle =
      (at.from + at.to) * 0.5 - model.lesions->shift_of(at.body, spent.wrist.traction_n);
  return (poses[at.body] * Point<frame::Bone>{middle}).v;
}

/// Whether the scope in the other hand sees a place in the joint of this one.
bool World::State::is_seen_beside(const Model& model, std::uint8_t hand, const Vec3& at) noexcept {
  return is_seen_beside(model, hand, joint_of(model, scope_state.portal[hand]), at);
}

/// Likewise, in the joint that is said: what came in by no portal.
bool World::State::is_seen_beside(const Model& model,
                                  std::uint8_t hand,
                                  std::uint8_t joint,
                                  const Vec3& at) noexcept {
  const auto other = static_cast<std::uint8_t>(1U - hand);
  const Item* scope = in_hand(other);
  if (scope == nullptr || !scope_state.is_in_joint[other]) return false;
  if (joint != joint_of(model, scope_state.portal[other])) return false;
  const auto sight = sight_of(model, *scope);
  return sight && sees(model, joint, *sight, at);
}

void World::State::watch_jaws(const Model& model, std::uint8_t hand) noexcept {
  const Item* item = in_hand(hand);
  const bool has_jaws = item != nullptr && kind_of(model, *item).has_jaws;
  const Driver wished = spent.hands[hand].wish.driver;
  bool& is_closed = loose_state.are_closed[hand];
  // They lock: a hand that is not heard of for a while loses nothing.
  const bool closes = detail::are_closed_after(is_closed, has_jaws, wished);
  if (closes == is_closed) return;
  is_closed = closes;
  if (closes && scope_state.is_in_joint[hand]) {
    close_jaws(model, hand, *item);
    return;
  }
  if (closes) return;
  for (std::size_t i = 0; i < model.float_count; ++i) {
    if (loose_state.bodies[i].hand == hand) let_go_of_loose(model, i);
  }
}

/// Where it is; in the way out it slips back into the joint.
void World::State::let_go_of_loose(const Model& model, std::size_t which) noexcept {
  LooseBody& body = loose_state.bodies[which];
  body.hand = kNoHand;
  body.velocity = {};
  if (body.is_inside || body.portal >= model.map->portals.size()) return;
  const WayIn way = way_in(model, body.portal);
  body.at = way.skin + way.inwards * (way.capsule_mm + kInsideMm + radius_of(model, which));
  body.is_inside = true;
}

void World::State::close_jaws(const Model& model, std::uint8_t hand, const Item& item) noexcept {
  procedure::LooseFacts& done = loose_state.done;
  ++done.closings;
  if (!is_seen_beside(model, hand, item.tip)) ++done.unseen_closings;
  const std::uint8_t joint = joint_of(model, scope_state.portal[hand]);
  const Vec3 mouth = item.tip + item.shaft * kMouthMm;
  std::size_t nearest = kMaxLooseBodies;
  double least = kSqueezedMm;
  for (std::size_t i = 0; i < model.float_count; ++i) {
    const LooseBody& body = loose_state.bodies[i];
    const cases::Lesion& kind = model.lesions->lesions[model.floats[i]];
    if (body.is_out || body.hand != kNoHand || kind.joint != joint) continue;
    const double far = distance(body.at, mouth) - kind.radius_mm;
    if (far >= least) continue;
    least = far;
    nearest = i;
  }
  const auto emit_of = [&](EventKind kind, std::size_t which) {
    emit(kind, now.held[hand], static_cast<std::int32_t>(which), 0.0);
  };
  if (nearest < kMaxLooseBodies && least <= kGripMm) {
    loose_state.bodies[nearest].hand = hand;
    loose_state.bodies[nearest].at = item.tip - item.shaft * (radius_of(model, nearest) - kMouthMm);
    loose_state.bodies[nearest].velocity = {};
    ++done.catches;
    return emit_of(EventKind::LooseCaught, nearest);
  }
  if (nearest < kMaxLooseBodies) {
    LooseBody& body = loose_state.bodies[nearest];
    body.velocity += normalized_or(body.at - mouth, -item.shaft) * kSpringsMmPerS;
    ++done.slips;
    return emit_of(EventKind::LooseLost, nearest);
  }
  const arthroscopy::OpenedSpace wall = joint_space_at(model, joint, mouth);
  if (!wall.is_near || wall.distance_mm < -kBiteMm) return;
  ++done.bites;
  emit_of(EventKind::TissueBitten, 0);
}

double World::State::radius_of(const Model& model, std::size_t loose) const noexcept {
  return model.lesions->lesions[model.floats[loose]].radius_mm;
}

/// In closed jaws: out through the capsule, if it is not drawn too fast, and the skin.
void World::State::carry_loose(const Model& model, std::size_t which) noexcept {
  LooseBody& body = loose_state.bodies[which];
  const std::uint8_t hand = body.hand;
  const Item* item = in_hand(hand);
  if (item == nullptr || !loose_state.are_closed[hand]) return let_go_of_loose(model, which);
  const double radius_mm = radius_of(model, which);
  const bool was_inside = body.is_inside;
  const Vec3 before = body.at;
  body.at = item->tip - item->shaft * (radius_mm - kMouthMm);
  // Over a tenth of a second: a hand's tremor strips nothing off.
  body.velocity += ((body.at - before) / kTickSeconds - body.velocity) * kFollowed;
  body.is_inside = scope_state.is_in_joint[hand];
  const double drawn = dot(body.velocity, item->shaft);
  const std::uint8_t portal = scope_state.portal[hand];
  if (portal != kNoPortal) body.portal = portal;
  if (was_inside && !body.is_inside && drawn > kStrippedMmPerS) {
    let_go_of_loose(model, which);
    ++loose_state.done.slips;
    emit(EventKind::LooseLost, now.held[hand], static_cast<std::int32_t>(which), 0.0);
    return;
  }
  if (portal != kNoPortal) return;
  body.is_out = true;
  body.hand = kNoHand;
  ++loose_state.done.out;
  loose_state.done.seen_since = 0;
  scope_state.in_view_ticks = {};  // seen again is what is looked at from now on
  emit(EventKind::LooseOut, now.held[hand], static_cast<std::int32_t>(which), 0.0);
}

void World::State::float_loose(const Model& model, std::size_t which) noexcept {
  LooseBody& body = loose_state.bodies[which];
  const cases::Lesion& kind = model.lesions->lesions[model.floats[which]];
  detail::LooseSurroundings around;
  for (std::uint8_t h = 0; h < kHands; ++h) {
    const Item* item = in_hand(h);
    if (item == nullptr || !scope_state.is_in_joint[h] ||
        joint_of(model, scope_state.portal[h]) != kind.joint) {
      continue;
    }
    body.is_afloat = true;
    const instruments::Instrument& tool = kind_of(model, *item);
    const double rod_mm = tool.shape.greatest_radius_mm();
    if (tool.optic) around.flow += detail::inflow_at(item->tip, item->shaft, body.at);
    const bool leaves_alone = tool.has_jaws && !loose_state.are_closed[h];
    const double from_mm = rod_mm + (leaves_alone ? kOpenJawsMm : 0.0);
    detail::push_aside(body, kind.radius_mm, item->tip + item->shaft * from_mm,
                       item->tip + item->shaft * kRodMm, rod_mm);
  }
  if (!body.is_afloat) {
    body.at = (poses[kind.body] * Point<frame::Bone>{kind.from}).v;
    return;
  }
  // The forearm hangs by the fingers: what sinks goes towards it.
  around.down = -(poses[model.map->forearm] * Direction<frame::Bone>{model.map->distal}).v;
  const arthroscopy::OpenedSpace space = joint_space_at(model, kind.joint, body.at);
  around.has_wall = space.is_near && squared_length(space.outwards) > 0.5;
  around.wall_mm = space.distance_mm;
  around.outwards = space.outwards;
  detail::drift(body, kind.radius_mm, around);
}

void World::State::move_loose_bodies(const Model& model) noexcept {
  if (model.map == nullptr || model.float_count == 0) return;
  for (std::uint8_t h = 0; h < kHands; ++h) watch_jaws(model, h);
  for (std::size_t i = 0; i < model.float_count; ++i) {
    if (loose_state.bodies[i].is_out) continue;
    if (loose_state.bodies[i].hand != kNoHand) {
      carry_loose(model, i);
    } else {
      float_loose(model, i);
    }
  }
  if (loose_state.done.out == 0) return;
  for (std::size_t i = 0; i < model.map->points.size(); ++i) {
    if (scope_state.in_view_ticks[i] < detail::kSeenTicks) continue;
    loose_state.done.seen_since |= 1U << model.map->points[i].number;
  }
}

procedure::LooseFacts World::State::loose_facts(const Model& model) const noexcept {
  procedure::LooseFacts facts = loose_state.done;
  for (std::size_t i = 0; i < model.float_count; ++i) {
    if ((scope_state.lesions_seen >> model.floats[i] & 1U) != 0) ++facts.seen;
  }
  return facts;
}

void World::State::publish_loose(const Model& model) noexcept {
  snapshot.scope.are_closed = loose_state.are_closed;
  snapshot.scope.loose_count = 0;
  for (std::size_t i = 0; i < model.float_count; ++i) {
    const LooseBody& body = loose_state.bodies[i];
    if (body.is_out) continue;
    snapshot.scope.loose[snapshot.scope.loose_count++] = {
        static_cast<std::uint8_t>(model.floats[i]), body.hand, body.at};
  }
}

}  // namespace carpus::simulation
