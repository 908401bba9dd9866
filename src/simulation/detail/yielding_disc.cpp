// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The disc yields to what presses on it: a tip sinks in until the tissue bears what the hand
// presses with. A probe that has touched its ulnar edge hooks into it and takes it along until it
// slips.
#include <algorithm>

#include "arthroscopy/disc_net.hpp"
#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {

using detail::Item;
using detail::kNoPortal;

namespace {

constexpr double kOverMm = 1.6;        // a tip so near to a particle, aside, lies over the disc
constexpr double kAboveMm = 0.3;       // ... and touches it at most so far from it
constexpr double kDeepMm = 4.5;        // or has sunk in no deeper than this
constexpr double kMostGivesMm = 4.0;   // then the ulna is under it
constexpr double kGivesMmPerN = 0.01;  // a tick, for each newton that the hand presses more
constexpr double kComesBackMm = 0.02;  // a tick, once nothing presses
constexpr double kHookReachMm = 2.0;   // of the tip from the edge's middle
constexpr double kSlipsN = 3.0;        // [E]: more injures
constexpr double kTouchesN = 0.1;

}  // namespace

void World::State::yield_disc(const Model& model) noexcept {
  if (model.disc.size() == 0) return;
  std::array<yielding::Tip, kHands> tips;
  std::array<Vec3, kHands> out{};  // of the disc, frame Bone of the forearm
  std::array<bool, kHands> is_by_edge{};
  const std::uint8_t forearm = model.map->forearm;
  for (std::uint8_t h = 0; h < kHands; ++h) {
    const Item* item = in_hand(h);
    const std::uint8_t portal = scope_state.portal[h];
    std::uint16_t& hooked = scope_state.hooked[h];
    const bool is_in = item != nullptr && enters_joints(model, *item) && portal != kNoPortal &&
                       scope_state.is_in_joint[h] && model.map->portals[portal].joint == 0;
    if (!is_in) {
      scope_state.gives_mm[h] = 0.0;
      hooked = detail::kNothingHooked;
      continue;
    }
    const auto& shape = kind_of(model, *item).shape;
    const Vec3 round = item->tip + item->shaft * shape.front_z_mm();
    yielding::Tip& tip = tips[h];
    tip.at = (inverses[forearm] * Point<frame::Patient>{round}).v;
    tip.radius_mm = shape.greatest_radius_mm() + arthroscopy::kHalfDiscMm;
    const std::size_t near = yielding::nearest(model.disc, tip.at);
    out[h] = model.disc.normals()[near];
    const Vec3 off = tip.at - model.disc.rest()[near];
    const double high = dot(off, out[h]);
    const double aside2 = squared_length(off) - high * high;
    tip.is_there = aside2 < kOverMm * kOverMm && high < tip.radius_mm + kAboveMm && high > -kDeepMm;
    const instruments::Instrument& kind = kind_of(model, *item);
    const bool has_hook = !kind.optic && !kind.mouth;
    is_by_edge[h] =
        has_hook && model.disc_edge < model.disc.size() && !disc.is_cut(model.disc_edge) &&
        distance(tip.at, model.disc.rest()[model.disc_edge]) < kHookReachMm + tip.radius_mm;
    if (hooked < model.disc.size() && disc.is_cut(hooked)) hooked = detail::kNothingHooked;
    if (hooked < model.disc.size()) {
      tip.is_there = true;
      tip.hooked = hooked;
      tip.at = (inverses[forearm] * Point<frame::Patient>{item->tip}).v + scope_state.grip[h];
    }
  }
  disc.step(model.disc, tips);
  for (std::uint8_t h = 0; h < kHands; ++h) {
    double& gives = scope_state.gives_mm[h];
    std::uint16_t& hooked = scope_state.hooked[h];
    bool& has_edge = scope_state.has_edge[h];
    const Vec3 force = disc.force_on(h);
    if (hooked < model.disc.size()) {
      if (length(force) > kSlipsN) hooked = detail::kNothingHooked;
      gives = 0.0;
      continue;
    }
    const double bears = tips[h].is_there ? dot(force, out[h]) : 0.0;
    if (tips[h].is_there) {
      const Vec3 felt = (inverses[forearm] * Direction<frame::Patient>{scope_state.felt[h]}).v;
      const double presses = dot(felt, out[h]);
      gives = std::clamp(gives + kGivesMmPerN * (presses - bears), 0.0, kMostGivesMm);
    } else {
      gives = std::max(0.0, gives - kComesBackMm);
    }
    if (is_by_edge[h] && bears > kTouchesN) {
      has_edge = true;
    } else if (has_edge && !(bears > 0.0)) {
      // Drawn back from the edge: the hook takes it along.
      if (is_by_edge[h]) {
        hooked = static_cast<std::uint16_t>(model.disc_edge);
        const Vec3 tip = (inverses[forearm] * Point<frame::Patient>{in_hand(h)->tip}).v;
        scope_state.grip[h] = disc.at(model.disc_edge) - tip;
      }
      has_edge = false;
    }
  }
}

/// What pulls back at a hook, on the hand.
Vec3 World::State::hook_force(const Model& model, std::size_t hand) const noexcept {
  if (model.disc.size() == 0 || scope_state.hooked[hand] >= model.disc.size()) return {};
  return (poses[model.map->forearm] * Direction<frame::Bone>{disc.force_on(hand)}).v;
}

void World::State::publish_disc(const Model& model) noexcept {
  snapshot.disc_count = static_cast<std::uint16_t>(model.disc.size());
  snapshot.is_disc_still = disc.is_still();
  for (std::size_t i = 0; i < model.disc.size(); ++i) {
    const Vec3 off = disc.at(i) - model.disc.rest()[i];
    snapshot.disc_off[i] = {static_cast<float>(off.x), static_cast<float>(off.y),
                            static_cast<float>(off.z)};
  }
}

}  // namespace carpus::simulation
