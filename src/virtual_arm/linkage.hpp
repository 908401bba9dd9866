// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// An arm of three joints as the plant needs it: where the tip is, how it moves with each joint, and
// what the arm's own weight does to the joints. Two of them: our delta, and the serial arm of the
// thesis.
#pragma once

#include <array>

#include "arm/arm_weight.hpp"
#include "geometry/vec3.hpp"

namespace carpus::virtual_arm {

using JointValues = std::array<double, 3>;

struct LinkageState {
  Vec3 tip;                       ///< [mm]
  std::array<Vec3, 3> columns{};  ///< of the Jacobian: the tip's way with each joint [mm/rad]
  bool is_valid = false;
};

/// v = J w [mm/s].
[[nodiscard]] Vec3 velocity_of(const LinkageState& state, const JointValues& rates) noexcept;
/// tau = J^T F [N mm].
[[nodiscard]] JointValues torques_of(const LinkageState& state, const Vec3& force) noexcept;
/// F with J^T F = tau [N]; zero where the arm is singular.
[[nodiscard]] Vec3 force_of(const LinkageState& state, const JointValues& torques) noexcept;

class Linkage {
 public:
  Linkage() = default;
  Linkage(const Linkage&) = delete;
  Linkage& operator=(const Linkage&) = delete;
  virtual ~Linkage() = default;
  [[nodiscard]] virtual LinkageState at(const JointValues& angles) const noexcept = 0;
  /// What the links' weight, without the tip's, does to the joints, with cords that carry it
  /// [N mm].
  [[nodiscard]] virtual JointValues weight_torques(const JointValues& angles) const noexcept = 0;
};

class DeltaLinkage final : public Linkage {
 public:
  DeltaLinkage(const arm::DeltaArm& arm, const arm::ArmWeight& weight)
      : arm_(arm), weight_(weight) {}
  [[nodiscard]] LinkageState at(const JointValues& angles) const noexcept override;
  [[nodiscard]] JointValues weight_torques(const JointValues& angles) const noexcept override;

 private:
  arm::DeltaArm arm_;
  arm::ArmWeight weight_;
};

/// The thesis's arm [yaacoub2008] figures 6.1 to 6.4: a motor at the base that turns all of it
/// about the vertical, and two more that bend it, each beside its potentiometer; the thesis gives
/// no lengths. Ours: two links of 120 mm, which reach what the delta reaches.
///
///   r = L1 cos q2 + L2 cos (q2 + q3),  p = (r cos q1, r sin q1, L1 sin q2 + L2 sin (q2 + q3))
class SerialLinkage final : public Linkage {
 public:
  struct Size {
    double upper_mm = 120;
    double fore_mm = 120;
    /// The second motor stands at the base's turntable; the third, 44 g, at the elbow [E], and
    /// links of 30 g.
    double elbow_grams = 60;
    double fore_grams = 20;  ///< in the middle of the forearm
  };
  SerialLinkage() = default;
  explicit SerialLinkage(const Size& size) : size_(size) {}
  [[nodiscard]] LinkageState at(const JointValues& angles) const noexcept override;
  [[nodiscard]] JointValues weight_torques(const JointValues& angles) const noexcept override;
  /// Angles with the elbow up; false where it is out of reach.
  [[nodiscard]] bool inverse(const Vec3& tip, JointValues& angles) const noexcept;

 private:
  Size size_;
};

}  // namespace carpus::virtual_arm
