// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Figures of the fluid in a joint, as data (data/joint_fluid.json): each there with its mark.
#pragma once

#include <string_view>

namespace carpus::arthroscopy {

/// What drives the inflow through the scope's sheath.
struct FluidSource {
  double inflow_mmhg = 0;  ///< set at first
  double most_inflow_mmhg = 0;
  double step_mmhg = 0;
  double sheath_mmhg_s_per_ml = 0;  ///< past a scope of `sheath_mm`
  double sheath_mm = 0;
  double flush_mmhg = 0;
  double flush_s = 0;
};

struct FluidJoint {
  double rest_ml = 0;
  double ml_per_mmhg = 0;
  double outflow_mmhg_s_per_ml = 0;
  double portal_mmhg_s_per_ml = 0;  ///< a portal that nothing is in
  double tissue_from_mmhg = 0;
  double tissue_mmhg_s_per_ml = 0;
  double most_mmhg = 0;
  double shaver_ml_per_s = 0;  ///< that one sucks away while it runs
  double swells_ml = 0;
};

struct FluidBleeding {
  double pressure_mmhg = 0;    ///< at which it stops
  double tourniquet_mmhg = 0;  ///< likewise, under a tourniquet
  double portal_ml_per_s = 0;
  double injury_ml_per_s2 = 0;
  double tuft_ml_per_s = 0;  ///< of a tuft of inflamed synovium that is cut off
  double most_ml_per_s = 0;
  double stops_s = 0;
};

struct FluidAir {
  double exchange_ml = 0;
  double shown_ml = 0;  ///< all the bubbles that are drawn
  double washed_ml = 0;
};

struct FluidLens {
  double cools_s = 0;
  double warms_s = 0;
  double smear_per_s = 0;
  double smear_by_blood = 0;
  double rinsed_s = 0;
};

/// Optical depths: what is left of the light is e to the minus of their sum.
struct FluidView {
  double haze_per_mm = 0;
  double fog_depth = 0;
  double smear_depth = 0;
  double hidden_depth = 0;
  double clouded_at_mm = 0;
};

struct FluidTable {
  FluidSource source;
  FluidJoint joint;
  FluidBleeding bleeding;
  FluidAir air;
  FluidLens lens;
  FluidView view;

  /// @throws InvalidInput naming the entry where the text is no such table.
  [[nodiscard]] static FluidTable parse(std::string_view json_text);
  /// The built-in table; parsed at the first call.
  [[nodiscard]] static const FluidTable& generic();
};

}  // namespace carpus::arthroscopy
