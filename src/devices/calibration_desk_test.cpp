// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "devices/calibration_desk.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "devices/host_loop.hpp"

namespace carpus::devices {
namespace {

namespace fs = std::filesystem;

/// An arm of drive B that lies in its cradle.
class ArmAtRest final : public Device {
 public:
  explicit ArmAtRest(std::atomic<int>& opened) : opened_(opened) {}
  [[nodiscard]] Capabilities capabilities() const override {
    Capabilities able;
    able.position = able.force = able.local_plane = true;
    return able;
  }
  void open() override { ++opened_; }
  void close() noexcept override {}
  void poll(Nanoseconds now, DeviceState& state) noexcept override {
    state.health = Health::Uncalibrated;
    state.heard_ns = now;
    state.has_unit = true;
    state.unit = 12;
    state.raw_counts = {100, 200, 300};
    state.raw_samples = ++samples_;
    state.windings.progress = static_cast<std::uint8_t>(is_turning_ ? firmware::Progress::Found
                                                                    : firmware::Progress::Waiting);
    state.windings.windings = {1, 2, 1};
  }
  void turn_servos(int pulse_us) noexcept override { is_turning_ = pulse_us != 0; }
  void command(Nanoseconds, const DeviceCommand&) noexcept override {}

 private:
  std::atomic<int>& opened_;
  std::uint64_t samples_ = 0;
  bool is_turning_ = false;
};

class CalibrationDeskTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "carpus-desk-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    loop_ = std::make_unique<HostLoop>(std::make_unique<ArmAtRest>(opened_));
    ASSERT_TRUE(comes([this] { return loop_->look(state_) && state_.device.has_unit; }));
  }
  void TearDown() override {
    loop_.reset();
    fs::remove_all(folder_);
  }
  static bool comes(const std::function<bool()>& it) {
    for (int i = 0; i < 5000; ++i) {
      if (it()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return false;
  }

  fs::path folder_;
  std::atomic<int> opened_{0};
  std::unique_ptr<HostLoop> loop_;
  LoopState state_;
};

TEST_F(CalibrationDeskTest, WhatMustBeMeasuredIsStoredThoughTheMotorsAreNotEvened) {
  const fs::path file = folder_ / calibration_file_name(firmware::Drive::Motor, 12);
  auto desk = std::make_unique<CalibrationDesk>(*loop_, state_, folder_);
  EXPECT_NE(desk->instruction().find("1 of 3"), std::string::npos);
  const auto look = [&] {
    (void)loop_->look(state_);
    return desk->look("now", state_);
  };
  desk->take();
  ASSERT_TRUE(comes([&] { return look() || desk->note() == "Measured."; })) << desk->note();
  EXPECT_NE(desk->instruction().find("motors turn now"), std::string::npos);
  desk->take();
  ASSERT_TRUE(comes([&] { return look() || desk->is_stored(); })) << desk->note();
  EXPECT_TRUE(fs::exists(file));
  EXPECT_NE(desk->instruction().find("circles"), std::string::npos);
  EXPECT_NE(desk->note().find("may be left out"), std::string::npos);
  // An arm at rest shows no cogging: it is told, and what is stored stays.
  desk->take();
  ASSERT_TRUE(comes([&] {
    EXPECT_FALSE(look());
    return desk->note().find("moved too little") != std::string::npos;
  }));
  EXPECT_EQ(opened_, 1);
  desk.reset();
  EXPECT_TRUE(comes([this] { return opened_ == 2; }));  // it takes what was stored
  std::vector<std::string> problems;
  ASSERT_EQ(load_calibrations(folder_, problems).size(), 1U);
}

TEST_F(CalibrationDeskTest, GivenUpBeforeThatItLeavesNothing) {
  {
    CalibrationDesk desk(*loop_, state_, folder_);
    desk.take();
  }
  EXPECT_TRUE(fs::is_empty(folder_));
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_EQ(opened_, 1);
}

}  // namespace
}  // namespace carpus::devices
