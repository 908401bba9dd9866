// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What our arm must do, closed from hand to hand: both drives, their firmware, real frames.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "device_bench/collision_question.hpp"
#include "device_bench/measures.hpp"
#include "device_bench/our_rig.hpp"
#include "device_bench/rows.hpp"

namespace carpus::device_bench {
namespace {

constexpr firmware::Drive kDrives[] = {firmware::Drive::Stop, firmware::Drive::Motor};
constexpr double kMostReturnedMj = 0.5;
constexpr double kMostFreeN = 0.2;
constexpr double kMostDepthMm = 1.1;
/// What three motors do to the tip by themselves, at most.
constexpr double kCoggingN = 0.45;

RigOptions of(firmware::Drive drive, const HandModel& hand, std::uint64_t seed = 1) {
  RigOptions options;
  options.drive = drive;
  options.hand = hand;
  options.seed = seed;
  return options;
}

class EveryHand : public testing::TestWithParam<std::tuple<firmware::Drive, HandModel>> {};

TEST_P(EveryHand, PressesOnAWallThatStandsStillAndIsHard) {
  const auto [drive, hand] = GetParam();
  for (const std::uint64_t seed : {1U, 2U}) {
    const auto rig = make_rig(of(drive, hand, seed));
    const Press pressed = press(*rig);
    EXPECT_TRUE(pressed.has_reached);
    EXPECT_TRUE(pressed.is_still(rig->quantum_mm())) << pressed.to_and_fro_mm;
    if (hand.stiffness_n_per_mm > 0) {
      EXPECT_NEAR(pressed.force_n, kPressN, 0.15);
      EXPECT_LE(pressed.depth_mm, kMostDepthMm);
    }
    EXPECT_TRUE(rig->plant().is_sound());
  }
}

/// Where one leg bears most of it, and where the weight is across.
constexpr double kThird = 0.57735026918962576;
constexpr Vec3 kBeside[] = {{1, 0, 0}, {0, -1, 0}, {kThird, kThird, kThird}, {-0.6, 0, -0.8}};

TEST_P(EveryHand, PressesOnAWallBesideItAsWell) {
  const auto [drive, hand] = GetParam();
  if (hand.stiffness_n_per_mm == 0) return;
  for (const Vec3& normal : kBeside) {
    RigOptions options = of(drive, hand);
    options.normal = normal;
    const auto rig = make_rig(options);
    const Press pressed = press(*rig);
    EXPECT_TRUE(pressed.is_still(rig->quantum_mm())) << pressed.to_and_fro_mm;
    EXPECT_LE(pressed.depth_mm, kMostDepthMm) << normal.x << " " << normal.y << " " << normal.z;
    EXPECT_GE(pressed.half_depth_mm, -kMostDepthMm) << "nor is it met in front of it";
  }
}

TEST_P(EveryHand, GetsNoMoreFromAWallThanItGaveIt) {
  const auto [drive, hand] = GetParam();
  for (const double speed : {50.0, -100.0, 150.0, 500.0}) {  // below 0: beside it
    RigOptions options = of(drive, hand);
    if (speed < 0) options.normal = kBeside[0];
    const auto rig = make_rig(options);
    const Strike struck = strike(*rig, std::abs(speed));
    EXPECT_LE(struck.most_given_mj, kMostReturnedMj) << speed << " mm/s";
    // Drive B's motors induce more than is added for it: that grows with speed, and is oil, no
    // hold.
    const double oil_n = drive == firmware::Drive::Motor ? 0.2e-3 * std::abs(speed) : 0;
    EXPECT_LE(struck.pulled_back_n, 0.4 + oil_n) << speed << " mm/s";
    EXPECT_TRUE(rig->plant().is_sound());
  }
}

TEST_P(EveryHand, FeelsLittleInFreeSpace) {
  const auto [drive, hand] = GetParam();
  if (hand.stiffness_n_per_mm == 0) return;  // it feels nothing
  const auto rig = make_rig(of(drive, hand));
  EXPECT_LE(free_space_n(*rig), kMostFreeN);
}

INSTANTIATE_TEST_SUITE_P(
    DeviceBench,
    EveryHand,
    testing::Combine(testing::ValuesIn(kDrives), testing::ValuesIn(virtual_arm::kHandModels)),
    [](const auto& one) {
      return std::string(std::get<0>(one.param) == firmware::Drive::Stop ? "A_" : "B_") +
             std::string(std::get<1>(one.param).name);
    });

/// A hand that leans on the wall, and a host that runs.
class Faults : public testing::TestWithParam<firmware::Drive> {
 protected:
  void SetUp() override {
    rig_ = std::make_unique<OurRig>(of(GetParam(), virtual_arm::kHandModels[2]));
    run(300);
    lean();
    run(400);
    ASSERT_TRUE(rig_->is_driven());
    ASSERT_NEAR(rig_->felt_along_n(), leaning_n_, 0.6);
  }
  void lean() {
    constexpr int kMs = 200;
    const Vec3& n = rig_->options().normal;
    const double deep = 11 + leaning_n_ / 0.5;
    for (int ms = 1; ms <= kMs; ++ms) {
      rig_->plant().set_intent({rig_->start() - n * (deep * ms / kMs), n * (-1000 * deep / kMs)});
      run(1);
    }
    rig_->plant().set_intent({rig_->start() - n * deep, {}});
  }
  void run(int ms) {
    for (int i = 0; i < ms; ++i) {
      rig_->run_ms();
      // Never out of the limit, never into the bone by more than cogging. While the motors come up
      // or the host is silent they do not hold the whole weight, which is no pull of theirs.
      const Vec3 force = force_of(rig_->plant().linkage_state(), rig_->arm().torques());
      ASSERT_LE(length(force), 9.0);
      driven_ms_ = rig_->is_driven() && !rig_->faults.host_is_silent ? driven_ms_ + 1 : 0;
      const double along = dot(rig_->options().normal, force);
      most_pull_n_ = std::max(most_pull_n_, driven_ms_ > 60 ? -rig_->driven_along_n() : -along);
    }
  }
  /// A wall in which the hand has sunk meanwhile does not throw it out: that would be work. It is
  /// there when the hand comes again.
  void expect_wall_again() {
    rig_->plant().set_intent({rig_->start(), {}});
    run(300);
    lean();
    run(400);
    EXPECT_NEAR(rig_->felt_along_n(), leaning_n_, 0.6);
    EXPECT_LE(most_pull_n_, kCoggingN);
  }
  /// From now on; -1: never in 200 ms.
  int ms_until(bool is_driven) {
    for (int ms = 0; ms < 200; ++ms) {
      if (rig_->is_driven() == is_driven) return ms;
      run(1);
    }
    return -1;
  }
  std::unique_ptr<OurRig> rig_;
  double leaning_n_ = 2;
  double most_pull_n_ = 0;
  int driven_ms_ = 0;
};

TEST_P(Faults, ASilentHostLosesTheForceWithin25MsAndAFrame) {
  rig_->faults.host_is_silent = true;
  const int ms = ms_until(false);
  EXPECT_GE(ms, 1);
  EXPECT_LE(ms, 26);
  run(50 - ms);
  EXPECT_FALSE(rig_->is_driven());
  rig_->faults.host_is_silent = false;
  EXPECT_GE(ms_until(true), 0) << "recovered";
  expect_wall_again();
}

TEST_P(Faults, ABadLineMakesNoWrongForce) {
  rig_->faults.corrupt = rig_->faults.lost = rig_->faults.doubled = rig_->faults.reordered = 0.01;
  const double before = rig_->felt_along_n();
  double least = 1e9;
  double most = -1e9;
  for (int ms = 0; ms < 3000; ++ms) {
    run(1);
    ASSERT_TRUE(rig_->is_driven()) << ms;
    least = std::min(least, rig_->felt_along_n());
    most = std::max(most, rig_->felt_along_n());
  }
  EXPECT_NEAR(least, before, 0.2);
  EXPECT_NEAR(most, before, 0.2);
  EXPECT_LE(most_pull_n_, kCoggingN);
}

TEST_P(Faults, ABrokenSensorTakesTheForceAwayUntilItIsWhole) {
  rig_->arm().faults.broken_sensor = 1;
  const int ms = ms_until(false);
  EXPECT_GE(ms, 0);
  EXPECT_LE(ms, 6);
  run(100);
  EXPECT_FALSE(rig_->is_driven());
  rig_->arm().faults.broken_sensor = -1;
  EXPECT_GE(ms_until(true), 0) << "recovered";
  expect_wall_again();
}

TEST_P(Faults, AfterABrownOutTheHostMakesItReadyAgain) {
  rig_->arm().brown_out();
  run(2);
  EXPECT_FALSE(rig_->is_driven());
  EXPECT_GE(ms_until(true), 0) << "recovered";
  expect_wall_again();
}

INSTANTIATE_TEST_SUITE_P(DeviceBench, Faults, testing::ValuesIn(kDrives), [](const auto& one) {
  return one.param == firmware::Drive::Stop ? "A" : "B";
});

TEST(CollisionQuestion, IsTheThesissAndAnswersByTheSideOfTheWall) {
  const Vec3 middle{0, 0, -130};
  const haptics::SurfacePlane wall{{0, 0, 1}, -140, {}};
  CollisionQuestion question(wall, middle);
  EXPECT_FALSE(question.meets(middle));
  EXPECT_FALSE(question.meets({3, 4, -139.9}));
  EXPECT_TRUE(question.meets({3, 4, -140}));
  EXPECT_TRUE(question.meets({-30, 20, -150}));
}

TEST(ThesisRig, IsOffInFreeSpaceHoldsAtCollisionAndSticks) {
  RigOptions options = of(firmware::Drive::Stop, virtual_arm::kHandModels[1]);
  options.law = Law::Thesis;
  auto rig = make_rig(options);
  EXPECT_GT(free_space_n(*rig), 0.5) << "gears that nobody drives";
  rig = make_rig(options);
  for (int ms = 0; ms < 100; ++ms) rig->run_ms();
  EXPECT_FALSE(rig->is_driven());
  rig = make_rig(options);
  EXPECT_GT(strike(*rig, 100).pulled_back_n, 0.5) << "a powered servo holds both ways";
}

TEST(ThesisRig, ASpringAt20MsRingsWhereOursStands) {
  RigOptions options = of(firmware::Drive::Motor, virtual_arm::kHandModels[2]);
  const auto ours = make_rig(options);
  EXPECT_TRUE(press(*ours).is_still(ours->quantum_mm()));
  options.law = Law::Thesis;
  const auto thesis = make_rig(options);
  EXPECT_FALSE(press(*thesis).is_still(thesis->quantum_mm()));
}

TEST(DeviceBench, IsTheSameInEveryRun) {
  for (const firmware::Drive drive : kDrives) {
    const auto run = [drive] {
      const auto rig = make_rig(of(drive, virtual_arm::kHandModels[0], 7));
      return press(*rig).depth_mm;
    };
    EXPECT_EQ(run(), run());
  }
}

}  // namespace
}  // namespace carpus::device_bench
