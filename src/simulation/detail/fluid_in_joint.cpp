// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The fluid of an arthroscopy in the tick: which sheath it runs through, which portals stand open,
// what bleeds, and what of the joint is seen through it. Nothing of it where the procedure declares
// no fluid.
#include <algorithm>
#include <bit>
#include <cstdint>

#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {

using detail::FluidTable;
using detail::Item;
using detail::kNoPortal;

namespace {}  // namespace

/// What cuts or tears what lines the joint calls this: it bleeds from then on, less and less.
void World::State::bleed_into_joint(const Model& model, double ml_per_s) noexcept {
  if (model.procedure.fluid) detail::bleed(fluid, FluidTable::generic(), ml_per_s);
}

/// What sucks in the joint calls this in each tick that it does so.
void World::State::draw_fluid(double ml_per_s) noexcept {
  if (ml_per_s > 0.0) suction_ml_per_s += ml_per_s;
}

bool World::State::is_clear_to(const Model& model, double far_mm) const noexcept {
  return !model.procedure.fluid || detail::is_clear(fluid, FluidTable::generic(), far_mm);
}

/// Not clouded. The table is not touched where there is no fluid: a tick reads no text.
bool World::State::is_clear_enough(const Model& model) const noexcept {
  return !model.procedure.fluid || is_clear_to(model, FluidTable::generic().view.clouded_at_mm);
}

/// Portals as they are gone through: fresh ones bleed, and what goes in takes air along.
void World::State::note_portals() noexcept {
  const FluidTable& table = FluidTable::generic();
  std::uint32_t occupied = 0;
  for (std::size_t h = 0; h < kHands; ++h) {
    const std::uint8_t portal = scope_state.portal[h];
    if (portal != kNoPortal) occupied |= 1U << portal;
  }
  const std::uint32_t entered = occupied & ~fluid.occupied;
  const std::uint32_t fresh = entered & ~fluid.made;
  for (int i = 0; i < std::popcount(fresh); ++i) {
    detail::bleed(fluid, table, table.bleeding.portal_ml_per_s);
  }
  if (entered != 0) detail::let_air_in(fluid, table, table.air.exchange_ml);
  fluid.made |= occupied;
  fluid.occupied = occupied;
}

/// What the joint has to do with now; goes on to the joint that the scope is in.
detail::FluidAround World::State::around_fluid(const Model& model) noexcept {
  const FluidTable& table = FluidTable::generic();
  detail::FluidAround around;
  for (std::uint8_t h = 0; h < kHands; ++h) {
    const Item* item = in_hand(h);
    if (item == nullptr || !scope_state.is_in_joint[h]) continue;
    if (length(scope_state.felt[h]) > detail::kInjuryN) {
      detail::bleed(fluid, table, table.bleeding.injury_ml_per_s2 * kTickSeconds);
    }
    if (!kind_of(model, *item).optic) continue;
    detail::go_to_joint(fluid, table, joint_of(model, scope_state.portal[h]));
    around.sheath_mm = 2.0 * kind_of(model, *item).shape.greatest_radius_mm();
    around.lens_touches = is_held_back(h, *item);
  }
  for (std::size_t p = 0; p < model.map->portals.size(); ++p) {
    const bool stands_open = (fluid.made & ~fluid.occupied) >> p & 1U;
    if (stands_open && joint_of(model, static_cast<std::uint8_t>(p)) == fluid.joint)
      ++around.open_portals;
  }
  around.suction_ml_per_s = suction_ml_per_s;
  return around;
}

void World::State::run_fluid(const Model& model) noexcept {
  if (model.map != nullptr && model.procedure.fluid) {
    const bool was_too_high = fluid.is_too_high;
    const bool had_swollen = fluid.has_swollen;
    const bool was_clouded = fluid.is_clouded;
    note_portals();
    (void)detail::flow(fluid, FluidTable::generic(), *model.procedure.fluid, around_fluid(model),
                       kTickSeconds);
    const auto tell = [&](EventKind kind, bool is_so, bool was_so, double value) {
      if (is_so && !was_so) emit(kind, kNoItem, 0, value);
    };
    tell(EventKind::PressureTooHigh, fluid.is_too_high, was_too_high, fluid.pressure_mmhg);
    tell(EventKind::TissueSwells, fluid.has_swollen, had_swollen, fluid.facts.tissue_ml);
    tell(EventKind::ViewClouded, fluid.is_clouded, was_clouded, 0.0);
  }
  suction_ml_per_s = 0.0;
}

void World::State::publish_fluid(const Model& model) noexcept {
  if (!model.procedure.fluid) return;
  const FluidTable& table = FluidTable::generic();
  FluidView& view = snapshot.scope.fluid;
  view.is_there = true;
  view.inflow_steps = fluid.inflow_steps;
  view.is_outflow_open = fluid.is_outflow_open;
  view.is_dry = fluid.is_dry;
  view.is_flushing = fluid.flush_ticks > 0;
  view.pressure_mmhg = fluid.pressure_mmhg;
  const bool is_wet = detail::is_immersed(fluid);
  view.haze_per_mm = is_wet ? table.view.haze_per_mm * fluid.blood : 0.0;
  view.bubbles = is_wet ? std::min(1.0, fluid.air_ml / table.air.shown_ml) : 0.0;
  view.fog_depth = is_wet ? 0.0 : table.view.fog_depth * fluid.chill;
  view.smear_depth = table.view.smear_depth * detail::covered(fluid);
}

}  // namespace carpus::simulation
