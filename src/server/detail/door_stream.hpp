// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A connection as it comes in at the door, in clear or under TLS; whoever speaks over it need not
// know which. What it may bring in a second is limited. Private to the network server.
#pragma once

#include <utility>  // before asio: its 1.74 needs std::exchange and does not include it
//
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/beast/core/basic_stream.hpp>
#include <boost/beast/core/rate_policy.hpp>
#include <boost/beast/ssl/ssl_stream.hpp>
#include <boost/beast/websocket/ssl.hpp>
#include <boost/beast/websocket/teardown.hpp>
#include <variant>

namespace carpus::server::detail {

/// Bytes a second that one connection may bring; more waits in the sender's machine. A page that
/// operates brings a fifth of this.
inline constexpr std::size_t kMaxBytesInPerSecond = 1U << 20U;

class DoorStream {
 public:
  using Tcp = boost::beast::basic_stream<boost::asio::ip::tcp,
                                         boost::asio::ip::tcp::socket::executor_type,
                                         boost::beast::simple_rate_policy>;
  using Tls = boost::beast::ssl_stream<Tcp>;
  using executor_type = Tcp::executor_type;

  explicit DoorStream(boost::asio::ip::tcp::socket&& socket)
      : stream_(std::in_place_type<Tcp>, std::move(socket)) {
    tcp().rate_policy().read_limit(kMaxBytesInPerSecond);
  }
  DoorStream(boost::asio::ip::tcp::socket&& socket, boost::asio::ssl::context& context)
      : stream_(std::in_place_type<Tls>, Tcp(std::move(socket)), context) {
    tcp().rate_policy().read_limit(kMaxBytesInPerSecond);
  }

  [[nodiscard]] executor_type get_executor() { return tcp().get_executor(); }
  /// What lies below: deadlines and the socket.
  [[nodiscard]] Tcp& tcp() {
    if (Tls* const secure = tls()) return secure->next_layer();
    return *std::get_if<Tcp>(&stream_);
  }
  /// Nothing where it is in clear.
  [[nodiscard]] Tls* tls() { return std::get_if<Tls>(&stream_); }

  template <typename Buffers, typename Handler>
  void async_read_some(const Buffers& buffers, Handler&& handler) {
    std::visit(
        [&](auto& stream) { stream.async_read_some(buffers, std::forward<Handler>(handler)); },
        stream_);
  }
  template <typename Buffers, typename Handler>
  void async_write_some(const Buffers& buffers, Handler&& handler) {
    std::visit(
        [&](auto& stream) { stream.async_write_some(buffers, std::forward<Handler>(handler)); },
        stream_);
  }

  /// What Beast asks for at the end of a WebSocket, and when it does not end in time.
  template <typename Handler>
  friend void async_teardown(boost::beast::role_type role, DoorStream& door, Handler&& handler) {
    using boost::beast::async_teardown;
    using boost::beast::websocket::async_teardown;
    if (Tls* const secure = door.tls()) {
      async_teardown(role, *secure, std::forward<Handler>(handler));
    } else {
      async_teardown(role, door.tcp(), std::forward<Handler>(handler));
    }
  }
  friend void beast_close_socket(DoorStream& door) { door.tcp().close(); }

 private:
  std::variant<Tcp, Tls> stream_;
};

}  // namespace carpus::server::detail
