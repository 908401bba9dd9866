// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The driver against a service that is played here, by its documented messages, on loopback.
#include "devices/haply_device.hpp"

#include <gtest/gtest.h>

#include <utility>  // before asio: its 1.74 needs std::exchange and does not include it
//
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <mutex>
#include <nlohmann/json.hpp>

#include "devices/haply_messages.hpp"
#include "devices/precise_clock.hpp"

namespace carpus::devices {
namespace {

using nlohmann::json;

json frame(double z_m) {
  return {{"inverse3",
           {{{"device_id", "049D"},
             {"status", {{"calibrated", true}, {"power_supply", true}, {"ready", true}}},
             {"state",
              {{"cursor_position", {{"x", 0.01}, {"y", -0.12}, {"z", z_m}}},
               {"cursor_velocity", {{"x", 0}, {"y", 0}, {"z", 0}}}}}}}},
          {"wireless_verse_grip",
           {{{"device_id", "VG01"},
             {"state",
              {{"orientation", {{"w", 1}, {"x", 0}, {"y", 0}, {"z", 0}}},
               {"buttons", {{"a", false}, {"b", true}, {"c", false}}}}}}}}};
}

/// One connection after the other; answers each message with the next state.
class FakeService {
 public:
  FakeService() : acceptor_(context_, {boost::asio::ip::make_address("127.0.0.1"), 0}) {
    thread_ = std::thread([this] { run(); });
  }
  ~FakeService() {
    stopping_ = true;
    hang_up();
    boost::system::error_code ignored;
    boost::asio::io_context context;
    boost::asio::ip::tcp::socket knock(context);
    knock.connect(acceptor_.local_endpoint(), ignored);  // wakes accept
    thread_.join();
  }
  [[nodiscard]] std::uint16_t port() const { return acceptor_.local_endpoint().port(); }
  void say(std::string text) {
    const std::lock_guard lock(mutex_);
    says_ = std::move(text);
  }
  [[nodiscard]] json told() const {
    const std::lock_guard lock(mutex_);
    return told_;
  }
  void hang_up() {
    const std::lock_guard lock(mutex_);
    if (socket_ != nullptr) ::shutdown(socket_->native_handle(), SHUT_RDWR);
  }
  std::atomic<bool> is_mute{false};

 private:
  void run() {
    while (!stopping_) {
      try {
        boost::asio::ip::tcp::socket socket(context_);
        acceptor_.accept(socket);
        if (stopping_) return;
        {
          const std::lock_guard lock(mutex_);
          socket_ = &socket;
        }
        try {
          talk(socket);
        } catch (const std::exception&) {
        }
        const std::lock_guard lock(mutex_);
        socket_ = nullptr;
      } catch (const std::exception&) {
      }
    }
  }
  void talk(boost::asio::ip::tcp::socket& socket) {
    boost::beast::websocket::stream<boost::asio::ip::tcp::socket&> page(socket);
    page.accept();
    while (!stopping_) {
      {
        const std::lock_guard lock(mutex_);
        page.write(boost::asio::buffer(says_));
      }
      boost::beast::flat_buffer buffer;
      page.read(buffer);
      while (is_mute && !stopping_) std::this_thread::sleep_for(std::chrono::milliseconds(5));
      const std::lock_guard lock(mutex_);
      told_ = json::parse(boost::beast::buffers_to_string(buffer.data()), nullptr, false);
    }
  }

  boost::asio::io_context context_;
  boost::asio::ip::tcp::acceptor acceptor_;
  mutable std::mutex mutex_;
  boost::asio::ip::tcp::socket* socket_ = nullptr;
  std::string says_ = frame(0.16).dump();
  json told_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

/// Polls as the loop does until something is so, at most three seconds.
template <typename Is>
bool soon(HaplyDevice& device, DeviceState& state, const DeviceCommand& wish, Is is) {
  for (int i = 0; i < 1500; ++i) {
    const Nanoseconds now = monotonic_now();
    device.poll(now, state);
    device.command(now, wish);
    if (is()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return false;
}

TEST(Haply, IsHeardAndPushedThroughItsService) {
  FakeService service;
  HaplyDevice device("127.0.0.1", service.port());
  device.open();
  DeviceState state;
  ASSERT_TRUE(soon(device, state, {}, [&] { return state.health == Health::Good; }));
  EXPECT_NEAR(state.position_mm.x, 10, 1e-9);
  EXPECT_NEAR(state.position_mm.z, 0, 1e-9);
  EXPECT_EQ(state.buttons, 2U);
  DeviceCommand wall;
  wall.plane_count = 1;
  wall.planes[0] = {{0, 0, 1}, 4, 0.5, 0, 0};  // 4 mm deep
  wall.limit_n = 3;
  ASSERT_TRUE(soon(device, state, wall, [&] { return state.force_n.z == 2; }));
  ASSERT_TRUE(soon(device, state, wall, [&] {
    const json told = service.told();
    return told.contains("inverse3") &&
           told["inverse3"][0]["commands"]["set_cursor_force"]["vector"]["z"] == 2.0;
  }));
  EXPECT_EQ(service.told()["inverse3"][0]["device_id"], "049D");
  // Nobody wishes anything any more: no force.
  ASSERT_TRUE(soon(device, state, {}, [&] { return state.force_n == Vec3{}; }));
  EXPECT_GT(state.round_trip_us, 0);
}

TEST(Haply, SilenceGarbageAndAServiceThatComesBack) {
  FakeService service;
  HaplyDevice device("127.0.0.1", service.port());
  device.open();
  DeviceState state;
  ASSERT_TRUE(soon(device, state, {}, [&] { return state.health == Health::Good; }));
  service.say(
      "{\"inverse3\":[{\"device_id\":\"1\",\"state\":{\"cursor_position\":"
      "{\"x\":1e999,\"y\":0,\"z\":0}}}]}");
  ASSERT_TRUE(soon(device, state, {}, [&] { return state.health == Health::Silent; }));
  EXPECT_GT(state.refused, 0U);
  EXPECT_TRUE(is_finite(state.position_mm));
  service.say(frame(0.17).dump());
  ASSERT_TRUE(soon(device, state, {}, [&] { return state.health == Health::Good; }));
  service.is_mute = true;
  ASSERT_TRUE(soon(device, state, {}, [&] { return state.health == Health::Silent; }));
  service.is_mute = false;
  service.hang_up();
  ASSERT_TRUE(soon(device, state, {}, [&] { return state.health == Health::Good; }));
}

TEST(HaplyMessages, WhatCannotBeIsRefusedAndNothingElse) {
  EXPECT_FALSE(read_haply_state("").has_value());
  EXPECT_FALSE(read_haply_state("[1]").has_value());
  EXPECT_FALSE(read_haply_state(std::string(100, '[')).has_value());
  EXPECT_FALSE(read_haply_state("{\"inverse3\":[{}]}").has_value());
  EXPECT_TRUE(read_haply_state("{}").has_value());
  EXPECT_TRUE(read_haply_state("{\"inverse3\":{}}").has_value());
  json wrong = frame(5.0);  // metres away
  EXPECT_FALSE(read_haply_state(wrong.dump()).has_value());
  wrong = frame(0.1);
  wrong["inverse3"][0]["state"]["cursor_velocity"]["x"] = "fast";
  EXPECT_FALSE(read_haply_state(wrong.dump()).has_value());
  wrong = frame(0.1);
  wrong["wireless_verse_grip"][0]["state"]["orientation"]["w"] = 0;
  const auto read = read_haply_state(wrong.dump());
  ASSERT_TRUE(read.has_value());
  EXPECT_FALSE(read->has_rotation);
  wrong["inverse3"][0]["status"]["calibrated"] = false;
  EXPECT_FALSE(read_haply_state(wrong.dump())->is_ready);
}

}  // namespace
}  // namespace carpus::devices
