// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The hook test: a probe that has touched the disc's ulnar edge hooks into it and takes it along
// until it slips.
#include <algorithm>

#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {

using detail::Item;
using detail::kDiscSheet;
using detail::kNothingHooked;

namespace {

constexpr double kHookReachMm = 2.0;  // of the tip from the edge's middle
constexpr double kSlipsN = 3.0;       // [E]: more injures
constexpr double kTouchesN = 0.1;

}  // namespace

bool World::State::is_by_edge(const Model& model, std::uint8_t hand) noexcept {
  const detail::YieldingSheet& disc = model.sheets[kDiscSheet];
  const Item* item = in_hand(hand);
  const std::uint8_t portal = scope_state.portal[hand];
  if (item == nullptr || !enters_joints(model, *item) || portal == detail::kNoPortal ||
      !scope_state.is_in_joint[hand] || joint_of(model, portal) != disc.joint) {
    return false;
  }
  const instruments::Instrument& kind = kind_of(model, *item);
  const bool has_hook = !kind.optic && !kind.mouth && !kind.has_jaws;
  if (!has_hook || model.disc_edge >= disc.net.size() ||
      sheets[kDiscSheet].is_cut(model.disc_edge)) {
    return false;
  }
  const yielding::Tip tip = tip_on(model, disc, *item, item->tip);
  return distance(tip.at, disc.net.rest()[model.disc_edge]) < kHookReachMm + tip.radius_mm;
}

/// A tip that has hooked into it holds its particle, and presses on nothing.
void World::State::hook_disc(const Model& model, std::array<yielding::Tip, kHands>& tips) noexcept {
  const detail::YieldingSheet& disc = model.sheets[kDiscSheet];
  for (std::uint8_t h = 0; h < kHands; ++h) {
    std::uint16_t& hooked = scope_state.hooked[h];
    const Item* item = in_hand(h);
    const bool is_in = item != nullptr && enters_joints(model, *item) &&
                       scope_state.is_in_joint[h] && scope_state.portal[h] != detail::kNoPortal &&
                       joint_of(model, scope_state.portal[h]) == disc.joint;
    const bool is_gone = hooked < disc.net.size() && sheets[kDiscSheet].is_cut(hooked);
    if (!is_in || is_gone) hooked = kNothingHooked;
    if (hooked >= disc.net.size()) continue;
    tips[h].is_there = true;
    tips[h].hooked = hooked;
    tips[h].at = (inverses[disc.first] * Point<frame::Patient>{item->tip}).v + scope_state.grip[h];
  }
}

/// Slips what is pulled at too hard; drawn back from the edge that it pressed on, the hook takes it
/// along.
void World::State::let_go_of_disc(const Model& model) noexcept {
  const detail::YieldingSheet& disc = model.sheets[kDiscSheet];
  for (std::uint8_t h = 0; h < kHands; ++h) {
    std::uint16_t& hooked = scope_state.hooked[h];
    bool& has_edge = scope_state.has_edge[h];
    const Vec3 force = sheets[kDiscSheet].force_on(h);
    if (hooked < disc.net.size()) {
      if (length(force) > kSlipsN) hooked = kNothingHooked;
      continue;
    }
    const UnderTip& under = under_tips[h];
    const double bears = under.sheet == kDiscSheet ? dot(force, under.out) : 0.0;
    if (is_by_edge(model, h) && bears > kTouchesN) {
      has_edge = true;
    } else if (has_edge && !(bears > 0.0)) {
      if (is_by_edge(model, h)) {
        hooked = static_cast<std::uint16_t>(model.disc_edge);
        const Vec3 tip = (inverses[disc.first] * Point<frame::Patient>{in_hand(h)->tip}).v;
        scope_state.grip[h] = sheets[kDiscSheet].at(model.disc_edge) - tip;
      }
      has_edge = false;
    }
  }
}

/// What pulls back at a hook, on the hand.
Vec3 World::State::hook_force(const Model& model, std::size_t hand) const noexcept {
  if (model.sheets.empty() || scope_state.hooked[hand] >= model.sheets[kDiscSheet].net.size()) {
    return {};
  }
  return (poses[model.sheets[kDiscSheet].first] *
          Direction<frame::Bone>{sheets[kDiscSheet].force_on(hand)})
      .v;
}

}  // namespace carpus::simulation
