// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A client on this machine for the server's tests: plain HTTP, raw bytes, and a page's WebSocket.
#pragma once

#include <utility>  // before asio: its 1.74 needs std::exchange and does not include it
//
#include <sys/socket.h>

#include <array>
#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <cerrno>
#include <chrono>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "core/is_sanitized.hpp"

namespace carpus::server::testing {

namespace asio = boost::asio;
namespace beast = boost::beast;
using asio::ip::tcp;
using Headers = std::map<std::string, std::string>;
using HttpAnswer = beast::http::response<beast::http::string_body>;

/// How long something is waited for that must come: long enough for any machine on which it does.
inline constexpr std::chrono::seconds kPatience{kIsSanitized ? 120 : 10};

inline tcp::endpoint loopback(std::uint16_t port) {
  return {asio::ip::make_address("127.0.0.1"), port};
}

inline std::string host_of(std::uint16_t port) { return "127.0.0.1:" + std::to_string(port); }

/// One request on a connection of its own.
inline HttpAnswer request(std::uint16_t port,
                          const std::string& target,
                          const Headers& headers = {},
                          beast::http::verb method = beast::http::verb::get) {
  asio::io_context context;
  tcp::socket socket(context);
  socket.connect(loopback(port));
  beast::http::request<beast::http::empty_body> message(method, target, 11);
  message.set(beast::http::field::host, host_of(port));
  message.keep_alive(false);
  for (const auto& [name, value] : headers) message.set(name, value);
  beast::http::write(socket, message);
  beast::flat_buffer buffer;
  beast::http::response_parser<beast::http::string_body> parser;
  parser.body_limit(std::uint64_t{1} << 30U);
  parser.skip(method == beast::http::verb::head);
  beast::http::read(socket, buffer, parser);
  return parser.release();
}

/// What a request to step up to WebSocket is answered; empty `origin` sends none.
inline unsigned upgrade_status(std::uint16_t port,
                               const std::string& origin,
                               const std::string& target = "/ws") {
  Headers headers{{"Connection", "Upgrade"},
                  {"Upgrade", "websocket"},
                  {"Sec-WebSocket-Version", "13"},
                  {"Sec-WebSocket-Key", "dGhlIHNhbXBsZSBub25jZQ=="}};
  if (!origin.empty()) headers["Origin"] = origin;
  return request(port, target, headers).result_int();
}

/// A connection that says what a test tells it to, byte by byte, and waits for nothing for long.
class RawClient {
 public:
  explicit RawClient(std::uint16_t port) : socket_(context_) {
    socket_.connect(loopback(port));
    const timeval limit{kPatience.count(), 0};
    ::setsockopt(socket_.native_handle(), SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
    ::setsockopt(socket_.native_handle(), SOL_SOCKET, SO_SNDTIMEO, &limit, sizeof limit);
  }

  /// False when the other side has closed.
  bool send(const std::string& bytes) {
    return ::send(socket_.native_handle(), bytes.data(), bytes.size(), MSG_NOSIGNAL) ==
           static_cast<ssize_t>(bytes.size());
  }
  /// What has come when the other side closes, or says nothing for kPatience.
  std::string read_to_end() {
    std::string answer;
    while (append_to(answer)) {
    }
    return answer;
  }
  /// What has come when `end` has.
  std::string read_until(const std::string& end) {
    std::string answer;
    while (answer.find(end) == std::string::npos && append_to(answer)) {
    }
    return answer;
  }
  /// Whether the other side has closed, whatever it said before.
  bool wait_until_closed() {
    std::array<char, 4096> piece{};
    while (true) {
      const ssize_t size = ::recv(socket_.native_handle(), piece.data(), piece.size(), 0);
      if (size > 0) continue;
      return size == 0 || (errno != EAGAIN && errno != EWOULDBLOCK);
    }
  }

 private:
  bool append_to(std::string& answer) {
    std::array<char, 4096> piece{};
    const ssize_t size = ::recv(socket_.native_handle(), piece.data(), piece.size(), 0);
    if (size > 0) answer.append(piece.data(), static_cast<std::size_t>(size));
    return size > 0;
  }

  asio::io_context context_;
  tcp::socket socket_;
};

/// Sends bytes as they are and returns all that comes back until the server closes.
inline std::string exchange_raw(std::uint16_t port, const std::string& bytes) {
  RawClient client(port);
  client.send(bytes);
  return client.read_to_end();
}

/// A page: connects to /ws, sends frames, collects what arrives.
class PageClient {
 public:
  struct Frame {
    std::string content;
    bool is_binary = false;
  };

  /// @param origin  of the page; empty sends none.
  PageClient(std::uint16_t port, const std::string& origin, const std::string& cookie)
      : socket_(context_) {
    socket_.next_layer().connect(loopback(port));
    socket_.set_option(
        beast::websocket::stream_base::decorator([&](beast::websocket::request_type& message) {
          if (!origin.empty()) message.set(beast::http::field::origin, origin);
          if (!cookie.empty()) message.set(beast::http::field::cookie, cookie);
        }));
    socket_.handshake(host_of(port), "/ws", error_);
    if (!error_) read_next();
  }
  explicit PageClient(std::uint16_t port, const std::string& cookie = "")
      : PageClient(port, "http://" + host_of(port), cookie) {}

  [[nodiscard]] bool is_connected() const { return !error_ && !closed_; }

  void send(const std::string& text, bool is_binary = false) {
    socket_.binary(is_binary);
    boost::system::error_code error;
    socket_.write(asio::buffer(text), error);
  }

  /// The next frame that fits, discarding others; nothing after the time given.
  std::optional<Frame> wait_for(const std::function<bool(const Frame&)>& fits,
                                std::chrono::milliseconds time = kPatience) {
    const auto deadline = std::chrono::steady_clock::now() + time;
    while (true) {
      while (!frames_.empty()) {
        Frame frame = std::move(frames_.front());
        frames_.pop_front();
        if (fits(frame)) return frame;
      }
      if (closed_ || std::chrono::steady_clock::now() >= deadline) return std::nullopt;
      context_.restart();
      context_.run_one_until(deadline);
    }
  }

  /// The next text message of a type.
  std::string wait_for_type(const std::string& type, std::chrono::milliseconds time = kPatience) {
    const auto frame = wait_for(
        [&](const Frame& f) {
          return !f.is_binary && f.content.find("\"type\":\"" + type + "\"") != std::string::npos;
        },
        time);
    return frame ? frame->content : "no " + type;
  }

  bool wait_until_closed(std::chrono::milliseconds time = kPatience) {
    (void)wait_for([](const Frame&) { return false; }, time);
    return closed_;
  }

  /// Vanishes as a browser that crashes: no closing handshake.
  void vanish() {
    boost::system::error_code ignored;
    socket_.next_layer().close(ignored);
    context_.restart();
    context_.run_for(std::chrono::milliseconds(10));
  }

 private:
  void read_next() {
    socket_.async_read(buffer_, [this](boost::system::error_code error, std::size_t) {
      if (error) {
        closed_ = true;
        return;
      }
      frames_.push_back({beast::buffers_to_string(buffer_.data()), socket_.got_binary()});
      buffer_.consume(buffer_.size());
      read_next();
    });
  }

  asio::io_context context_;
  beast::websocket::stream<tcp::socket> socket_;
  beast::flat_buffer buffer_;
  std::deque<Frame> frames_;
  boost::system::error_code error_;
  bool closed_ = false;
};

}  // namespace carpus::server::testing
