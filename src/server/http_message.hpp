// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A request and its answer without any network library, so that what is served can be tested alone.
// A body comes piece by piece.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "server/guest.hpp"

namespace carpus::server {

struct HttpRequest {
  std::string method;  ///< "GET"
  std::string target;  ///< path and query as sent, percent-encoded
  Guest guest;         ///< who asks
};

struct HttpResponse {
  unsigned status = 200;
  std::string content_type = "text/plain; charset=utf-8";
  std::string cache_control = "no-store";
  std::string download_name;   ///< not empty: the browser saves it under this name
  std::string set_cookie;      ///< not empty: the browser keeps this cookie
  unsigned retry_after_s = 0;  ///< not 0: worth asking again after so long
  std::shared_ptr<const std::string> body = std::make_shared<const std::string>();
};

using HttpHandler = std::function<HttpResponse(const HttpRequest&)>;

[[nodiscard]] inline HttpResponse make_response(unsigned status,
                                                std::string content_type,
                                                std::string body) {
  HttpResponse response;
  response.status = status;
  response.content_type = std::move(content_type);
  response.body = std::make_shared<const std::string>(std::move(body));
  return response;
}

[[nodiscard]] inline HttpResponse make_json(std::string body) {
  return make_response(200, "application/json", std::move(body));
}

[[nodiscard]] inline HttpResponse make_problem(unsigned status, std::string text) {
  return make_response(status, "text/plain; charset=utf-8", std::move(text) + "\n");
}

/// Takes the body of one request. Called in one lane's thread; destroyed in any, before finish()
/// where the connection ended or said too little.
class BodyTaker {
 public:
  /// What take() answers while it wants more.
  static constexpr unsigned kGoOn = 100;

  BodyTaker() = default;
  virtual ~BodyTaker() = default;
  BodyTaker(const BodyTaker&) = delete;
  BodyTaker& operator=(const BodyTaker&) = delete;

  /// @return kGoOn, or what the request is answered, and no more is read.
  [[nodiscard]] virtual HttpResponse take(std::string_view piece) = 0;
  /// All has come. @return what the request is answered
  [[nodiscard]] virtual HttpResponse finish() = 0;
};

/// Whether a body is taken. Called in the network's thread before any of it is read.
using BodyHandler =
    std::function<std::variant<std::unique_ptr<BodyTaker>, HttpResponse>(const HttpRequest&,
                                                                         std::uint64_t bytes)>;

}  // namespace carpus::server
