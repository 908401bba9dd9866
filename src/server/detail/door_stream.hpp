// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A connection as it comes in at the door, in clear or under TLS; whoever speaks over it need not
// know which. What it may bring in a second is limited. Private to the network server.
#pragma once

#include <utility>  // before asio: its 1.74 needs std::exchange and does not include it
//
#include <boost/asio/buffer.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/beast/core/basic_stream.hpp>
#include <boost/beast/core/rate_policy.hpp>
#include <boost/beast/core/role.hpp>
#include <boost/beast/ssl/ssl_stream.hpp>
#include <boost/container/static_vector.hpp>
#include <variant>

#include "server/detail/any_handler.hpp"

namespace carpus::server::detail {

/// Bytes a second that one connection may bring; more waits in the sender's machine. A page that
/// operates brings a fifth of this.
inline constexpr std::size_t kMaxBytesInPerSecond = 1U << 20U;
/// While a body is taken, which an instructor sends: a scan of half a gigabyte in ten seconds.
inline constexpr std::size_t kMaxBodyBytesInPerSecond = 48U << 20U;

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
    read_some(pieces_of<boost::asio::mutable_buffer>(buffers),
              Done(std::forward<Handler>(handler), get_executor()));
  }
  template <typename Buffers, typename Handler>
  void async_write_some(const Buffers& buffers, Handler&& handler) {
    write_some(pieces_of<boost::asio::const_buffer>(buffers),
               Done(std::forward<Handler>(handler), get_executor()));
  }

  /// What Beast asks for at the end of a WebSocket, and when it does not end in time.
  template <typename Handler>
  friend void async_teardown(boost::beast::role_type role, DoorStream& door, Handler&& handler) {
    door.tear_down(role, TornDown(std::forward<Handler>(handler), door.get_executor()));
  }
  friend void beast_close_socket(DoorStream& door) { door.tcp().close(); }

 private:
  using Done = AnyHandler<boost::system::error_code, std::size_t>;
  using TornDown = AnyHandler<boost::system::error_code>;
  /// More than these wait for the next call: "some" may be as little.
  static constexpr std::size_t kMostPieces = 16;
  template <typename Buffer>
  using Pieces = boost::container::static_vector<Buffer, kMostPieces>;

  template <typename Buffer, typename Buffers>
  [[nodiscard]] static Pieces<Buffer> pieces_of(const Buffers& buffers) {
    Pieces<Buffer> pieces;
    const auto end = boost::asio::buffer_sequence_end(buffers);
    for (auto at = boost::asio::buffer_sequence_begin(buffers);
         at != end && pieces.size() < kMostPieces; ++at) {
      const Buffer piece(*at);
      if (piece.size() > 0) pieces.push_back(piece);
    }
    return pieces;
  }

  void read_some(const Pieces<boost::asio::mutable_buffer>& pieces, Done done);
  void write_some(const Pieces<boost::asio::const_buffer>& pieces, Done done);
  void tear_down(boost::beast::role_type role, TornDown done);

  std::variant<Tcp, Tls> stream_;
};

}  // namespace carpus::server::detail
