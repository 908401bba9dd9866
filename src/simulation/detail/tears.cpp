// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is torn and lets through what is thin enough: a hole in a ligament or in the disc, from
// either side, and the interval between two bones that have parted.
#include "simulation/detail/intervals.hpp"
#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {

using detail::Item;

/// Where it is in the body's own frame, as if nothing had torn loose.
Vec3 World::State::unshifted(const Model& model, std::uint8_t body, const Vec3& at) const noexcept {
  return (inverses[body] * Point<frame::Patient>{at}).v +
         model.lesions->shift_of(body, spent.wrist.traction_n);
}

/// Through a torn ligament or disc what is thin enough goes on, out of the joint.
bool World::State::is_in_hole(const Model& model,
                              std::uint8_t joint,
                              const Vec3& at,
                              double radius_mm) const noexcept {
  if (!model.lesions) return false;
  for (const cases::Lesion& lesion : model.lesions->lesions) {
    if (lesion.joint != joint || !(lesion.passes_mm > radius_mm)) continue;
    if (cases::passes(lesion, unshifted(model, lesion.body, at), radius_mm)) return true;
  }
  return false;
}

/// ... and through an interval and the tear at its far end.
bool World::State::is_in_tear(const Model& model,
                              std::uint8_t joint,
                              const Vec3& at,
                              double radius_mm) const noexcept {
  if (is_in_hole(model, joint, at, radius_mm)) return true;
  for (const detail::YieldingSheet& sheet : model.sheets) {
    if (detail::lies_behind(sheet, joint) && is_in_hole(model, sheet.joint, at, radius_mm)) {
      return true;
    }
  }
  return false;
}

/// The middle of a tip's foremost ball.
arthroscopy::InInterval World::State::interval_at(const Model& model,
                                                  std::uint8_t hand,
                                                  const Vec3& tip) const noexcept {
  const Item& item = now.items[now.held[hand]];
  const auto& shape = kind_of(model, item).shape;
  return detail::in_intervals(model.sheets, inverses, joint_of(model, scope_state.portal[hand]),
                              tip + item.shaft * shape.front_z_mm(), shape.greatest_radius_mm());
}

}  // namespace carpus::simulation
