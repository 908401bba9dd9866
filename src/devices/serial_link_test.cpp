// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The serial port as the kernel gives it: a pseudo-terminal, with the firmware's core behind it.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include "core/error.hpp"
#include "devices/arm_device.hpp"
#include "devices/fake_arm_test_support.hpp"

namespace carpus::devices {
namespace {

/// The other end, as bytes.
class PseudoTerminal {
 public:
  PseudoTerminal() : master_(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK)) {
    EXPECT_EQ(::grantpt(master_), 0);
    EXPECT_EQ(::unlockpt(master_), 0);
    path = ::ptsname(master_);
  }
  ~PseudoTerminal() { hang_up(); }
  void hang_up() {
    if (master_ >= 0) ::close(master_);
    master_ = -1;
  }
  void carry(FakeLine& line) const {
    std::uint8_t bytes[256];
    const ssize_t count = ::read(master_, bytes, sizeof bytes);
    if (count > 0) line.to_device.insert(line.to_device.end(), bytes, bytes + count);
    const std::vector<std::uint8_t> back(line.to_host.begin(), line.to_host.end());
    line.to_host.clear();
    if (!back.empty()) {
      EXPECT_EQ(::write(master_, back.data(), back.size()), static_cast<ssize_t>(back.size()));
    }
  }
  std::string path;

 private:
  int master_;
};

TEST(SerialLink, CarriesEveryByteAndHasThePortAlone) {
  PseudoTerminal terminal;
  const auto link = open_serial(terminal.path, 500000);
  FakeLine line;
  std::vector<std::uint8_t> all(256);
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::uint8_t>(i);
  ASSERT_TRUE(link->write(all));
  terminal.carry(line);
  EXPECT_EQ(line.to_device, all);  // no newline becomes another, no Ctrl+C is one
  line.to_host.assign(all.begin(), all.end());
  terminal.carry(line);
  std::vector<std::uint8_t> read(300);
  EXPECT_EQ(link->read(read), all.size());
  read.resize(all.size());
  EXPECT_EQ(read, all);
  EXPECT_EQ(link->read(read), 0U);
  EXPECT_FALSE(link->is_gone());
  if (::geteuid() != 0) {
    EXPECT_THROW((void)open_serial(terminal.path, 500000), IoError);
  }
  terminal.hang_up();
  (void)link->read(read);
  EXPECT_TRUE(link->is_gone());
}

TEST(SerialLink, SaysWhatToDoWhereThereIsNone) {
  try {
    (void)open_serial("/dev/ttyCarpusNone", 500000);
    FAIL();
  } catch (const IoError& error) {
    EXPECT_NE(std::string(error.what()).find("plug the device in"), std::string::npos);
  }
  EXPECT_THROW((void)open_serial("/dev/null", 500000), IoError);
}

TEST(SerialLink, AnArmBehindItWorksAndIsPluggedInAgain) {
  const TemporaryFolder folder;
  store(fake_calibration(firmware::Drive::Stop, 9), folder.path());
  auto terminal = std::make_unique<PseudoTerminal>();
  const auto line = std::make_shared<FakeLine>();
  FakeStopArm fake(line, 9);
  ArmDevice device([&] { return open_serial(terminal->path, 500000); }, folder.path());
  DeviceState state;
  Nanoseconds now = 1'000'000'000;
  const auto run_ms = [&](int ms) {
    for (int i = 0; i < ms; ++i) {
      now += kNsPerMs;
      terminal->carry(*line);
      fake.step(now);
      terminal->carry(*line);
      device.poll(now, state);
      device.command(now, {});
    }
  };
  device.open();
  run_ms(100);
  EXPECT_EQ(state.health, Health::Good);
  terminal->hang_up();
  device.poll(now, state);
  EXPECT_EQ(state.health, Health::Gone);
  terminal = std::make_unique<PseudoTerminal>();
  fake.arm = firmware::StopArm(9);
  line->to_device.clear();
  device.open();
  run_ms(200);
  EXPECT_EQ(state.health, Health::Good);
}

}  // namespace
}  // namespace carpus::devices
