// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "hardware/workshop/clearance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "arm/delta_arm.hpp"
#include "core/rng.hpp"
#include "core/units.hpp"

namespace carpus::hardware {
namespace {

/// Printed parts may be so much off, and play so much, before they rub.
constexpr double kLeastClearanceMm = 0.4;

/// Middle, sides, edges and corners of the workspace, and high above, where the rods come
/// nearest to the plate's edge.
std::vector<Vec3> poses() {
  std::vector<Vec3> tips;
  const Vec3 centre = arm::DeltaArm{}.centre;
  for (int i = 0; i < 27; ++i) {
    tips.push_back(centre + Vec3{50.0 * (i % 3 - 1), 50.0 * (i / 3 % 3 - 1), 40.0 * (i / 9 - 1)});
  }
  for (int i = 0; i < 6; ++i) {
    const double turn = radians_from_degrees(15 + 60.0 * i);
    tips.push_back(centre + Vec3{33 * std::cos(turn), 33 * std::sin(turn), 40});
  }
  return tips;
}

TEST(Clearance, OfTrianglesIsThatOfTheirNearestPoints) {
  Rng rng(1);
  const auto point = [&](double z) { return Vec3{rng.uniform(-2, 2), rng.uniform(-2, 2), z}; };
  for (int i = 0; i < 300; ++i) {
    // Sampled densely the distance is a little more, never less.
    std::array<Vec3, 3> a;
    std::array<Vec3, 3> b;
    for (auto& corner : a) corner = point(rng.uniform(-1, 1));
    for (auto& corner : b) corner = point(rng.uniform(0, 2));
    const double said = triangle_distance(a, b);
    double sampled = 1e9;
    constexpr int kSteps = 12;
    const auto at = [](const std::array<Vec3, 3>& t, int u, int v) {
      const double s = static_cast<double>(u) / kSteps;
      const double r = static_cast<double>(v) / kSteps;
      return t[0] + (t[1] - t[0]) * s + (t[2] - t[0]) * r;
    };
    for (int u = 0; u <= kSteps; ++u) {
      for (int v = 0; u + v <= kSteps; ++v) {
        for (int p = 0; p <= kSteps; ++p) {
          for (int q = 0; p + q <= kSteps; ++q)
            sampled = std::min(sampled, distance(at(a, u, v), at(b, p, q)));
        }
      }
    }
    EXPECT_LE(said, sampled + 1e-12);
    EXPECT_GE(said, sampled - 0.6);
  }
}

TEST(Clearance, SeesAPieceThatMeetsAnother) {
  const std::vector<Piece> pieces{
      {"one", Group::Base, Material::Frame, box({0, 0, 0}, {10, 10, 10}), -1},
      {"other", Group::Leg0, Material::Frame, moved(ball(3), at({13.5, 5, 5})), -1},
      {"crossing", Group::Leg1, Material::Frame, cylinder(1, -5, 15), -1}};
  const auto found = Clearance().near_pairs(pieces, 1);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].distance_mm, 0);
  EXPECT_NEAR(found[1].distance_mm, 0.5, 1e-9);
}

TEST(Clearance, NothingRubsInTheWorkspaceWithEitherDrive) {
  const Numbers numbers("hardware/parts/numbers.scad");
  const Parts parts = read_parts("hardware");
  for (const Drive drive : {Drive::A, Drive::B}) {
    Clearance clearance;
    for (const Vec3& tip : poses()) {
      // The drives differ near the legs' ends of travel alone: the corners and the high places.
      const bool is_corner = std::abs(tip.x * tip.y) > 2000 && tip.z != arm::DeltaArm{}.centre.z;
      const bool is_high = tip.z > -91 && std::hypot(tip.x, tip.y) < 34;
      if (drive == Drive::B && !is_corner && !is_high) continue;
      AssemblyOptions options;
      options.drive = drive;
      options.tip = tip;
      ASSERT_TRUE(arm::is_in_workspace({}, options.tip));
      options.has_tool = tool_may_be_at(options.tip);
      for (const Nearness& near : clearance.near_pairs(assemble(numbers, parts, options), 0.5)) {
        EXPECT_GE(near.distance_mm, kLeastClearanceMm)
            << near.one << " and " << near.other << " at " << options.tip.x << " " << options.tip.y
            << " " << options.tip.z;
      }
    }
  }
}

TEST(Clearance, TheSlotIsAsWideAsTheProgramHasIt) {
  // The dog with its pads of 1 mm touches the fork's faces when it has turned by the gap, not
  // before: from the middle it goes both ways.
  const Numbers numbers("hardware/parts/numbers.scad");
  const Parts parts = read_parts("hardware");
  const auto play = [&](double share) {
    AssemblyOptions options;
    options.dog = share;
    std::vector<Piece> two;
    for (Piece& piece : assemble(numbers, parts, options)) {
      if (piece.leg == 0 && (piece.name == "leg_a" || piece.name == "fork")) {
        piece.name = piece.name == "fork" ? "slot" : "dog";
        two.push_back(std::move(piece));
      }
    }
    const auto found = Clearance().near_pairs(two, 3);
    return found.empty() ? 3.0 : found.front().distance_mm;
  };
  // At the gap there is room for the pads, 1 mm; a quarter farther bare faces are nearer by what
  // the dog's edge, 13.2 mm from the axis, has turned; at six tenths more they have met.
  for (const double side : {-1.0, 1.0}) {
    EXPECT_NEAR(play(side), 1.0, 0.15);
    const double turned = radians_from_degrees(0.25 * numbers["slot_gap"]) * 13.2;
    EXPECT_NEAR(play(side * 1.25), 1.0 - turned, 0.15);
    EXPECT_EQ(play(side * 1.6), 0);
  }
}

}  // namespace
}  // namespace carpus::hardware
