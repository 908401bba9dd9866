// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// An arthroscopy in the tick: what goes through which portal, what the scope has seen, how it was
// led. Nothing of it is there while no instrument on the tray enters joints.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "cases/arthroscopic_map.hpp"
#include "cases/joint_lesions.hpp"
#include "procedure/operation_record.hpp"
#include "simulation/detail/operation_state.hpp"
#include "simulation/detail/yielding_sheet.hpp"

namespace carpus::simulation::detail {

inline constexpr std::uint8_t kNoPortal = procedure::kNoBody;
inline constexpr std::uint16_t kNothingHooked = 0xFFFF;
inline constexpr std::size_t kMaxLooks = 4096;
/// A point is seen once it was in view for so long without a break [E].
inline constexpr std::uint32_t kSeenTicks = 1000;

inline constexpr double kWarnN = 3.0;  ///< [E, B11] from published probing forces
inline constexpr double kInjuryN = 8.0;

struct ScopeState {
  double shaft_turn_deg = 0.0;
  double camera_turn_deg = 0.0;
  std::array<std::uint8_t, kHands> portal{kNoPortal, kNoPortal};
  std::array<bool, kHands> is_in_joint{};
  std::array<Vec3, kHands> last_tip{};
  std::array<double, 2> path_mm{};  ///< of the scope, of what works beside it
  std::array<std::uint32_t, cases::kMaxTourPoints> in_view_ticks{};  ///< since it came into view
  std::uint32_t points_in_view = 0;                                  ///< by their numbers
  std::uint32_t points_seen = 0;
  std::uint32_t points_probed = 0;
  std::uint32_t entries = 0;
  std::uint32_t pull_outs = 0;
  std::uint8_t last_entered = kNoPortal;  ///< by the scope
  std::uint32_t looking_ticks = 0;
  std::uint32_t tilted_ticks = 0;
  std::uint32_t warn_ticks = 0;
  std::uint32_t injury_ticks = 0;
  double most_force_n = 0.0;
  std::uint32_t look_count = 0;
  std::array<std::uint32_t, cases::kMaxLesions> lesion_ticks{};  ///< since it came into view
  std::uint32_t lesions_seen = 0;
  std::array<double, kHands> gives_mm{};  ///< by which a sheet has yielded to the tip
  std::array<std::uint8_t, kHands> gives_on{kNoSheet, kNoSheet};  ///< which
  std::array<Vec3, kHands> grip{};      ///< from the tip to what is hooked, when it was
  std::array<Vec3, kHands> felt{};      ///< force on each hand, of the tick before [N]
  std::array<bool, kHands> has_edge{};  ///< the probe's hook has touched its ulnar edge
  std::array<std::uint16_t, kHands> hooked{kNothingHooked, kNothingHooked};  ///< its particle
  cases::Grades answers = cases::not_judged();
};

template <Is<ScopeState> SomeState, typename Visitor>
void visit(SomeState& state, Visitor&& v) noexcept {
  v(state.shaft_turn_deg);
  v(state.camera_turn_deg);
  for (std::size_t h = 0; h < kHands; ++h) {
    v(state.portal[h]);
    v(state.is_in_joint[h]);
    v(state.last_tip[h]);
    v(state.path_mm[h]);
    v(state.gives_mm[h]);
    v(state.gives_on[h]);
    v(state.grip[h]);
    v(state.felt[h]);
    v(state.has_edge[h]);
    v(state.hooked[h]);
  }
  for (auto& ticks : state.in_view_ticks) v(ticks);
  v(state.points_in_view);
  v(state.points_seen);
  v(state.points_probed);
  v(state.entries);
  v(state.pull_outs);
  v(state.last_entered);
  v(state.looking_ticks);
  v(state.tilted_ticks);
  v(state.warn_ticks);
  v(state.injury_ticks);
  v(state.most_force_n);
  v(state.look_count);
  for (auto& ticks : state.lesion_ticks) v(ticks);
  v(state.lesions_seen);
  for (auto& grade : state.answers) v(grade);
}

template <typename SomeLook, typename Visitor>
void visit_look(SomeLook& look, Visitor&& v) noexcept {
  v(look.eye);
  v(look.axis);
  v(look.traction_n);
  v(look.flexion_rad);
  v(look.radial_deviation_rad);
  v(look.pronation_rad);
  v(look.joint);
}

/// Whether a tick could have left it in a case with so many portals.
[[nodiscard]] inline bool is_possible(const ScopeState& state, std::size_t portals) noexcept {
  bool is_sound = state.look_count <= kMaxLooks && state.shaft_turn_deg >= -180.0 &&
                  state.shaft_turn_deg <= 180.0 && state.camera_turn_deg >= -180.0 &&
                  state.camera_turn_deg <= 180.0 && state.most_force_n >= 0.0;
  for (std::size_t h = 0; h < kHands; ++h) {
    is_sound = is_sound && (state.portal[h] == kNoPortal || state.portal[h] < portals) &&
               (!state.is_in_joint[h] || state.portal[h] != kNoPortal) && state.path_mm[h] >= 0.0 &&
               state.gives_mm[h] >= 0.0 &&
               (state.gives_on[h] == kNoSheet || state.gives_on[h] < kMaxSheets);
  }
  return is_sound;
}

}  // namespace carpus::simulation::detail
