// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What sets an expert apart from a novice, in numbers. Engineering values: chosen so that the known
// mistakes appear (eccentric wire, screw too long, fewer views, several passes [clinical: B4, B5,
// C4]), not measured on people.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace carpus::trainee {

enum class Skill : std::uint8_t { Expert = 0, Novice = 1, Middle = 2 };
inline constexpr int kSkillCount = 3;

/// "expert", "novice", "middle".
[[nodiscard]] constexpr std::string_view name_of(Skill skill) noexcept {
  constexpr std::array<std::string_view, kSkillCount> kNames{"expert", "novice", "middle"};
  return kNames[static_cast<std::size_t>(skill) % kSkillCount];
}
[[nodiscard]] constexpr std::optional<Skill> skill_of(std::string_view name) noexcept {
  for (int i = 0; i < kSkillCount; ++i) {
    if (name_of(static_cast<Skill>(i)) == name) return static_cast<Skill>(i);
  }
  return std::nullopt;
}

/// A range from which one value is drawn evenly.
struct Range {
  double low = 0.0;
  double high = 0.0;
};

struct SkillProfile {
  Range entry_error_mm;         ///< distance of the chosen entry from the axis
  Range aim_error_mm;           ///< distance of the aim at the far pole from the axis
  double noticed_error_mm = 0;  ///< an offset larger than this is seen on the pictures and redone
  int most_passes = 1;          ///< then it is accepted
  double learning = 1.0;        ///< errors shrink by this with each new pass
  Range stop_before_far_mm;     ///< wire left this short of the far cortex; negative: through it
  Range ream_before_far_mm;     ///< where a drill is stopped, as seen on the pictures
  double screw_deduction_mm = 4.0;       ///< taken off the gauge's reading for the screw
  Range bury_mm;                         ///< how deep the screw's tail is driven
  double tremor_mm = 0.0;                ///< root mean square of the hand's tremor
  Range reaction_s;                      ///< pause before each new action
  double speed_mm_per_s = 50;            ///< mean speed of a free move
  Range drive_thrust_n;                  ///< push while drilling
  bool checks_oblique = true;            ///< takes the oblique and the proximal pole views
  bool finds_ring = true;                ///< looks down the bone before it goes in
  bool draws_wire_through = true;        ///< where a step asks for it
  double sleeve_share = 1.0;             ///< of operations in which a sleeve leads the wire
  double beside_structures_mm = 1.2;     ///< a wire's middle is driven out no nearer to one
  double noticed_displacement_mm = 1e9;  ///< a gap or step larger than this is seen and reduced
  Range reduction_error_mm;              ///< of where a fragment is led to
  int repeated_shots = 0;                ///< pictures taken again because they were not read
};

[[nodiscard]] SkillProfile profile_of(Skill skill) noexcept;

}  // namespace carpus::trainee
