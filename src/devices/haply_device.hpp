// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A Haply Inverse3 through the maker's service on this machine (haply_messages.hpp): a WebSocket
// that answers each message with the next state. Its reading takes memory and time, so it has a
// thread of its own, from which the newest state comes over, and to which the newest force goes.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <thread>

#include "core/latest_value.hpp"
#include "devices/device.hpp"

namespace carpus::devices {

class HaplyDevice final : public Device {
 public:
  HaplyDevice(std::string host, std::uint16_t port) : host_(std::move(host)), port_(port) {}
  ~HaplyDevice() override { close(); }

  [[nodiscard]] Capabilities capabilities() const override;
  void open() override;
  void close() noexcept override;
  void poll(Nanoseconds now, DeviceState& state) noexcept override;
  void command(Nanoseconds now, const DeviceCommand& command) noexcept override;

 private:
  /// What the service's thread and the loop's tell each other.
  struct Wish {
    DeviceCommand command;
    Nanoseconds at_ns = 0;
  };
  struct Said {
    DeviceState state;
    bool is_connected = false;
    bool has_device = false;
    bool is_ready = true;
  };
  class Talk;

  void run() noexcept;

  std::string host_;
  std::uint16_t port_;
  DeviceState state_;
  Said said_;
  Nanoseconds opened_ns_ = 0;
  LatestValue<Wish> wishes_;
  LatestValue<Said> says_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace carpus::devices
