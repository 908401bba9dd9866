// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The driver against a daemon that is played here: its socket, its events, its end.
#include "devices/spacemouse_device.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstring>

#include "core/error.hpp"
#include "core/rng.hpp"
#include "devices/fake_link_test_support.hpp"

namespace carpus::devices {
namespace {

using Words = std::array<std::int32_t, 8>;

class FakeDaemon {
 public:
  explicit FakeDaemon(const std::string& path) {
    listening_ = ::socket(AF_UNIX, SOCK_STREAM, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path, path.data(), path.size());
    EXPECT_EQ(::bind(listening_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(::listen(listening_, 1), 0);
  }
  ~FakeDaemon() {
    hang_up();
    ::close(listening_);
  }
  void accept() { client_ = ::accept(listening_, nullptr, nullptr); }
  void hang_up() {
    if (client_ >= 0) ::close(client_);
    client_ = -1;
  }
  void say(const void* bytes, std::size_t count) const {
    EXPECT_EQ(::write(client_, bytes, count), static_cast<ssize_t>(count));
  }
  void say(const Words& words) const { say(words.data(), sizeof words); }

 private:
  int listening_ = -1;
  int client_ = -1;
};

TEST(SpaceMouse, IsHeardThroughItsDaemon) {
  const TemporaryFolder folder;
  const std::string path = (folder.path() / "spnav.sock").string();
  SpaceMouseDevice device([&path] { return open_unix_socket(path); });
  EXPECT_THROW(device.open(), IoError);
  FakeDaemon daemon(path);
  device.open();
  daemon.accept();
  DeviceState state;
  Nanoseconds now = 1'000'000'000;
  device.poll(now, state);
  EXPECT_EQ(state.health, Health::Good);
  EXPECT_EQ(state.velocity_mm_s, Vec3{});
  daemon.say({0, 350, 0, 0, 0, 0, 0, 16});
  device.poll(now += kNsPerMs, state);
  EXPECT_DOUBLE_EQ(state.velocity_mm_s.x, 40);
  daemon.say({0, 0, 175, -350, 0, 0, 350, 16});
  daemon.say({1, 3, 0, 0, 0, 0, 0, 0});
  device.poll(now += kNsPerMs, state);
  EXPECT_DOUBLE_EQ(state.velocity_mm_s.z, 10);  // pulled up by half
  EXPECT_DOUBLE_EQ(state.velocity_mm_s.y, 40);  // pushed away
  EXPECT_LT(state.spin_rad_s.y, 0);
  EXPECT_EQ(state.buttons, 8U);
  daemon.say({2, 3, 0, 0, 0, 0, 0, 0});
  device.poll(now += kNsPerMs, state);
  EXPECT_EQ(state.buttons, 0U);
  // Let go of without a word: at rest.
  device.poll(now += 300 * kNsPerMs, state);
  EXPECT_EQ(state.velocity_mm_s, Vec3{});
  EXPECT_EQ(state.health, Health::Good);
  daemon.hang_up();
  device.poll(now += kNsPerMs, state);
  EXPECT_EQ(state.health, Health::Gone);
}

TEST(SpaceMouse, EventsInPiecesAreEvents) {
  const auto line = std::make_shared<FakeLine>();
  SpaceMouseDevice device(fake_opener(line));
  device.open();
  const Words words{0, 350, 0, 0, 0, 0, 0, 16};
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(words.data());
  DeviceState state;
  for (std::size_t i = 0; i < sizeof words; ++i) {
    EXPECT_EQ(state.samples, 0U);
    line->to_host.push_back(bytes[i]);
    device.poll(1'000'000'000, state);
  }
  EXPECT_EQ(state.samples, 1U);
}

TEST(SpaceMouse, GarbageIsCountedAndMovesNothing) {
  const auto line = std::make_shared<FakeLine>();
  SpaceMouseDevice device(fake_opener(line));
  device.open();
  Rng rng(3);
  DeviceState state;
  for (int i = 0; i < 5000; ++i) {
    for (int k = 0; k < 32; ++k) {
      line->to_host.push_back(static_cast<std::uint8_t>(rng.next() >> 40));
    }
    device.poll(1'000'000'000, state);
    ASSERT_LE(length(state.velocity_mm_s), 70);
    ASSERT_LE(length(state.spin_rad_s), 2.1);
  }
  EXPECT_GT(state.refused, 4900U);
}

}  // namespace
}  // namespace carpus::devices
