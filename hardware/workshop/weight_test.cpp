// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the arm weighs in the hand, from the parts' volumes, and what the cords leave of it. Drive
// A has nothing else to carry it; drive B's motors do.
#include <gtest/gtest.h>

#include <cmath>

#include "arm/delta_arm.hpp"
#include "core/units.hpp"
#include "hardware/workshop/assembly.hpp"

namespace carpus::hardware {
namespace {

constexpr double kGravity = 9.80665e-3;  // N/g
constexpr double kSteel = 7.85e-3;       // g/mm3
/// PETG of 1.27 g/cm3, three quarters full.
constexpr double kPrinted = 1.27e-3 * 0.75;

struct Weights {
  double tip_g = 0;
  double leg_g = 0;
  double leg_mm = 0;
};

Weights weigh(const Numbers& n, const Parts& parts) {
  const auto printed = [&](const char* name) { return volume_of(parts.at(name)) * kPrinted; };
  const double ball = kSteel * kPi / 6 * std::pow(n["ball"], 3);
  const double stud = kSteel * (kPi * 4 * 36 + 4 * 25);
  const double magnet = 7.5e-3 * kPi * (25 - 4) * n["magnet_height"];
  const double rod = 2 * (printed("rod_end") + magnet) + 1.55e-3 * kPi * 5 * (n["rod"] - 25);
  Weights w;
  w.tip_g = printed("platform") + printed("gimbal_ring") + printed("carrier") +
            printed("tool_handle") + 3 + 2.7e-3 * kPi * 9 * 150 + 6 * ball + 3 * stud + 3 * rod;
  const double elbow = 2 * ball + stud + rod;
  w.leg_g = printed("leg_a") + elbow;
  w.leg_mm = (printed("leg_a") * 33 + elbow * n["upper_arm"]) / w.leg_g;
  return w;
}

/// Energy [N mm] of a leg's elastic cord.
double spring(const Numbers& n, double angle) {
  const double length = std::hypot(n["spring_on_leg"] * std::cos(angle) - n["mast_x"],
                                   -n["spring_on_leg"] * std::sin(angle) - n["mast_z"]);
  const double open = std::max(0.0, length - n["spring_length"]);
  return n["spring_tension"] * open + n["spring_rate"] * open * open / 2;
}

/// Force at the tip [N], root mean square and greatest over the workspace.
std::pair<double, double> felt(const Numbers& n, const Weights& w, bool has_springs) {
  const arm::DeltaArm arm;
  const auto energy = [&](const Vec3& tip) {
    const auto angles = *arm::inverse(arm, tip);
    double sum = w.tip_g * kGravity * tip.z;
    for (const double angle : angles) {
      sum -= w.leg_g * kGravity * w.leg_mm * std::sin(angle);
      if (has_springs) sum += spring(n, angle);
    }
    return sum;
  };
  double squares = 0;
  double most = 0;
  int count = 0;
  for (int i = 0; i < 125; ++i) {
    const Vec3 tip =
        arm.centre + Vec3{25.0 * (i % 5 - 2), 25.0 * (i / 5 % 5 - 2), 20.0 * (i / 25 - 2)};
    Vec3 force;
    for (std::size_t k = 0; k < 3; ++k) {
      Vec3 step;
      step[k] = 0.01;
      force[k] = -(energy(tip + step) - energy(tip - step)) / 0.02;
    }
    squares += squared_length(force);
    most = std::max(most, length(force));
    ++count;
  }
  return {std::sqrt(squares / count), most};
}

TEST(Weight, CordsCarryMostOfIt) {
  const Numbers numbers("hardware/parts/numbers.scad");
  const Weights weights = weigh(numbers, read_parts("hardware"));
  const auto [bare, bare_most] = felt(numbers, weights, false);
  const auto [left, left_most] = felt(numbers, weights, true);
  std::printf("tip %.0f g, leg %.0f g at %.0f mm: %.2f N (%.2f at most); with cords %.2f (%.2f)\n",
              weights.tip_g, weights.leg_g, weights.leg_mm, bare, bare_most, left, left_most);
  EXPECT_LT(weights.tip_g, 130);
  EXPECT_LT(left, 0.5);
  EXPECT_LT(left_most, 0.9);
  EXPECT_GT(bare, 3 * left);
}

}  // namespace
}  // namespace carpus::hardware
