// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A hand that holds the tip: its mass, and a spring and a damper to where it means to be. Four
// grips, and one that has let go.
#pragma once

#include <array>
#include <string_view>

#include "geometry/vec3.hpp"

namespace carpus::virtual_arm {

struct HandModel {
  std::string_view name;
  double mass_kg = 0;
  double damping_n_s_per_mm = 0;
  double stiffness_n_per_mm = 0;
};

inline constexpr HandModel kReleasedHand{"released", 0, 0, 0};

/// Light, pen grip and firm are engineering estimates within what is published of grips on a
/// stylus [fu2012hand]; the whole arm was fitted to one person [E].
inline constexpr std::array<HandModel, 5> kHandModels{{{"light", 0.02, 0.001, 0.06},
                                                       {"pen_grip", 0.05, 0.004, 0.2},
                                                       {"firm", 0.15, 0.008, 0.5},
                                                       {"whole_arm", 0.55, 0.0065, 0.135},
                                                       kReleasedHand}};

/// Where the hand means to be, and how fast that moves.
struct Intent {
  Vec3 place;     ///< [mm]
  Vec3 velocity;  ///< [mm/s]
};

}  // namespace carpus::virtual_arm
