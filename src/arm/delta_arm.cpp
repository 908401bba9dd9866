// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arm/delta_arm.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/units.hpp"

namespace carpus::arm {
namespace {

firmware::Vector<double> vector_of(const Vec3& v) { return {v.x, v.y, v.z}; }

/// Eigenvalues of a symmetric 3 x 3 matrix in ascending order, in closed form
/// [smith1961eigenvalues].
std::array<double, 3> eigenvalues(const double (&m)[3][3]) {
  const double off = m[0][1] * m[0][1] + m[0][2] * m[0][2] + m[1][2] * m[1][2];
  const double mean = (m[0][0] + m[1][1] + m[2][2]) / 3;
  double p = 2 * off;
  for (int i = 0; i < 3; ++i) p += (m[i][i] - mean) * (m[i][i] - mean);
  p = std::sqrt(p / 6);
  if (!(p > 0)) return {mean, mean, mean};
  double b[3][3];
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) b[i][k] = (m[i][k] - (i == k ? mean : 0)) / p;
  }
  const double half_det = (b[0][0] * (b[1][1] * b[2][2] - b[1][2] * b[2][1]) -
                           b[0][1] * (b[1][0] * b[2][2] - b[1][2] * b[2][0]) +
                           b[0][2] * (b[1][0] * b[2][1] - b[1][1] * b[2][0])) /
                          2;
  const double phi = std::acos(std::clamp(half_det, -1.0, 1.0)) / 3;
  const double most = mean + 2 * p * std::cos(phi);
  const double least = mean + 2 * p * std::cos(phi + 2 * kPi / 3);
  return {least, 3 * mean - most - least, most};
}

}  // namespace

std::optional<LegAngles> inverse(const DeltaArm& arm, const Vec3& tip) noexcept {
  LegAngles angles{};
  const double a = arm.size.upper_arm;
  const double b = arm.size.rod;
  for (std::size_t i = 0; i < 3; ++i) {
    // Into the plane of the leg, z downwards: |elbow - p| = b becomes E cos t + F sin t = G.
    const double phi = 2 * kPi / 3 * static_cast<double>(i);
    const double x = tip.x * std::cos(phi) + tip.y * std::sin(phi) - arm.size.offset;
    const double y = -tip.x * std::sin(phi) + tip.y * std::cos(phi);
    const double z = -tip.z;
    const double e = 2 * a * x;
    const double f = 2 * a * z;
    const double g = x * x + y * y + z * z + a * a - b * b;
    const double reach = std::hypot(e, f);
    if (!(std::abs(g) <= reach)) return std::nullopt;
    angles[i] = std::atan2(f, e) - std::acos(g / reach);
  }
  return angles;
}

std::optional<Vec3> forward(const DeltaArm& arm, const LegAngles& angles) noexcept {
  const auto state = firmware::delta_forward(arm.size, angles.data());
  if (!state.is_valid) return std::nullopt;
  return Vec3{state.tip.x, state.tip.y, state.tip.z};
}

bool is_in_workspace(const DeltaArm& arm, const Vec3& tip) noexcept {
  const auto angles = inverse(arm, tip);
  if (!angles) return false;
  for (const double angle : *angles) {
    if (!(angle >= arm.least_angle && angle <= arm.most_angle)) return false;
  }
  return forward(arm, *angles).has_value();
}

std::optional<Strength> strength_at(const DeltaArm& arm, const Vec3& tip) noexcept {
  if (!is_in_workspace(arm, tip)) return std::nullopt;
  const auto state = firmware::delta_forward(arm.size, inverse(arm, tip)->data());
  // tau = J^T F: a force of length 1 needs at most the largest torque of any leg, over all
  // directions the longest row of J^T; |tau| as a whole lies between the singular values of J.
  double product[3][3] = {};
  double longest = 0;
  double jacobian[3][3];
  for (int k = 0; k < 3; ++k) {
    const Vec3 axis{k == 0 ? 1.0 : 0.0, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0};
    double torques[3];
    firmware::delta_torques(state, vector_of(axis), torques);
    for (int i = 0; i < 3; ++i) jacobian[k][i] = torques[i];
  }
  for (int i = 0; i < 3; ++i) {
    double square = 0;
    for (int k = 0; k < 3; ++k) {
      square += jacobian[k][i] * jacobian[k][i];
      for (int j = 0; j < 3; ++j) product[k][j] += jacobian[k][i] * jacobian[j][i];
    }
    longest = std::max(longest, std::sqrt(square));
  }
  const auto squares = eigenvalues(product);
  return Strength{1000 / longest, std::sqrt(squares[2] / squares[0])};
}

}  // namespace carpus::arm
