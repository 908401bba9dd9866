// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A lumped chamber as in hydraulics: C dp/dt = sum of g (p_i - p), each way a conductance g to the
// pressure at its other end. Taken implicitly, so that no step is too long and p never leaves the
// range of what it is tied to. What mixes is added to what was there before anything leaves: the
// share of blood stays between 0 and 1 whatever the step.
#include "simulation/detail/joint_fluid.hpp"

#include <algorithm>

namespace carpus::simulation::detail {
namespace {

constexpr double kMostMl = 1e6;      // of what an hour can move
constexpr double kClearAgain = 0.7;  // of what counts as clouded

/// Falls to a third within `within_s`.
double faded(double value, double seconds, double within_s) noexcept {
  return value / (1.0 + seconds / within_s);
}

double source_mmhg(const JointFluid& state, const FluidTable& table) noexcept {
  const double set = state.inflow_steps * table.source.step_mmhg;
  return state.flush_ticks > 0 ? std::max(set, table.source.flush_mmhg) : set;
}

/// A sheath's, by the fourth power of its width [Poiseuille].
double sheath_conductance(const FluidTable& table, double sheath_mm) noexcept {
  const double wide = sheath_mm / table.source.sheath_mm;
  return wide * wide * wide * wide / table.source.sheath_mmhg_s_per_ml;
}

/// Ways in and out, and what is forced through.
struct Ways {
  double in = 0.0;
  double out = 0.0;
  double leak = 0.0;
  double source_mmhg = 0.0;
  double forced_ml_per_s = 0.0;
};

using arthroscopy::FluidJoint;

double pressure_after(double before_mmhg,
                      const FluidTable& table,
                      const Ways& ways,
                      double tissue,
                      double seconds) noexcept {
  const FluidJoint& joint = table.joint;
  const double gains =
      ways.in * ways.source_mmhg + tissue * joint.tissue_from_mmhg + ways.forced_ml_per_s;
  return (joint.ml_per_mmhg * before_mmhg + seconds * gains) /
         (joint.ml_per_mmhg + seconds * (ways.in + ways.out + ways.leak + tissue));
}

void change_lens(JointFluid& state,
                 const FluidTable& table,
                 const FluidAround& around,
                 double seconds) noexcept {
  const arthroscopy::FluidLens& lens = table.lens;
  if (!(around.sheath_mm > 0.0)) {
    const double by = seconds / lens.cools_s;
    state.chill = (state.chill + by) / (1.0 + by);
    state.smear = faded(state.smear, seconds, lens.rinsed_s);  // it is wiped
    return;
  }
  state.chill = faded(state.chill, seconds, lens.warms_s);
  if (is_immersed(state)) {
    state.smear = faded(state.smear, seconds, lens.rinsed_s);
    state.chill = faded(state.chill, seconds, lens.rinsed_s);
  } else if (around.lens_touches) {
    const double by = seconds * lens.smear_per_s * (1.0 + lens.smear_by_blood * state.blood);
    state.smear = (state.smear + by) / (1.0 + by);
  }
}

void judge(JointFluid& state, const FluidTable& table, const FluidAround& around) noexcept {
  state.is_too_high = state.pressure_mmhg > table.joint.most_mmhg;
  if (state.is_too_high) ++state.facts.over_limit_ticks;
  state.has_swollen = state.facts.tissue_ml >= table.joint.swells_ml;
  if (!(around.sheath_mm > 0.0)) {
    state.is_clouded = false;
    return;
  }
  const double depth = optical_depth(state, table, table.view.clouded_at_mm);
  const double hidden = table.view.hidden_depth;
  ++state.facts.watched_ticks;
  if (depth > hidden) ++state.facts.clouded_ticks;
  state.is_clouded = depth > (state.is_clouded ? kClearAgain * hidden : hidden);
}

}  // namespace

JointFluid fluid_at_first(const FluidTable& table) noexcept {
  JointFluid state;
  const double steps = table.source.inflow_mmhg / table.source.step_mmhg + 0.5;
  state.inflow_steps = static_cast<std::uint8_t>(steps);
  return state;
}

bool can_set(const FluidTable& table, FluidControl control, std::uint8_t value) noexcept {
  switch (control) {
    case FluidControl::Inflow:
      return value * table.source.step_mmhg <= table.source.most_inflow_mmhg;
    case FluidControl::Outflow:
    case FluidControl::Dry:
      return value <= 1;
    case FluidControl::Flush:
      return value == 0;
  }
  return false;
}

void set(JointFluid& state,
         const FluidTable& table,
         FluidControl control,
         std::uint8_t value) noexcept {
  switch (control) {
    case FluidControl::Inflow:
      state.inflow_steps = value;
      return;
    case FluidControl::Outflow:
      state.is_outflow_open = value != 0;
      return;
    case FluidControl::Flush:
      state.flush_ticks = static_cast<std::uint32_t>(table.source.flush_s / kTickSeconds);
      return;
    case FluidControl::Dry:
      state.is_dry = value != 0;
      state.flush_ticks = 0;
      return;
  }
}

double volume_ml(const JointFluid& state, const FluidTable& table) noexcept {
  return table.joint.rest_ml + table.joint.ml_per_mmhg * state.pressure_mmhg;
}

void bleed(JointFluid& state, const FluidTable& table, double ml_per_s) noexcept {
  if (!(ml_per_s > 0.0)) return;
  state.bleeding_ml_per_s =
      std::min(state.bleeding_ml_per_s + ml_per_s, table.bleeding.most_ml_per_s);
}

void let_air_in(JointFluid& state, const FluidTable& table, double ml) noexcept {
  state.air_ml = std::min(state.air_ml + ml, table.joint.rest_ml);
}

void go_to_joint(JointFluid& state, const FluidTable& table, std::uint8_t joint) noexcept {
  if (state.joint == joint) return;
  state.joint = joint;
  state.pressure_mmhg = state.blood = 0.0;
  state.air_ml = std::min(state.air_ml, table.air.exchange_ml);  // what the scope took along
}

double covered(const JointFluid& state) noexcept {
  return state.is_dry ? state.smear + (1.0 - state.smear) * state.blood : state.smear;
}

double optical_depth(const JointFluid& state, const FluidTable& table, double mm) noexcept {
  const arthroscopy::FluidView& view = table.view;
  const double before =
      is_immersed(state) ? view.haze_per_mm * state.blood * mm : view.fog_depth * state.chill;
  return before + view.smear_depth * covered(state);
}

FluidMoved flow(JointFluid& state,
                const FluidTable& table,
                const procedure::FluidUse& use,
                const FluidAround& around,
                double seconds) noexcept {
  const FluidJoint& joint = table.joint;
  const arthroscopy::FluidBleeding& bleeding = table.bleeding;
  const bool is_wet = is_immersed(state);
  const double stops_at = use.has_tourniquet ? bleeding.tourniquet_mmhg : bleeding.pressure_mmhg;
  const double runs = std::max(0.0, 1.0 - state.pressure_mmhg / stops_at);
  const double bled = state.bleeding_ml_per_s * runs;
  Ways ways;
  ways.source_mmhg = source_mmhg(state, table);
  if (is_wet && around.sheath_mm > 0.0) ways.in = sheath_conductance(table, around.sheath_mm);
  // Dry, what is left is drawn off.
  if (state.is_outflow_open || state.is_dry) ways.out = 1.0 / joint.outflow_mmhg_s_per_ml;
  ways.leak = around.open_portals / joint.portal_mmhg_s_per_ml;
  ways.forced_ml_per_s = bled - around.suction_ml_per_s;

  const double before_ml = volume_ml(state, table);
  double tissue = 0.0;
  double after = pressure_after(state.pressure_mmhg, table, ways, tissue, seconds);
  if (after > joint.tissue_from_mmhg) {  // stays above: a mean of it and what the tissue opens at
    tissue = 1.0 / joint.tissue_mmhg_s_per_ml;
    after = pressure_after(state.pressure_mmhg, table, ways, tissue, seconds);
  }
  FluidMoved moved;
  moved.suction = around.suction_ml_per_s * seconds;
  if (!(after > 0.0)) {
    // No more than there is; the rest is air. The walls fall in no further than at rest.
    const double there =
        joint.ml_per_mmhg * state.pressure_mmhg + seconds * (ways.in * ways.source_mmhg + bled);
    moved.air = std::max(0.0, moved.suction - there);
    moved.suction = std::min(moved.suction, there);
    after = 0.0;
  }
  moved.in = ways.in * (ways.source_mmhg - after) * seconds;
  moved.blood = bled * seconds;
  moved.out = ways.out * after * seconds;
  moved.leak = ways.leak * after * seconds;
  moved.tissue = tissue > 0.0 ? tissue * (after - joint.tissue_from_mmhg) * seconds : 0.0;

  const double fresh = std::max(0.0, moved.in);
  state.blood =
      std::min(1.0, (state.blood * before_ml + moved.blood) / (before_ml + fresh + moved.blood));
  state.pressure_mmhg = after;
  state.facts.used_ml += fresh;
  state.facts.tissue_ml += moved.tissue;
  state.bleeding_ml_per_s = faded(state.bleeding_ml_per_s, seconds, bleeding.stops_s);
  state.air_ml = faded(state.air_ml, moved.out + moved.leak + moved.suction, table.air.washed_ml);
  let_air_in(state, table, is_wet ? moved.air : joint.rest_ml);
  change_lens(state, table, around, seconds);
  if (state.flush_ticks > 0) --state.flush_ticks;
  judge(state, table, around);
  return moved;
}

bool is_possible(const JointFluid& state,
                 const FluidTable& table,
                 std::size_t joints,
                 std::size_t portals) noexcept {
  const auto is_share = [](double value) { return value >= 0.0 && value <= 1.0; };
  const auto has_no_other = [&](std::uint32_t bits) {
    constexpr std::size_t kBits = 32;
    return portals >= kBits || bits >> portals == 0;
  };
  const procedure::FluidFacts& facts = state.facts;
  // A flush ends above nothing that is driven; what tissue and blood add is far below.
  const double most_mmhg = table.source.most_inflow_mmhg + table.source.flush_mmhg;
  return state.pressure_mmhg >= 0.0 && state.pressure_mmhg <= most_mmhg && is_share(state.blood) &&
         is_share(state.chill) && is_share(state.smear) && state.bleeding_ml_per_s >= 0.0 &&
         state.bleeding_ml_per_s <= table.bleeding.most_ml_per_s && state.air_ml >= 0.0 &&
         state.air_ml <= table.joint.rest_ml &&
         can_set(table, FluidControl::Inflow, state.inflow_steps) &&
         state.flush_ticks * kTickSeconds <= table.source.flush_s &&
         (state.joint == kNoJoint || state.joint < joints) && has_no_other(state.made) &&
         (state.occupied & ~state.made) == 0 && facts.used_ml >= 0.0 && facts.used_ml <= kMostMl &&
         facts.tissue_ml >= 0.0 && facts.tissue_ml <= kMostMl &&
         facts.clouded_ticks <= facts.watched_ticks;
}

}  // namespace carpus::simulation::detail
