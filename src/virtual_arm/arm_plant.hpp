// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The moving arm with a hand on it: three joints with inertia and friction, a tip with the hand's
// mass that hangs on them by a structure that yields, weight. Sensors and motors are on the joints'
// side of that structure. Semi-implicit Euler on the caller's clock; the same bytes in every run.
#pragma once

#include "virtual_arm/hand.hpp"
#include "virtual_arm/linkage.hpp"

namespace carpus::virtual_arm {

/// Estimates for printed parts, but for what is said.
struct ArmBody {
  double joint_inertia_kg_mm2 = 0;  ///< of a leg, with its drive's where that turns with it
  double tip_kg = 0;
  /// Potentiometer (3.68 N mm by its data sheet [yaacoub2008] appendix B.2) or bearing and motor:
  /// 0.1 N at the tip.
  double joint_friction_n_mm = 3.7;
  double joint_viscosity_n_mm_s = 0.3;
  double structure_n_per_mm = 5;  ///< printed arms and rods: 1.5 to 10
  double structure_n_s_per_mm = 0.0015;
  /// Where a joint's way ends, and it stays: the drawn legs are held 4 degrees beyond theirs, by
  /// the servo's end (drive A) or the sector's (drive B).
  double least_rad = -1e3;
  double most_rad = 1e3;
  /// Share of the arm's weight, less what the linkage's cords carry, that counterweights do.
  double balanced_share = 0;
};

/// Of the arm that is drawn (arm/arm_weight.hpp). @param drive_kg_mm2  what a drive's rotor adds to
/// each leg.
[[nodiscard]] ArmBody body_of(const arm::ArmWeight& weight, double drive_kg_mm2 = 0) noexcept;

class ArmPlant {
 public:
  /// @param linkage  stays where it is. Starts at rest at `angles`.
  ArmPlant(const Linkage& linkage, const ArmBody& body, const JointValues& angles);

  void set_hand(const HandModel& hand) { hand_ = hand; }
  void set_intent(const Intent& intent) { intent_ = intent; }

  /// @param torques  of the drives on the joints [N mm].
  void step(double seconds, const JointValues& torques) noexcept;

  [[nodiscard]] const JointValues& angles() const noexcept { return angles_; }
  [[nodiscard]] const JointValues& rates() const noexcept { return rates_; }
  /// Of the linkage, where sensors see it.
  [[nodiscard]] const LinkageState& linkage_state() const noexcept { return state_; }
  /// Of the hand's end of the structure [mm], [mm/s].
  [[nodiscard]] const Vec3& tip() const noexcept { return tip_; }
  [[nodiscard]] const Vec3& tip_velocity() const noexcept { return tip_velocity_; }
  /// Of the arm on the hand [N].
  [[nodiscard]] const Vec3& felt_n() const noexcept { return felt_; }
  /// Torques that the drives would need to hold the arm's weight, less what is balanced [N mm].
  [[nodiscard]] JointValues weight_to_hold() const noexcept;
  /// False from the step on in which the arm reached a singularity or was not finite; it stands.
  [[nodiscard]] bool is_sound() const noexcept { return is_sound_; }

 private:
  const Linkage& linkage_;
  ArmBody body_;
  HandModel hand_ = kReleasedHand;
  Intent intent_;
  JointValues angles_;
  JointValues rates_{};
  LinkageState state_;
  Vec3 tip_;
  Vec3 tip_velocity_;
  Vec3 felt_;
  bool is_sound_ = true;
};

}  // namespace carpus::virtual_arm
