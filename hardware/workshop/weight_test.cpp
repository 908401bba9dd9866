// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the drawn arm weighs, from the parts' volumes: the program's own figures are held to it. And
// what the cords leave of it in the hand: drive A has nothing else to carry it; drive B's motors
// do.
#include <gtest/gtest.h>

#include <cmath>

#include "arm/arm_weight.hpp"
#include "core/units.hpp"
#include "geometry/triangle_mesh.hpp"
#include "hardware/workshop/assembly.hpp"

namespace carpus::hardware {
namespace {

constexpr double kSteel = 7.85e-3;  // g/mm3
constexpr double kAluminium = 2.7e-3;
constexpr double kCarbon = 1.55e-3;
constexpr double kTube = kPi * (9 - 4);  // mm2: 6 x 4 mm, rods and the tool's shaft
constexpr double kNutM4 = 0.75;          // g
/// Sensor, its screws and spacers, set screws, ring and magnet.
constexpr double kSmallOnTip = 7;
/// PETG of 1.27 g/cm3, three quarters full.
constexpr double kPrinted = 1.27e-3 * 0.75;

/// Integral of x^2 + y^2 over a closed surface's inside [mm5], by tetrahedra from the origin.
double second_moment_about_z(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& [i, j, k] : mesh.facets) {
    const Vec3& a = mesh.vertices[i];
    const Vec3& b = mesh.vertices[j];
    const Vec3& c = mesh.vertices[k];
    const double volume = dot(a, cross(b, c)) / 6;
    for (const std::size_t axis : {0, 1}) {
      sum += volume / 10 *
             (a[axis] * a[axis] + b[axis] * b[axis] + c[axis] * c[axis] + a[axis] * b[axis] +
              b[axis] * c[axis] + c[axis] * a[axis]);
    }
  }
  return sum;
}

/// @param leg  the drive's leg, drawn about its axis with the elbow along x.
arm::ArmWeight weigh(const Numbers& n, const Parts& parts, const char* leg) {
  const auto printed = [&](const char* name) { return volume_of(parts.at(name)) * kPrinted; };
  const double ball = kSteel * kPi / 6 * std::pow(n["ball"], 3);
  const double stud = kAluminium * kPi * 4 * 33 + 2 * kNutM4;
  const double magnet = 7.5e-3 * kPi * (25 - 4) * n["magnet_height"];
  const double rod = 2 * (printed("rod_end") + magnet) + kCarbon * kTube * (n["rod"] - 25);
  const double elbow = 2 * ball + stud + rod;
  const TriangleMesh& upper_arm = parts.at(leg);
  const Vec3 middle = centroid_of(upper_arm);
  arm::ArmWeight w;
  w.tip_g = printed("platform") + printed("gimbal_ring") + printed("carrier") +
            printed("tool_handle") + kSmallOnTip + kCarbon * kTube * 146 + 6 * ball + 3 * stud +
            3 * rod;
  w.leg_g = printed(leg) + elbow;
  w.along_mm = (printed(leg) * middle.x + elbow * n["upper_arm"]) / w.leg_g;
  w.above_mm = printed(leg) * middle.y / w.leg_g;
  w.leg_inertia_kg_mm2 =
      (second_moment_about_z(upper_arm) * kPrinted + elbow * n["upper_arm"] * n["upper_arm"]) /
      1000;
  return w;
}

void expect_is(const arm::ArmWeight& program, const arm::ArmWeight& drawn) {
  EXPECT_NEAR(program.tip_g, drawn.tip_g, 0.5);
  EXPECT_NEAR(program.leg_g, drawn.leg_g, 0.5);
  EXPECT_NEAR(program.along_mm, drawn.along_mm, 0.5);
  EXPECT_NEAR(program.above_mm, drawn.above_mm, 0.5);
  EXPECT_NEAR(program.leg_inertia_kg_mm2, drawn.leg_inertia_kg_mm2, 2);
}

TEST(Weight, OfTheProgramIsThatOfTheDrawnParts) {
  const Numbers n("hardware/parts/numbers.scad");
  const Parts parts = read_parts("hardware");
  expect_is(arm::kStopArmWeight, weigh(n, parts, "leg_a"));
  expect_is(arm::kMotorArmWeight, weigh(n, parts, "leg_b"));
}

TEST(Weight, TheProgramsCordsHangWhereTheDrawnOnesDo) {
  const Numbers n("hardware/parts/numbers.scad");
  const arm::LegCord cord;
  EXPECT_EQ(cord.slack_mm, n["spring_length"]);
  EXPECT_EQ(cord.tension_n, n["spring_tension"]);
  EXPECT_EQ(cord.rate_n_per_mm, n["spring_rate"]);
  EXPECT_EQ(cord.pin_mm, n["spring_on_leg"]);
  EXPECT_EQ(cord.mast_x_mm, n["mast_x"]);
  EXPECT_EQ(cord.mast_z_mm, n["mast_z"]);
}

/// Force at the tip [N] in 125 places of the workspace, to the sides and in height so far from its
/// middle: root mean square and greatest.
std::pair<double, double> felt(const arm::ArmWeight& weight, double aside_mm, double height_mm) {
  const arm::DeltaArm arm;
  double squares = 0;
  double most = 0;
  for (int i = 0; i < 125; ++i) {
    const Vec3 tip =
        arm.centre +
        Vec3{aside_mm * (i % 5 - 2), aside_mm * (i / 5 % 5 - 2), height_mm * (i / 25 - 2)} / 2;
    const auto angles = *arm::inverse(arm, tip);
    const double force =
        length(arm::force_at_tip(arm, angles, arm::weight_left(arm, angles, weight)));
    squares += force * force;
    most = std::max(most, force);
  }
  return {std::sqrt(squares / 125), most};
}

TEST(Weight, CordsCarryMostOfIt) {
  const arm::DeltaArm arm;
  const auto middle = *arm::inverse(arm, arm.centre);
  for (const arm::ArmWeight& weight : {arm::kStopArmWeight, arm::kMotorArmWeight}) {
    const double bare =
        length(arm::force_at_tip(arm, middle, arm::gravity_torques(arm, middle, weight)));
    const auto [left, left_most] = felt(weight, 50, 40);
    const auto [near, near_most] = felt(weight, 25, 20);
    std::printf(
        "tip %.0f g, leg %.0f g: weighs %.2f N; of it the cords leave %.2f N (%.2f at most), "
        "within "
        "25 mm of the middle %.2f N (%.2f)\n",
        weight.tip_g, weight.leg_g, bare, left, left_most, near, near_most);
    EXPECT_LT(left, 0.45);
    EXPECT_LT(left_most, 0.85);
    EXPECT_LT(near, 0.25);
    EXPECT_GT(bare, 4 * left);
  }
}

}  // namespace
}  // namespace carpus::hardware
