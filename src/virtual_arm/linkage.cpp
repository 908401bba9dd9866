// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "virtual_arm/linkage.hpp"

#include <algorithm>
#include <cmath>

namespace carpus::virtual_arm {
namespace {
constexpr double kGravityNPerGram = 9.80665e-3;
constexpr double kLeastVolume = 1e-3;
}  // namespace

Vec3 velocity_of(const LinkageState& state, const JointValues& rates) noexcept {
  return state.columns[0] * rates[0] + state.columns[1] * rates[1] + state.columns[2] * rates[2];
}

JointValues torques_of(const LinkageState& state, const Vec3& force) noexcept {
  return {dot(state.columns[0], force), dot(state.columns[1], force), dot(state.columns[2], force)};
}

Vec3 force_of(const LinkageState& state, const JointValues& torques) noexcept {
  const auto& j = state.columns;
  const double volume = dot(j[0], cross(j[1], j[2]));
  if (!(std::abs(volume) > kLeastVolume)) return {};
  return (cross(j[1], j[2]) * torques[0] + cross(j[2], j[0]) * torques[1] +
          cross(j[0], j[1]) * torques[2]) /
         volume;
}

LinkageState DeltaLinkage::at(const JointValues& angles) const noexcept {
  const auto state = firmware::delta_forward(arm_.size, angles.data());
  LinkageState out;
  out.tip = {state.tip.x, state.tip.y, state.tip.z};
  out.is_valid = state.is_valid;
  if (!state.is_valid) return out;
  for (std::size_t i = 0; i < 3; ++i) {
    double rates[3] = {0, 0, 0};
    rates[i] = 1;
    const auto column = firmware::delta_velocity(state, rates);
    out.columns[i] = {column.x, column.y, column.z};
  }
  return out;
}

JointValues DeltaLinkage::weight_torques(const JointValues& angles) const noexcept {
  arm::ArmWeight legs = weight_;
  legs.tip_g = 0;
  JointValues torques = arm::weight_left(arm_, angles, legs);
  for (double& torque : torques) torque = -torque;
  return torques;
}

LinkageState SerialLinkage::at(const JointValues& angles) const noexcept {
  const double c1 = std::cos(angles[0]);
  const double s1 = std::sin(angles[0]);
  const double c2 = std::cos(angles[1]);
  const double s2 = std::sin(angles[1]);
  const double c23 = std::cos(angles[1] + angles[2]);
  const double s23 = std::sin(angles[1] + angles[2]);
  const double r = size_.upper_mm * c2 + size_.fore_mm * c23;
  const double z = size_.upper_mm * s2 + size_.fore_mm * s23;
  LinkageState out;
  out.tip = {r * c1, r * s1, z};
  out.columns[0] = {-r * s1, r * c1, 0};
  out.columns[1] = {-z * c1, -z * s1, r};
  out.columns[2] = {-size_.fore_mm * s23 * c1, -size_.fore_mm * s23 * s1, size_.fore_mm * c23};
  out.is_valid = r > 1 && std::abs(std::sin(angles[2])) > 0.05;
  return out;
}

JointValues SerialLinkage::weight_torques(const JointValues& angles) const noexcept {
  const double elbow_mm = size_.upper_mm * std::cos(angles[1]);
  const double fore_mm = 0.5 * size_.fore_mm * std::cos(angles[1] + angles[2]);
  const double fore = size_.fore_grams * kGravityNPerGram;
  return {0, -size_.elbow_grams * kGravityNPerGram * elbow_mm - fore * (elbow_mm + fore_mm),
          -fore * fore_mm};
}

bool SerialLinkage::inverse(const Vec3& tip, JointValues& angles) const noexcept {
  const double r = std::hypot(tip.x, tip.y);
  const double cosine =
      (r * r + tip.z * tip.z - size_.upper_mm * size_.upper_mm - size_.fore_mm * size_.fore_mm) /
      (2 * size_.upper_mm * size_.fore_mm);
  if (!(std::abs(cosine) < 1)) return false;
  angles[0] = std::atan2(tip.y, tip.x);
  angles[2] = -std::acos(cosine);
  angles[1] = std::atan2(tip.z, r) - std::atan2(size_.fore_mm * std::sin(angles[2]),
                                                size_.upper_mm + size_.fore_mm * cosine);
  return true;
}

}  // namespace carpus::virtual_arm
