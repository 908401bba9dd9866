// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One connection to a page over WebSocket (RFC 6455). Private to the network server.
#pragma once

#include "server/detail/door_stream.hpp"
//
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <deque>
#include <functional>
#include <memory>
#include <string>

#include "server/network_server.hpp"
#include "server/rate_limit.hpp"

namespace carpus::server::detail {

/// Frames longer than this end the connection: nobody sends such a thing by mistake. Shorter ones
/// that exceed the protocol's limit are answered by an error and the exercise goes on.
inline constexpr std::size_t kMaxFrameBytes = 128U << 10U;
/// A page that lets more than this wait does not read; it is disconnected.
inline constexpr std::size_t kMaxWaitingBytes = 16U << 20U;
/// The same of small frames.
inline constexpr std::size_t kMaxWaitingFrames = 2048;
/// Control frames a second (pings, pongs); a page that sends more is disconnected.
inline constexpr double kControlFramesPerSecond = 50;

class WebSocketSession final : public PageConnection,
                               public std::enable_shared_from_this<WebSocketSession> {
 public:
  using Clock = std::chrono::steady_clock;
  struct Peer {
    std::string address;
    Guest guest;
  };

  WebSocketSession(DoorStream&& stream,
                   Peer peer,
                   const NetworkOptions& options,
                   PageHandler& handler,
                   std::function<void(WebSocketSession*)> on_end);

  /// Answers the upgrade request and begins to read.
  void accept(const boost::beast::http::request<boost::beast::http::string_body>& request);
  /// Ends the connection at once.
  void abort();

  void send_text(std::string text) override { enqueue({std::move(text), false}); }
  void send_binary(std::string bytes) override { enqueue({std::move(bytes), true}); }
  [[nodiscard]] std::size_t waiting_frames() const override { return queue_.size(); }
  void close() override;
  void keep() override { is_kept_ = true; }
  [[nodiscard]] const Guest& guest() const override { return peer_.guest; }

  [[nodiscard]] const std::string& address() const noexcept { return peer_.address; }
  /// It has not said who it is.
  [[nodiscard]] bool is_silent() const noexcept { return !is_kept_; }
  [[nodiscard]] Clock::time_point silent_since() const noexcept { return opened_at_; }

 private:
  struct Frame {
    std::string content;
    bool is_binary = false;
  };

  void on_accept();
  void read_next();
  void on_read();
  void enqueue(Frame frame);
  void write_next();
  void ping_later();
  void check_alive();
  void heard();
  void on_control();
  void abort_later();
  void close_socket();
  void end();

  boost::beast::websocket::stream<DoorStream> socket_;
  Peer peer_;
  boost::asio::steady_timer ping_timer_;
  boost::beast::flat_buffer buffer_;
  std::deque<Frame> queue_;
  std::size_t waiting_bytes_ = 0;
  const NetworkOptions& options_;
  PageHandler& handler_;
  std::function<void(WebSocketSession*)> on_end_;
  Clock::time_point opened_at_ = Clock::now();
  Clock::time_point last_heard_;
  RateLimit control_frames_{kControlFramesPerSecond, 4 * kControlFramesPerSecond};
  bool is_kept_ = false;
  bool open_ = false;
  bool closing_ = false;
  bool ended_ = false;
  bool writing_ = false;
  bool pinging_ = false;
};

}  // namespace carpus::server::detail
