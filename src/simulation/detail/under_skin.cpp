// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What goes through the skin goes on straight: a needle by its point anywhere, what is blunt by a
// cut alone. Tissue drags at it both ways, the capsule gives at once, bone stops it.
#include <algorithm>

#include "haptics/virtual_coupling.hpp"
#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {

using detail::Item;
using detail::kNoCut;
using detail::SkinPlace;
using detail::UnderSkin;
using instruments::SkinWork;

namespace {

constexpr double kN = haptics::kContactStiffnessNPerMm;
constexpr double kFastestMm = 2.0;  // a tick
constexpr double kStepMm = 0.2;     // no tunnelling
constexpr double kInJointN = 0.1;   // in a joint nothing drags at it [E]
constexpr double kAgainMm = 1.0;    // drawn back so far, bone can be struck anew
constexpr double kSinksMm = 0.3;    // so deep a blunt tip has slipped into a cut
constexpr double kSlipsMm = 0.02;   // a tick, aside into it: 20 mm/s [E]

}  // namespace

std::optional<std::uint8_t> World::State::joint_at(const Model& model,
                                                   const Vec3& at) const noexcept {
  for (std::uint8_t joint = 0; joint < model.map->joints.size(); ++joint) {
    const arthroscopy::OpenedSpace space = joint_space_at(model, joint, at);
    if (space.is_near && space.distance_mm < 0.0) return joint;
  }
  return std::nullopt;
}

/// Its nearest place, as it lies.
Vec3 World::State::on_cut(const Model& model, std::uint8_t cut, const Vec3& at) const noexcept {
  const Vec3 from = as_it_lies(model, making.worked.cuts[cut].from);
  const Vec3 way = as_it_lies(model, making.worked.cuts[cut].to) - from;
  const double whole = squared_length(way);
  return from + way * (whole > 0.0 ? std::clamp(dot(at - from, way) / whole, 0.0, 1.0) : 0.0);
}

double World::State::cut_length(const Model& model, std::uint8_t cut) const noexcept {
  const detail::SkinCut& made = making.worked.cuts[cut];
  return distance(as_it_lies(model, made.from), as_it_lies(model, made.to));
}

/// The cut that what is so thick slips into here.
std::uint8_t World::State::cut_at(const Model& model,
                                  const Vec3& at,
                                  double radius_mm) const noexcept {
  const procedure::PortalMaking& figures = *model.procedure.making;
  for (std::uint8_t c = 0; c < making.worked.cut_count; ++c) {
    if (cut_length(model, c) + figures.cut_stretch_mm < 2.0 * radius_mm) continue;
    if (distance(at, on_cut(model, c, at)) <= figures.cut_reach_mm) return c;
  }
  return kNoCut;
}

void World::State::come_into_skin(const Model& model,
                                  std::uint8_t hand,
                                  const Vec3& entry) noexcept {
  const Item& item = *in_hand(hand);
  UnderSkin& under = making.worked.hands[hand];
  const std::uint8_t cut = cut_at(model, entry, kind_of(model, item).shape.greatest_radius_mm());
  under = {};
  under.is_in = true;
  under.cut = cut;
  under.portal = static_cast<std::uint8_t>(asked_now());
  under.entry = entry;
  under.towards = -item.shaft;
}

/// What is blunt goes in by the cut and not beside it, from wherever on its rim it slipped.
void World::State::slip_into_cut(const Model& model, UnderSkin& under) const noexcept {
  if (under.cut == kNoCut || under.is_through) return;
  const Vec3 aside = on_cut(model, under.cut, under.entry) - under.entry;
  const double far = length(aside);
  under.entry += far > kSlipsMm ? aside * (kSlipsMm / far) : aside;
}

void World::State::leave_skin(std::uint8_t hand) noexcept {
  making.worked.hands[hand] = {};
  making.feels[hand] = {};
}

/// Against its going on, and as much against its coming back but for what is not spread.
double World::State::held_back_n(const Model& model, std::uint8_t hand) const noexcept {
  const instruments::SkinTool& tool = *kind_of(model, now.items[now.held[hand]]).skin;
  const UnderSkin& under = making.worked.hands[hand];
  if (under.is_through) return kInJointN;
  const bool is_spread =
      under.cut != kNoCut && under.travel_mm < making.worked.cuts[under.cut].spread_mm;
  return tool.way_n + (is_spread ? 0.0 : tool.unspread_n);
}

void World::State::advance_under_skin(const Model& model,
                                      std::uint8_t hand,
                                      double to_mm) noexcept {
  Item& item = *in_hand(hand);
  const instruments::Instrument& kind = kind_of(model, item);
  detail::HandState& held = spent.hands[hand];
  UnderSkin& under = making.worked.hands[hand];
  // Its hub, or handle, comes to lie on the skin.
  const double most = std::min(under.travel_mm + kFastestMm, item.length_mm);
  const double wished = dot(held.plan.tip - under.entry, under.towards);
  while (under.travel_mm < std::min(to_mm, most)) {
    const double next = std::min({under.travel_mm + kStepMm, to_mm, most});
    const Vec3 tip = under.entry + under.towards * next;
    const double pressed_n = kN * (wished - under.travel_mm);
    const Touched bone = surface_at(tip);
    const double gap = bone.distance_mm - kind.shape.least_radius_mm();
    const bool goes_in = dot(under.towards, bone.normal_in_patient) < 0.0;
    if (bone.body != kNoBody && gap < 0.0 && goes_in) {
      held.touched_body = bone.body;
      held.contact_normal = bone.normal_in_patient;
      if (under.has_struck || pressed_n < model.procedure.making->strike_n) return;
      under.has_struck = true;
      if (kind.skin->work != SkinWork::Needle) return;
      std::uint16_t& strikes = making.facts.portal[under.portal].bone_strikes;
      if (strikes < 0xFFFF) ++strikes;
      return emit(EventKind::NeedleStruckBone, now.held[hand], bone.body, 0.0);
    }
    if (!under.is_through && joint_at(model, tip)) {
      if (pressed_n < kind.skin->capsule_n) return;
      under.is_through = true;
      under.capsule_mm = next;
      under.ticks = under.seen_ticks = 0;
    }
    under.travel_mm = next;
  }
}

void World::State::spread_way(const Model& model, std::uint8_t hand) noexcept {
  UnderSkin& under = making.worked.hands[hand];
  const procedure::PortalMaking& figures = *model.procedure.making;
  const bool opens = under.is_in && spent.hands[hand].wish.driver == Driver::Forward;
  under.ticks = opens && under.is_spreading ? under.ticks + 1 : 0;
  under.is_spreading = opens;
  if (!opens || under.cut == kNoCut) return;
  if (static_cast<double>(under.ticks) * kTickSeconds < figures.spread_s) return;
  detail::SkinCut& cut = making.worked.cuts[under.cut];
  cut.spread_mm = std::max(cut.spread_mm, under.travel_mm + figures.spread_reach_mm);
  bool is_at_capsule = under.is_through;
  const Vec3 tip = under.entry + under.towards * under.travel_mm;
  for (std::uint8_t joint = 0; joint < model.map->joints.size(); ++joint) {
    const arthroscopy::OpenedSpace space = joint_space_at(model, joint, tip);
    is_at_capsule =
        is_at_capsule || (space.is_near && space.distance_mm <= figures.spread_reach_mm);
  }
  if (!is_at_capsule || cut.is_spread) return;
  cut.is_spread = true;
  emit(EventKind::WaySpread, now.held[hand], 0, 0.0);
}

void World::State::move_under_skin(const Model& model, std::uint8_t hand) noexcept {
  Item& item = *in_hand(hand);
  const instruments::Instrument& kind = kind_of(model, item);
  const instruments::SkinTool& tool = *kind.skin;
  detail::HandState& held = spent.hands[hand];
  UnderSkin& under = making.worked.hands[hand];
  held.touched_body = kNoBody;
  held.contact_normal = {};
  making.feels[hand] = {};
  const Vec3& wish = held.plan.tip;
  if (!under.is_in) {
    turn_towards(item, held.plan.shaft);
    const SkinPlace at = skin_at(model, wish);
    if (!(at.depth_mm > 0.0)) {
      held.slip_is_told = false;
      return follow_wish(item, wish, kFastestMm);
    }
    const double deep = at.depth_mm * tool.gives_share;
    follow_wish(item, at.point - at.normal * deep, kFastestMm);
    // Only what has come to the skin there, and points into it.
    const bool is_there = distance(item.tip, at.point) <= deep + kSinksMm;
    if (!is_there || !(dot(item.shaft, at.normal) > 0.0)) return;
    const double pressed_n = kN * (at.depth_mm - deep);
    const bool pricks = tool.skin_n > 0.0 && pressed_n >= tool.skin_n;
    const bool slips =
        tool.skin_n <= 0.0 && cut_at(model, at.point, kind.shape.greatest_radius_mm()) != kNoCut;
    if (pricks || slips) {
      come_into_skin(model, hand, at.point);
    } else if (tool.skin_n <= 0.0 && pressed_n >= tool.way_n && !held.slip_is_told) {
      held.slip_is_told = true;
      emit(EventKind::HeldBySkin, now.held[hand], 0, 0.0);
    }
    return;
  }
  held.slip_is_told = false;
  if (under.travel_mm < tool.reaim_mm) {
    turn_towards(item, held.plan.shaft);
    under.towards = -item.shaft;
  }
  if (tool.skin_n <= 0.0) slip_into_cut(model, under);
  if (tool.work == SkinWork::Spread) spread_way(model, hand);
  const double drag = held_back_n(model, hand) / kN;
  const double back = (under.is_through ? kInJointN : tool.way_n) / kN;
  const double wished = dot(wish - under.entry, under.towards);
  // Opened jaws neither go on nor come out.
  if (!under.is_spreading && wished - drag > under.travel_mm) {
    advance_under_skin(model, hand, wished - drag);
  } else if (!under.is_spreading && wished + back < under.travel_mm) {
    const double before = under.travel_mm;
    under.travel_mm = std::max({0.0, wished + back, before - kFastestMm});
    if (under.has_struck && wished + kAgainMm < before) under.has_struck = false;
    if (under.is_through && under.travel_mm < under.capsule_mm) {
      under.is_through = under.is_told = false;
    }
  }
  item.shaft = -under.towards;
  item.tip = under.entry + under.towards * under.travel_mm;
  note_under(model, hand);
  if (wished < -back && under.travel_mm <= 0.0) leave_skin(hand);
}

}  // namespace carpus::simulation
