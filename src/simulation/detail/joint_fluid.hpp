// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Fluid in the joint that a scope looks into: a compliant space that an inflow fills through the
// scope's sheath and that loses what it holds by an outflow, open portals, suction and, under too
// much pressure, into the tissue; blood, bubbles and what lies on the lens. Pure; + - * / alone.
#pragma once

#include <cstdint>

#include "arthroscopy/fluid_table.hpp"
#include "procedure/fluid_use.hpp"
#include "procedure/situation.hpp"
#include "simulation/detail/operation_state.hpp"

namespace carpus::simulation::detail {

using arthroscopy::FluidTable;
using procedure::FluidControl;

inline constexpr std::uint8_t kNoJoint = procedure::kNoBody;

/// One space: that of the joint which the scope was in last [E].
struct JointFluid {
  double pressure_mmhg = 0.0;
  double blood = 0.0;              ///< share of what is in the joint
  double bleeding_ml_per_s = 0.0;  ///< without pressure against it
  double air_ml = 0.0;
  double chill = 1.0;  ///< of the lens, 0: as warm as the joint
  double smear = 0.0;  ///< on the lens, 0 to 1
  std::uint8_t inflow_steps = 0;
  bool is_outflow_open = true;
  bool is_dry = false;
  std::uint32_t flush_ticks = 0;  ///< left
  std::uint8_t joint = kNoJoint;
  std::uint32_t made = 0;      ///< bits: portals that something has gone through
  std::uint32_t occupied = 0;  ///< bits: in which something is
  bool is_too_high = false;
  bool has_swollen = false;
  bool is_clouded = false;
  procedure::FluidFacts facts;
};

template <Is<JointFluid> SomeState, typename Visitor>
void visit(SomeState& state, Visitor&& v) noexcept {
  v(state.pressure_mmhg);
  v(state.blood);
  v(state.bleeding_ml_per_s);
  v(state.air_ml);
  v(state.chill);
  v(state.smear);
  v(state.inflow_steps);
  v(state.is_outflow_open);
  v(state.is_dry);
  v(state.flush_ticks);
  v(state.joint);
  v(state.made);
  v(state.occupied);
  v(state.is_too_high);
  v(state.has_swollen);
  v(state.is_clouded);
  v(state.facts.used_ml);
  v(state.facts.tissue_ml);
  v(state.facts.over_limit_ticks);
  v(state.facts.watched_ticks);
  v(state.facts.clouded_ticks);
}

/// As it is set before anybody touches it.
[[nodiscard]] JointFluid fluid_at_first(const FluidTable& table) noexcept;

/// Whether a tick could have left it.
[[nodiscard]] bool is_possible(const JointFluid& state,
                               const FluidTable& table,
                               std::size_t joints,
                               std::size_t portals) noexcept;

/// Whether a control has such a value.
[[nodiscard]] bool can_set(const FluidTable& table,
                           FluidControl control,
                           std::uint8_t value) noexcept;
void set(JointFluid& state,
         const FluidTable& table,
         FluidControl control,
         std::uint8_t value) noexcept;

/// What the joint has to do with in a tick.
struct FluidAround {
  double sheath_mm = 0.0;          ///< diameter of the scope that is in it; 0: none
  std::uint32_t open_portals = 0;  ///< into it, that nothing is in
  double suction_ml_per_s = 0.0;
  bool lens_touches = false;
};

/// What moved in a tick [ml]. in + blood - out - leak - tissue - suction is what the joint gained.
struct FluidMoved {
  double in = 0.0;  ///< below zero: back into the bag
  double blood = 0.0;
  double out = 0.0;
  double leak = 0.0;
  double tissue = 0.0;
  double suction = 0.0;
  double air = 0.0;  ///< that came in because suction found no fluid
};

/// One tick of `seconds`.
FluidMoved flow(JointFluid& state,
                const FluidTable& table,
                const procedure::FluidUse& use,
                const FluidAround& around,
                double seconds) noexcept;

/// In the joint [ml].
[[nodiscard]] double volume_ml(const JointFluid& state, const FluidTable& table) noexcept;

/// From now on something bleeds, less and less.
void bleed(JointFluid& state, const FluidTable& table, double ml_per_s) noexcept;

/// What an instrument takes along.
void let_air_in(JointFluid& state, const FluidTable& table, double ml) noexcept;

/// The scope looks into another joint than before.
void go_to_joint(JointFluid& state, const FluidTable& table, std::uint8_t joint) noexcept;

/// Whether fluid, not air, is before the lens.
[[nodiscard]] inline bool is_immersed(const JointFluid& state) noexcept {
  return !state.is_dry || state.flush_ticks > 0;
}

/// Of the lens, by blood that smears it; dry, blood that nothing washes away pools before it too.
[[nodiscard]] double covered(const JointFluid& state) noexcept;

/// Of all between the camera and a place so far before the lens: light is left by e to the minus of
/// it.
[[nodiscard]] double optical_depth(const JointFluid& state,
                                   const FluidTable& table,
                                   double mm) noexcept;

/// Whether a place so far before the lens is seen through it.
[[nodiscard]] inline bool is_clear(const JointFluid& state,
                                   const FluidTable& table,
                                   double mm) noexcept {
  return optical_depth(state, table, mm) <= table.view.hidden_depth;
}

}  // namespace carpus::simulation::detail
