// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One HTTP connection: requests one after another, or the step up to WebSocket. Private to the
// network server.
#pragma once

#include <utility>  // before asio: its 1.74 needs std::exchange and does not include it
//
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <functional>
#include <memory>
#include <optional>

#include "server/network_server.hpp"
#include "server/origin_guard.hpp"

namespace carpus::server::detail {

/// What a session needs of its server.
struct HttpSessionContext {
  const NetworkOptions& options;
  const OriginGuard& guard;
  const HttpHandler& handler;
  /// Takes over a connection that asked for /ws and may have it.
  std::function<void(boost::beast::tcp_stream&&,
                     const boost::beast::http::request<boost::beast::http::string_body>&)>
      upgrade;
};

class HttpSession : public std::enable_shared_from_this<HttpSession> {
 public:
  HttpSession(boost::asio::ip::tcp::socket&& socket,
              const HttpSessionContext& context,
              std::function<void(HttpSession*)> on_end);
  ~HttpSession() = default;
  HttpSession(const HttpSession&) = delete;
  HttpSession& operator=(const HttpSession&) = delete;

  void read_next();
  void abort();

 private:
  using Body = boost::beast::http::span_body<const char>;

  void on_request();
  void upgrade();
  void answer(const HttpResponse& response);
  void refuse_unreadable(const boost::system::error_code& error);
  void write(bool keep_alive);
  void end();

  boost::beast::tcp_stream stream_;
  const HttpSessionContext& context_;
  std::function<void(HttpSession*)> on_end_;
  boost::beast::flat_buffer buffer_;
  std::optional<boost::beast::http::request_parser<boost::beast::http::string_body>> parser_;
  std::optional<boost::beast::http::response<Body>> response_;
  std::optional<boost::beast::http::response_serializer<Body>> serializer_;
  std::shared_ptr<const std::string> body_;  ///< lives until it is written
  bool ended_ = false;
};

}  // namespace carpus::server::detail
