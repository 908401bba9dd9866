// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How instruments in a joint are led: how smoothly, what cartilage they scuff, and whether the
// scope is pushed through to the joint's far side.
#include <algorithm>
#include <cstdint>

#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {

using detail::Item;

namespace {

constexpr double kShaftMm = 12.0;     // of a shaft in the joint: it may lie on a bone's rim
constexpr double kShaftStepMm = 1.0;  // of which points are asked so far apart
// Bone no farther from an instrument that presses: between them lies cartilage, 0.6 mm [S75], and
// the walls' grids are off.
constexpr double kOnBoneMm = 1.0;
constexpr double kFacetMm = 1.5;        // a facet of cartilage lies so near, where there is any
constexpr double kOnCapsuleMm = 0.5;    // a tip so near to the wall lies on it
constexpr double kFarSideCosine = 0.5;  // a wall across the way in, within 60 degrees [E]
constexpr double kCapsuleLetUpN = 1.0;  // with less the next push is another [E]

}  // namespace

/// After it is known whether it is in a joint.
void World::State::watch_conduct(const Model& model, std::uint8_t hand, const Item& item) noexcept {
  if (!scope_state.is_in_joint[hand] || scope_state.portal[hand] == kNoBody) {
    conduct.motion[hand] = {};
    conduct.presses[hand] = {};
    conduct.is_on_capsule[hand] = false;
    return;
  }
  const std::size_t what = kind_of(model, item).optic ? 0 : 1;
  add_tip(conduct.motion[hand], item.tip, conduct.smoothness[what]);
  watch_press(model, hand, item);
  if (what == 0) watch_capsule(model, hand, item);
}

/// A push counts from 3 N on; it is on the capsule where the wall lies across the way in and no
/// bone is behind it.
void World::State::watch_capsule(const Model& model, std::uint8_t hand, const Item& item) noexcept {
  const double force_n = length(scope_state.felt[hand]);
  bool& is_on_it = conduct.is_on_capsule[hand];
  if (force_n < kCapsuleLetUpN) is_on_it = false;
  if (is_on_it || !(force_n > detail::kWarnN)) return;
  const std::uint8_t portal = scope_state.portal[hand];
  const arthroscopy::OpenedSpace space = joint_space_at(model, joint_of(model, portal), item.tip);
  if (!space.is_near || space.distance_mm < -kOnCapsuleMm ||
      dot(space.outwards, way_in(model, portal).inwards) < kFarSideCosine) {
    return;
  }
  const Touched bone = surface_at(item.tip);
  const double radius_mm = kind_of(model, item).shape.greatest_radius_mm();
  if (bone.body != kNoBody && bone.distance_mm < radius_mm + kOnBoneMm) return;
  is_on_it = true;
  ++conduct.capsule_pushes;
  emit(EventKind::CapsulePushed, now.held[hand], portal, force_n);
}

void World::State::watch_press(const Model& model, std::uint8_t hand, const Item& item) noexcept {
  detail::HardPress& press = conduct.presses[hand];
  const double force_n = length(scope_state.felt[hand]);
  if (presses_anew(press, item.tip, force_n)) {
    const BonePlace bone = bone_beside(model, item);
    if (bone.body == kNoBody) return;
    const Vec3 at = (inverses[bone.body] * Point<frame::Patient>{bone.at}).v;
    if (!is_cartilage_at(model, bone.body, at)) return;
    press.place = static_cast<std::uint8_t>(std::min<std::size_t>(conduct.scuffs, 255));
    note_scuff(hand, bone.body, bone.at, procedure::Scuffing::Pressed);
    emit(EventKind::CartilagePressed, now.held[hand], bone.body, force_n);
    press.is_told = press.place < conduct.places.size();
  }
  if (!press.is_told) return;
  double& most = conduct.places[press.place].force_n;
  most = std::max(most, force_n);
}

/// The bone that an instrument in a joint lies on, by tip or shaft, and where.
World::State::BonePlace World::State::bone_beside(const Model& model,
                                                  const Item& item) const noexcept {
  const double radius_mm = kind_of(model, item).shape.greatest_radius_mm();
  BonePlace nearest;
  double least_mm = radius_mm + kOnBoneMm;
  for (double s = 0.0; s <= kShaftMm; s += kShaftStepMm) {
    const Vec3 point = item.tip + item.shaft * s;
    const Touched bone = surface_at(point);
    if (bone.body == kNoBody || !(bone.distance_mm < least_mm)) continue;
    least_mm = bone.distance_mm;
    nearest = {bone.body, point - bone.normal_in_patient * bone.distance_mm};
  }
  return nearest;
}

bool World::State::is_cartilage_at(const Model& model,
                                   std::uint8_t body,
                                   const Vec3& at_in_bone) const noexcept {
  const auto& facets = model.map->cartilage;
  return std::any_of(facets.begin(), facets.end(), [&](const cases::CartilageFacet& facet) {
    return facet.body == body && distance(facet.at, at_in_bone) <= kFacetMm;
  });
}

void World::State::note_scuff(std::uint8_t hand,
                              std::uint8_t body,
                              const Vec3& at,
                              procedure::Scuffing how) noexcept {
  const Item* item = in_hand(hand);
  const InstrumentIndex by = item != nullptr ? item->instrument : kNoInstrument;
  const Vec3 in_bone = (inverses[body] * Point<frame::Patient>{at}).v;
  add_scuff(conduct, {spent.tick, body, in_bone, 0.0, by, how});
}

}  // namespace carpus::simulation
