// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/plausible_hand_motion.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "cases/make_hand_motion.hpp"
#include "cases/synthetic_case_test_support.hpp"

namespace carpus::cases {
namespace {

using anatomy::CarpalGroup;
using ::testing::HasSubstr;

const HandMotion& made() {
  static const HandMotion motion = make_hand_motion(test::synthetic_case());
  return motion;
}

constexpr auto kHand = static_cast<std::size_t>(CarpalGroup::Hand);

std::string problem_with(const std::function<void(HandMotion&)>& change) {
  HandMotion motion = made();
  change(motion);
  return problem_of_motion(motion).value_or("none");
}

TEST(PlausibleHandMotion, TheTableThatIsMadeIsOne) {
  EXPECT_EQ(problem_of_motion(made()).value_or("none"), "none");
}

TEST(PlausibleHandMotion, LimitsAreThoseOfAWrist) {
  EXPECT_THAT(
      problem_with([](HandMotion& m) { m.limits.flexion_rad.high = m.flexion_rad.back() = 40; }),
      HasSubstr("beyond what any wrist can do"));
  EXPECT_THAT(problem_with([](HandMotion& m) { m.limits.pronation_rad.low = -1e5; }),
              HasSubstr("beyond what any wrist can do"));
  EXPECT_THAT(problem_with([](HandMotion& m) { m.limits.traction_n.high = 1e5; }),
              HasSubstr("beyond what any wrist can do"));
  EXPECT_THAT(problem_with([](HandMotion& m) { m.limits.flexion_rad.high -= 0.1; }),
              HasSubstr("from limit to limit"));
}

TEST(PlausibleHandMotion, AxesLieInTheWrist) {
  EXPECT_THAT(problem_with([](HandMotion& m) { m.hand_axis = {}; }), HasSubstr("unit length"));
  EXPECT_THAT(problem_with([](HandMotion& m) { m.pronation_axis.x += 3; }),
              HasSubstr("unit length"));
  EXPECT_THAT(problem_with([](HandMotion& m) { m.pronation_centre.y += 5000; }),
              HasSubstr("beside the wrist"));
  EXPECT_THAT(problem_with([](HandMotion& m) { m.midcarpal_mm_per_n = 50; }),
              HasSubstr("no joint opens"));
  EXPECT_THAT(problem_with([](HandMotion& m) { m.radiocarpal_mm_per_n = -1; }),
              HasSubstr("no joint opens"));
}

TEST(PlausibleHandMotion, InThePoseOfTheScanAllIsWhereItWasScanned) {
  EXPECT_THAT(problem_with([](HandMotion& m) { m.scan.flexion_rad += 0.01; }),
              HasSubstr("none of the table's"));
  EXPECT_THAT(problem_with([](HandMotion& m) {
                for (HandMotionNode& node : m.nodes) node.groups[kHand].shift.z += 1;
              }),
              HasSubstr("not where it was scanned"));
}

TEST(PlausibleHandMotion, NoBoneJumpsOrLeavesTheWrist) {
  EXPECT_THAT(problem_with([](HandMotion& m) { m.nodes.front().groups[kHand].shift.x += 60; }),
              HasSubstr("jumps"));
  EXPECT_THAT(problem_with([](HandMotion& m) { m.nodes.back().groups[kHand].shift.x += 1e5; }),
              ::testing::AnyOf(HasSubstr("jumps"), HasSubstr("farther than in any wrist")));
  EXPECT_THAT(problem_with([](HandMotion& m) {
                m.nodes.back().groups[kHand].quaternion = {0, 0, 0, 1};
              }),
              ::testing::AnyOf(HasSubstr("jumps"), HasSubstr("farther than in any wrist")));
  EXPECT_THAT(problem_with([](HandMotion& m) { m.pronation_shift.front().x += 9.5; }),
              HasSubstr("jumps in pronation"));
  EXPECT_THAT(problem_with([](HandMotion& m) { m.pronation_shift.front().x += 900; }),
              HasSubstr("away from the ulna"));
}

}  // namespace
}  // namespace carpus::cases
