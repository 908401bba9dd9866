// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One connection to a page over WebSocket (RFC 6455). Private to the network server.
#pragma once

#include <utility>  // before asio: its 1.74 needs std::exchange and does not include it
//
#include <boost/asio/ip/tcp.hpp>
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

namespace carpus::server::detail {

/// Frames longer than this end the connection: nobody sends such a thing by mistake. Shorter ones
/// that exceed the protocol's limit are answered by an error and the exercise goes on.
inline constexpr std::size_t kMaxFrameBytes = 1U << 20U;
/// A page that lets more than this wait does not read; it is disconnected.
inline constexpr std::size_t kMaxWaitingBytes = 16U << 20U;

class WebSocketSession final : public PageConnection,
                               public std::enable_shared_from_this<WebSocketSession> {
 public:
  WebSocketSession(boost::beast::tcp_stream&& stream,
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
  void close_socket();
  void end();

  boost::beast::websocket::stream<boost::beast::tcp_stream> socket_;
  boost::asio::steady_timer ping_timer_;
  boost::beast::flat_buffer buffer_;
  std::deque<Frame> queue_;
  std::size_t waiting_bytes_ = 0;
  NetworkOptions options_;
  PageHandler& handler_;
  std::function<void(WebSocketSession*)> on_end_;
  std::chrono::steady_clock::time_point last_heard_;
  bool open_ = false;
  bool closing_ = false;
  bool ended_ = false;
  bool writing_ = false;
  bool pinging_ = false;
};

}  // namespace carpus::server::detail
