// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A request and its answer without any network library, so that what is served can be tested alone.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>

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

}  // namespace carpus::server
