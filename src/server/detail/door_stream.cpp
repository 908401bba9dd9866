// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/detail/door_stream.hpp"
//
#include <boost/beast/websocket/ssl.hpp>
#include <boost/beast/websocket/teardown.hpp>

namespace carpus::server::detail {

void DoorStream::read_some(const Pieces<boost::asio::mutable_buffer>& pieces, Done done) {
  std::visit([&](auto& stream) { stream.async_read_some(pieces, std::move(done)); }, stream_);
}

void DoorStream::write_some(const Pieces<boost::asio::const_buffer>& pieces, Done done) {
  std::visit([&](auto& stream) { stream.async_write_some(pieces, std::move(done)); }, stream_);
}

void DoorStream::tear_down(boost::beast::role_type role, TornDown done) {
  using boost::beast::async_teardown;
  using boost::beast::websocket::async_teardown;
  if (Tls* const secure = tls()) {
    async_teardown(role, *secure, std::move(done));
  } else {
    async_teardown(role, tcp(), std::move(done));
  }
}

}  // namespace carpus::server::detail
