// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/detail/http_session.hpp"

#include <boost/beast/websocket/rfc6455.hpp>

#include "core/version.hpp"

namespace carpus::server::detail {

namespace beast = boost::beast;
namespace http = beast::http;
using boost::system::error_code;

namespace {

constexpr std::uint32_t kMaxHeaderBytes = 16384;

/// Scripts, styles and connections of our own only; pictures and workers also from memory.
constexpr const char* kContentSecurityPolicy =
    "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' data: blob:; worker-src 'self' blob:; connect-src 'self' data: blob:; "
    "object-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

std::string text(beast::string_view view) { return {view.data(), view.size()}; }

}  // namespace

HttpSession::HttpSession(boost::asio::ip::tcp::socket&& socket,
                         const HttpSessionContext& context,
                         std::function<void(HttpSession*)> on_end)
    : stream_(std::move(socket)), context_(context), on_end_(std::move(on_end)) {}

void HttpSession::read_next() {
  parser_.emplace();
  parser_->header_limit(kMaxHeaderBytes);
  parser_->body_limit(0);
  stream_.expires_after(context_.options.request_timeout);
  http::async_read(stream_, buffer_, *parser_,
                   [self = shared_from_this()](error_code error, std::size_t) {
                     if (self->ended_) return;
                     if (error) return self->refuse_unreadable(error);
                     self->on_request();
                   });
}

void HttpSession::refuse_unreadable(const error_code& error) {
  const bool is_ours = error.category() == make_error_code(http::error::bad_method).category();
  if (!is_ours || error == http::error::end_of_stream) return end();
  const bool too_large = error == http::error::header_limit || error == http::error::body_limit;
  answer(make_problem(too_large ? 413 : 400, "The request is malformed or too large."));
}

void HttpSession::on_request() {
  const auto& request = parser_->get();
  const std::string host = text(request[http::field::host]);
  if (!context_.guard.accepts_host(host)) {
    return answer(make_problem(421, "This station is not called '" + host.substr(0, 200) +
                                        "'; open the address that it printed."));
  }
  if (beast::websocket::is_upgrade(request)) return upgrade();
  if (request.method() != http::verb::get && request.method() != http::verb::head) {
    return answer(make_problem(405, "Only GET and HEAD are answered here."));
  }
  HttpResponse response;
  try {
    response = context_.handler({text(request.method_string()), text(request.target())});
  } catch (const std::exception& error) {
    response = make_problem(500, error.what());
  }
  answer(response);
}

void HttpSession::upgrade() {
  const auto& request = parser_->get();
  if (request.target() != "/ws") return answer(make_problem(404, "The WebSocket is at /ws."));
  if (!context_.guard.accepts_origin(text(request[http::field::origin]),
                                     text(request[http::field::host]))) {
    return answer(make_problem(403, "Only this station's own page may operate."));
  }
  const auto self = shared_from_this();
  ended_ = true;
  context_.upgrade(std::move(stream_), request);
  on_end_(this);
}

void HttpSession::answer(const HttpResponse& from) {
  const bool was_read = parser_->is_done();
  const bool head_only = was_read && parser_->get().method() == http::verb::head;
  body_ = from.body;
  response_.emplace(static_cast<http::status>(from.status), 11);
  auto& response = *response_;
  response.set(http::field::server, kProgramVersion);
  response.set(http::field::content_type, from.content_type);
  response.set(http::field::cache_control, from.cache_control);
  response.set("Content-Security-Policy", kContentSecurityPolicy);
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Referrer-Policy", "no-referrer");
  response.set("Cross-Origin-Opener-Policy", "same-origin");
  response.set("Cross-Origin-Resource-Policy", "same-origin");
  if (!from.download_name.empty()) {
    response.set(http::field::content_disposition,
                 "attachment; filename=\"" + from.download_name + "\"");
  }
  if (from.status == 405) response.set(http::field::allow, "GET, HEAD");
  if (!head_only) response.body() = Body::value_type(body_->data(), body_->size());
  response.content_length(body_->size());
  const bool keep_alive = was_read && from.status != 421 && parser_->get().keep_alive();
  response.keep_alive(keep_alive);
  write(keep_alive);
}

void HttpSession::write(bool keep_alive) {
  stream_.expires_after(context_.options.answer_timeout);
  serializer_.emplace(*response_);
  const bool head_only = parser_->is_done() && parser_->get().method() == http::verb::head;
  auto done = [self = shared_from_this(), keep_alive](error_code error, std::size_t) {
    if (self->ended_) return;
    if (error || !keep_alive) return self->end();
    self->read_next();
  };
  if (head_only) {
    http::async_write_header(stream_, *serializer_, std::move(done));
  } else {
    http::async_write(stream_, *serializer_, std::move(done));
  }
}

void HttpSession::abort() { end(); }

void HttpSession::end() {
  if (ended_) return;
  ended_ = true;
  const auto self = shared_from_this();
  error_code ignored;
  stream_.socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, ignored);
  stream_.close();
  on_end_(this);
}

}  // namespace carpus::server::detail
