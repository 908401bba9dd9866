// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "devices/arm_calibration.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "core/error.hpp"
#include "devices/fake_arm_test_support.hpp"

namespace carpus::devices {
namespace {

TEST(ArmCalibration, IsReadAsItWasStored) {
  const TemporaryFolder folder;
  ArmCalibration a = fake_calibration(firmware::Drive::Stop, 4294967295U);
  a.legs[1].residuals = {{0.01, 100}, {-0.02, 2000.5}, {0.01, 4000}};
  a.servos[2].pulse_per_half_turn_us = -2000;
  const ArmCalibration b = fake_calibration(firmware::Drive::Motor, 3);
  store(a, folder.path() / "deeper" / "still");
  store(b, folder.path() / "deeper" / "still");
  std::vector<std::string> problems;
  const auto all = load_calibrations(folder.path() / "deeper" / "still", problems);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_TRUE(problems.empty());
  const ArmCalibration& read = all[all[0].drive == firmware::Drive::Stop ? 0 : 1];
  EXPECT_EQ(read.unit, a.unit);
  EXPECT_EQ(read.legs[1].residuals.size(), 3U);
  EXPECT_EQ(read.legs[1].angle_at(2000.5), a.legs[1].angle_at(2000.5));
  EXPECT_EQ(read.servos[2].pulse_per_half_turn_us, -2000);
  EXPECT_EQ(all[all[0].drive == firmware::Drive::Stop ? 1 : 0].zero_in_turn, b.zero_in_turn);
}

TEST(ArmCalibration, WhatCannotBeReadIsToldAndTheOthersAreTaken) {
  const TemporaryFolder folder;
  store(fake_calibration(firmware::Drive::Motor, 3), folder.path());
  std::ofstream(folder.path() / "arm_a_1.json") << "{\"version\": 1, \"drive\": \"C\"}";
  std::ofstream(folder.path() / "arm_a_2.json") << "not json";
  std::vector<std::string> problems;
  EXPECT_EQ(load_calibrations(folder.path(), problems).size(), 1U);
  EXPECT_EQ(problems.size(), 2U);
  EXPECT_TRUE(load_calibrations(folder.path() / "none", problems).empty());
}

TEST(ArmCalibration, NumbersThatCannotBeAreRefused) {
  const TemporaryFolder folder;
  const auto text_of = [&](const ArmCalibration& calibration) {
    store(calibration, folder.path());
    std::ifstream file(folder.path() / calibration_file_name(calibration.drive, calibration.unit));
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  ArmCalibration flat = fake_calibration(firmware::Drive::Stop, 1);
  flat.legs[0].rad_per_count = 0;
  EXPECT_THROW((void)parse_calibration(text_of(flat), "flat"), InvalidInput);
  ArmCalibration mixed = fake_calibration(firmware::Drive::Stop, 1);
  mixed.legs[0].residuals = {{0, 300}, {0, 200}};
  EXPECT_THROW((void)parse_calibration(text_of(mixed), "mixed"), InvalidInput);
  ArmCalibration narrow = fake_calibration(firmware::Drive::Stop, 1);
  narrow.servos[0].most_pulse_us = narrow.servos[0].least_pulse_us;
  EXPECT_THROW((void)parse_calibration(text_of(narrow), "narrow"), InvalidInput);
}

TEST(ArmCalibration, TheTurnOfAMotorIsFoundFromTheCradle) {
  const auto at_rest = static_cast<std::int32_t>(cradle_angle_rad() / kRadPerMotorCount);
  for (const int turn : {-3, 0, 5}) {
    for (const int off : {-8000, 0, 8000}) {
      const std::int32_t zero = 1234 + turn * kCountsOfTurn;
      EXPECT_EQ(home_of(1234, zero + at_rest + off), zero);
    }
  }
}

TEST(ArmCalibration, TheFolderIsThePersonsOwn) {
  ::setenv("XDG_CONFIG_HOME", "/somewhere", 1);
  EXPECT_EQ(calibration_folder(), "/somewhere/carpus/devices");
  ::setenv("XDG_CONFIG_HOME", "relative", 1);
  ::setenv("HOME", "/home/someone", 1);
  EXPECT_EQ(calibration_folder(), "/home/someone/.config/carpus/devices");
  ::unsetenv("XDG_CONFIG_HOME");
}

}  // namespace
}  // namespace carpus::devices
