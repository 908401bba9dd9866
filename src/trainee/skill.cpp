// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "trainee/skill.hpp"

namespace carpus::trainee {

SkillProfile profile_of(Skill skill) noexcept {
  SkillProfile profile;
  if (skill == Skill::Expert) {
    profile.entry_error_mm = {0.0, 0.7};
    profile.aim_error_mm = {0.0, 0.8};
    profile.noticed_error_mm = 1.2;
    profile.most_passes = 2;
    profile.learning = 0.5;
    profile.stop_before_far_mm = {0.1, 0.6};
    profile.ream_before_far_mm = {1.6, 2.6};
    profile.screw_deduction_mm = 4.0;
    profile.bury_mm = {1.8, 2.3};
    profile.tremor_mm = 0.08;
    profile.reaction_s = {0.2, 0.5};
    profile.speed_mm_per_s = 70;
    profile.drive_thrust_n = {26.0, 32.0};
    profile.checks_oblique = true;
    profile.noticed_displacement_mm = 0.8;
    profile.reduction_error_mm = {0.0, 0.4};
    profile.repeated_shots = 0;
    return profile;
  }
  if (skill == Skill::Middle) {  // between the two throughout
    profile.entry_error_mm = {0.7, 1.6};
    profile.aim_error_mm = {0.8, 2.0};
    profile.noticed_error_mm = 1.5;
    profile.most_passes = 3;
    profile.learning = 0.6;
    profile.stop_before_far_mm = {-0.2, 1.2};
    profile.ream_before_far_mm = {0.8, 3.5};
    profile.screw_deduction_mm = 3.5;
    profile.bury_mm = {1.0, 2.0};
    profile.tremor_mm = 0.15;
    profile.reaction_s = {0.4, 1.0};
    profile.speed_mm_per_s = 55;
    profile.drive_thrust_n = {25.0, 38.0};
    profile.checks_oblique = true;
    profile.sleeve_share = 0.85;
    profile.beside_structures_mm = 0.8;
    profile.noticed_displacement_mm = 1.3;
    profile.reduction_error_mm = {0.4, 1.2};
    profile.repeated_shots = 1;
    return profile;
  }
  profile.entry_error_mm = {1.6, 2.8};
  profile.aim_error_mm = {2.0, 3.6};
  profile.noticed_error_mm = 1.8;
  profile.most_passes = 3;
  profile.learning = 0.8;
  profile.stop_before_far_mm = {-1.0, 2.0};
  profile.ream_before_far_mm = {-0.5, 6.0};
  profile.screw_deduction_mm = 1.5;
  profile.bury_mm = {-0.3, 1.4};
  profile.tremor_mm = 0.25;
  profile.reaction_s = {0.6, 1.8};
  profile.speed_mm_per_s = 40;
  profile.drive_thrust_n = {24.0, 45.0};
  profile.checks_oblique = false;
  profile.finds_ring = false;
  profile.draws_wire_through = false;
  profile.sleeve_share = 0.2;
  profile.repeated_shots = 2;
  return profile;
}

}  // namespace carpus::trainee
