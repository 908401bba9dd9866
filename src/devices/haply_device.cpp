// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "devices/haply_device.hpp"

#include <utility>  // before asio: its 1.74 needs std::exchange and does not include it
//
#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <exception>

#include "devices/haply_messages.hpp"
#include "devices/precise_clock.hpp"
#include "devices/trusted_command.hpp"

namespace carpus::devices {

namespace asio = boost::asio;
namespace beast = boost::beast;

namespace {

/// A wish that the loop has not renewed is none.
constexpr Nanoseconds kWishLastsNs = 20 * kNsPerMs;
constexpr auto kAnswerWithin = std::chrono::milliseconds(500);
constexpr auto kTryAgainAfter = std::chrono::milliseconds(300);

}  // namespace

/// One connection, in the service's thread: state, force, state, force.
class HaplyDevice::Talk {
 public:
  explicit Talk(HaplyDevice& device) : device_(device), socket_(context_) {}

  /// Until the connection ends or stopping_.
  void run() {
    beast::tcp_stream& stream = beast::get_lowest_layer(socket_);
    stream.expires_after(kAnswerWithin);
    const asio::ip::tcp::endpoint end(asio::ip::make_address(device_.host_), device_.port_);
    stream.async_connect(end, [this](beast::error_code error) {
      if (!error) shake_hands();
    });
    while (!device_.stopping_.load(std::memory_order_relaxed)) {
      if (context_.run_for(std::chrono::milliseconds(20)) == 0 && context_.stopped()) return;
    }
    // The last word is no force.
    if (said_.is_connected && !is_writing_ && !id_.empty()) {
      beast::error_code ignored;
      stream.expires_after(kAnswerWithin);
      socket_.next_layer().socket().non_blocking(false, ignored);
      socket_.write(asio::buffer(haply_force_message(id_, {})), ignored);
    }
  }

 private:
  void shake_hands() {
    socket_.read_message_max(kMostHaplyBytes);
    socket_.async_handshake(device_.host_ + ":" + std::to_string(device_.port_), "/",
                            [this](beast::error_code error) {
                              if (error) return;
                              said_.is_connected = true;
                              device_.says_.publish(said_);
                              listen();
                            });
  }
  void listen() {
    beast::get_lowest_layer(socket_).expires_after(kAnswerWithin);
    socket_.async_read(buffer_, [this](beast::error_code error, std::size_t) {
      if (error) return;
      take();
      answer();
    });
  }
  void take() {
    const std::string text = beast::buffers_to_string(buffer_.data());
    buffer_.consume(buffer_.size());
    const Result<HaplyState> read = read_haply_state(text);
    if (!read) {
      ++said_.state.refused;
      device_.says_.publish(said_);
      return;
    }
    said_.has_device = !read->device_id.empty();
    said_.is_ready = read->is_ready;
    if (said_.has_device) id_ = read->device_id;
    if (read->has_cursor) {
      const Nanoseconds now = monotonic_now();
      DeviceState& state = said_.state;
      state.position_mm = read->position_mm - kMiddle;
      state.velocity_mm_s = read->velocity_mm_s;
      if (read->has_rotation) state.rotation = read->rotation;
      state.buttons = read->buttons;
      state.heard_ns = now;
      if (asked_ns_ != 0) state.round_trip_us = static_cast<double>(now - asked_ns_) / 1000.0;
      ++state.samples;
    }
    device_.says_.publish(said_);
  }
  void answer() {
    (void)device_.wishes_.take(wish_);
    const Nanoseconds now = monotonic_now();
    Vec3 force;
    const bool may_push = said_.is_ready && said_.has_device && now - wish_.at_ns < kWishLastsNs;
    if (may_push) {
      force = force_of(wish_.command, said_.state.position_mm, said_.state.velocity_mm_s);
    }
    said_.state.force_n = force;
    // Without a device the service is asked for its next state all the same.
    going_ = id_.empty() ? std::string("{}") : haply_force_message(id_, force);
    asked_ns_ = now;
    is_writing_ = true;
    socket_.async_write(asio::buffer(going_), [this](beast::error_code error, std::size_t) {
      is_writing_ = false;
      if (!error) listen();
    });
  }

  /// Its cursor counts from the body; the middle of what it reaches is before it.
  static constexpr Vec3 kMiddle{0, -120, 160};

  HaplyDevice& device_;
  asio::io_context context_;
  beast::websocket::stream<beast::tcp_stream> socket_;
  beast::flat_buffer buffer_;
  std::string going_;
  std::string id_;
  Said said_;
  Wish wish_;
  Nanoseconds asked_ns_ = 0;
  bool is_writing_ = false;
};

Capabilities HaplyDevice::capabilities() const {
  Capabilities able;
  able.position = able.rotation = able.absolute = able.force = true;
  able.rate_hz = 1000;
  able.peak_force_n = 8;
  able.lasting_force_n = 3.5;
  able.most_stiffness_n_per_mm = 0.8;  // two programs and JSON lie between
  able.workspace = {{-90, -60, -80}, {90, 60, 80}};
  return able;
}

void HaplyDevice::open() {
  close();
  state_ = {};
  said_ = {};
  opened_ns_ = 0;
  stopping_.store(false, std::memory_order_relaxed);
  thread_ = std::thread([this] { run(); });
}

void HaplyDevice::close() noexcept {
  stopping_.store(true, std::memory_order_relaxed);
  if (thread_.joinable()) thread_.join();
}

void HaplyDevice::run() noexcept {
  while (!stopping_.load(std::memory_order_relaxed)) {
    try {
      Talk(*this).run();
    } catch (const std::exception&) {
      // Tried again below, as when the service ends.
    }
    says_.publish(Said{});
    const auto until = std::chrono::steady_clock::now() + kTryAgainAfter;
    while (!stopping_.load(std::memory_order_relaxed) && std::chrono::steady_clock::now() < until) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }
}

void HaplyDevice::poll(Nanoseconds now, DeviceState& state) noexcept {
  if (opened_ns_ == 0) opened_ns_ = now;
  (void)says_.take(said_);
  const std::uint64_t unsent = state_.unsent;
  if (said_.is_connected) state_ = said_.state;
  state_.unsent = unsent;
  // The thread connects again by itself: gone is only said, and the loop need not open anew.
  if (!said_.is_connected || !said_.has_device) {
    state_.health = now - opened_ns_ < kNsPerMs * 1000 ? Health::Starting : Health::Silent;
  } else if (!said_.is_ready) {
    state_.health = Health::Uncalibrated;
  } else if (state_.samples == 0) {
    state_.health = Health::Starting;
  } else {
    state_.health = now - state_.heard_ns > kSilentNs ? Health::Silent : Health::Good;
  }
  if (state_.health != Health::Good) state_.force_n = {};
  state = state_;
}

void HaplyDevice::command(Nanoseconds now, const DeviceCommand& command) noexcept {
  wishes_.publish({command, now});
}

}  // namespace carpus::devices
