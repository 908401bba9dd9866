// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/detail/http_session.hpp"

#include <algorithm>
#include <boost/asio/ip/address.hpp>
#include <boost/beast/websocket/rfc6455.hpp>

#include "core/version.hpp"

namespace carpus::server::detail {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using boost::system::error_code;

namespace {

/// Scripts, styles and connections of our own only; pictures and workers also from memory.
constexpr const char* kContentSecurityPolicy =
    "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' data: blob:; worker-src 'self' blob:; connect-src 'self' data: blob:; "
    "object-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// Of a body, read and taken at once.
constexpr std::size_t kBodyPiece = 128U << 10U;

/// What is still read, and thrown away, of a connection that is being closed: closing with bytes
/// unread would take back the answer that the other side has not read yet.
constexpr std::size_t kMaxLingerBytes = 256U << 10U;

http::request<http::string_body> as_beast(const RequestHead& head) {
  http::request<http::string_body> request(http::verb::get, head.target, 11);
  for (const RequestField& field : head.fields) request.insert(field.name, field.value);
  return request;
}

/// Behind a proxy of this machine, the address that the proxy saw: the last that was added.
std::string client_address(const RequestHead& head, const std::string& peer, bool behind_proxy) {
  const auto forwarded = head.find("x-forwarded-for");
  if (!behind_proxy || !forwarded) return peer;
  error_code error;
  if (!asio::ip::make_address(peer, error).is_loopback() || error) return peer;
  const std::size_t begin = forwarded->find_last_of(", ");
  const std::string last(begin == std::string_view::npos ? *forwarded
                                                         : forwarded->substr(begin + 1));
  (void)asio::ip::make_address(last, error);
  return error ? peer : last;
}

}  // namespace

HttpSession::HttpSession(DoorStream&& stream,
                         std::string address,
                         const HttpSessionContext& context,
                         std::function<void(HttpSession*)> on_end)
    : stream_(std::move(stream)),
      address_(std::move(address)),
      context_(context),
      on_end_(std::move(on_end)) {}

void HttpSession::begin() {
  DoorStream::Tls* const tls = stream_.tls();
  if (tls == nullptr) return read_next();
  stream_.tcp().expires_after(context_.options.request_timeout);
  tls->async_handshake(asio::ssl::stream_base::server,
                       [self = shared_from_this()](error_code error) {
                         if (self->ended_) return;
                         if (error) return self->end();
                         self->read_next();
                       });
}

void HttpSession::turn_away() {
  if (stream_.tls() != nullptr) return end();
  HttpResponse response = make_problem(503, "Too many connections are open; try again.");
  response.retry_after_s = 5;
  answer(response);
}

void HttpSession::read_next() {
  silent_ = true;
  silent_since_ = Clock::now();
  has_head_ = false;
  scanned_ = 0;
  // For the whole head, however slowly it comes.
  stream_.tcp().expires_after(context_.options.request_timeout);
  look_for_request();
}

void HttpSession::look_for_request() {
  const HeadEnd found = find_head_end(received_, scanned_);
  scanned_ = received_.size();
  if (found.problem) return refuse(*found.problem);
  if (found.end == 0) return read_more();
  auto parsed = parse_request_head(std::string_view(received_).substr(0, found.end));
  if (const auto* problem = std::get_if<RequestProblem>(&parsed)) return refuse(*problem);
  head_ = std::move(*std::get_if<RequestHead>(&parsed));
  received_.erase(0, found.end);
  has_head_ = true;
  on_request();
}

void HttpSession::read_more() {
  stream_.async_read_some(asio::buffer(piece_),
                          [self = shared_from_this()](error_code error, std::size_t size) {
                            if (self->ended_) return;
                            if (error) return self->end();
                            self->received_.append(self->piece_.data(), size);
                            self->look_for_request();
                          });
}

void HttpSession::on_request() {
  silent_ = false;
  if (!context_.guard.accepts_host(head_.authority)) {
    return refuse({421, "This station is not called '" + head_.authority.substr(0, 200) +
                            "'; open the address that it printed."});
  }
  Guest guest{Role::Instructor, {}};
  if (context_.access != nullptr) {
    const std::string from = client_address(head_, address_, !context_.options.public_url.empty());
    auto verdict = context_.access->judge(head_, from, Clock::now());
    if (const auto* response = std::get_if<HttpResponse>(&verdict)) return answer(*response);
    guest = std::move(*std::get_if<Guest>(&verdict));
  }
  if (head_.method == "GET" && beast::websocket::is_upgrade(as_beast(head_))) {
    return upgrade(guest);
  }
  if (auto problem = problem_of_change(guest)) {
    return head_.body_bytes > 0 ? answer_and_close(*problem) : answer(*problem);
  }
  if (head_.body_bytes > 0) return begin_body(guest);
  handle(guest);
}

std::optional<HttpResponse> HttpSession::problem_of_change(const Guest& guest) const {
  if (head_.method == "GET" || head_.method == "HEAD") return std::nullopt;
  // A cookie alone is no consent: another site's form would be sent with it.
  if (!context_.guard.accepts_origin(head_.find("origin").value_or(""), head_.authority)) {
    return make_problem(403, "Only this station's own page may change anything.");
  }
  if (guest.role != Role::Instructor) {
    return make_problem(403,
                        "Only who came by an instructor's link may change cases or rate attempts.");
  }
  return std::nullopt;
}

void HttpSession::begin_body(const Guest& guest) {
  if (!context_.options.take_body) return refuse({404, "Nothing is taken here."});
  auto opened = context_.options.take_body({head_.method, head_.target, guest}, head_.body_bytes);
  if (const auto* problem = std::get_if<HttpResponse>(&opened)) {
    return answer_and_close(*problem);
  }
  stream_.tcp().rate_policy().read_limit(kMaxBodyBytesInPerSecond);
  taker_ = std::move(*std::get_if<std::unique_ptr<BodyTaker>>(&opened));
  body_left_ = head_.body_bytes;
  const std::chrono::duration<double> allowed(static_cast<double>(head_.body_bytes) /
                                              context_.options.least_body_bytes_per_s);
  body_due_ = Clock::now() + context_.options.request_timeout +
              std::chrono::duration_cast<Clock::duration>(allowed);
  // What came with the head.
  const std::size_t here =
      static_cast<std::size_t>(std::min<std::uint64_t>(received_.size(), body_left_));
  if (here == 0) return read_body();
  body_piece_ = received_.substr(0, here);
  received_.erase(0, here);
  take_piece();
}

void HttpSession::read_body() {
  body_piece_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(kBodyPiece, body_left_)));
  stream_.tcp().expires_at(std::min(body_due_, Clock::now() + context_.options.request_timeout));
  stream_.async_read_some(asio::buffer(body_piece_),
                          [self = shared_from_this()](error_code error, std::size_t size) {
                            if (self->ended_) return;
                            if (error) return self->end();
                            self->body_piece_.resize(size);
                            self->take_piece();
                          });
}

/// On a disk that makes one wait nothing more is read meanwhile.
void HttpSession::take_piece() {
  stream_.tcp().expires_never();
  body_left_ -= body_piece_.size();
  auto work = [self = shared_from_this(), is_last = body_left_ == 0] {
    try {
      HttpResponse verdict = self->taker_->take(self->body_piece_);
      if (verdict.status != BodyTaker::kGoOn || !is_last) return verdict;
      return self->taker_->finish();
    } catch (const std::exception& error) {
      return make_problem(500, error.what());
    }
  };
  const bool is_taken =
      context_.run_aside(NetworkOptions::kLanes, std::move(work),
                         [self = shared_from_this()](const HttpResponse& verdict) {
                           if (!self->ended_) self->on_taken(verdict);
                         });
  if (!is_taken) {
    taker_.reset();
    refuse({503, "Too many requests are waiting; try again."});
  }
}

void HttpSession::on_taken(const HttpResponse& verdict) {
  if (verdict.status == BodyTaker::kGoOn) return read_body();
  taker_.reset();
  body_piece_ = {};
  stream_.tcp().rate_policy().read_limit(kMaxBytesInPerSecond);
  if (body_left_ > 0) return answer_and_close(verdict);
  answer(verdict);
}

void HttpSession::handle(const Guest& guest) {
  HttpRequest request{head_.method, head_.target, guest};
  auto work = [&handler = context_.handler, request] {
    try {
      return handler(request);
    } catch (const std::exception& error) {
      return make_problem(500, error.what());
    }
  };
  const auto& lane_of = context_.options.lane_of;
  const std::size_t lane = lane_of ? lane_of(request) : 0;
  if (lane == 0) return answer(work());
  stream_.tcp().expires_never();
  const bool is_taken = context_.run_aside(lane, std::move(work),
                                           [self = shared_from_this()](const HttpResponse& made) {
                                             if (!self->ended_) self->answer(made);
                                           });
  if (is_taken) return;
  HttpResponse response = make_problem(503, "Too many requests are waiting; try again.");
  response.retry_after_s = 1;
  answer(response);
}

namespace {

/// Sixteen bytes in base64, as RFC 6455 §4.1 has it.
bool is_handshake_key(std::string_view key) {
  constexpr std::size_t kCharacters = 22;
  constexpr std::string_view kBase64 =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  return key.size() == kCharacters + 2 && key.ends_with("==") &&
         key.find_first_not_of(kBase64) == kCharacters;
}

}  // namespace

void HttpSession::upgrade(const Guest& guest) {
  if (!head_.is_http_1_1 || !is_handshake_key(head_.find("sec-websocket-key").value_or(""))) {
    return refuse({400, "The request for a WebSocket is malformed."});
  }
  if (head_.target != "/ws") return answer(make_problem(404, "The WebSocket is at /ws."));
  if (!context_.guard.accepts_origin(head_.find("origin").value_or(""), head_.authority)) {
    return answer(make_problem(403, "Only this station's own page may operate."));
  }
  // No page sends frames before it was answered.
  if (!received_.empty()) return refuse({400, "Something follows the request for a WebSocket."});
  const auto self = shared_from_this();
  ended_ = true;
  context_.upgrade(std::move(stream_), address_, as_beast(head_), guest);
  on_end_(this);
}

void HttpSession::refuse(const RequestProblem& problem) {
  answer_and_close(make_problem(problem.status, problem.reason));
}

void HttpSession::answer_and_close(const HttpResponse& response) {
  // What follows a request that cannot be trusted, or was not read, cannot be trusted either.
  head_.keep_alive = false;
  received_.clear();
  answer(response);
}

void HttpSession::answer(const HttpResponse& from) {
  auto share = context_.budget.admit(from.body);
  if (!share) {
    HttpResponse busy = make_problem(503, "Too much is being sent just now; try again.");
    busy.retry_after_s = 2;
    return answer(busy);
  }
  silent_ = false;
  share_ = std::move(*share);
  fill_response(from);
  write();
}

void HttpSession::fill_response(const HttpResponse& from) {
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
  if (!from.set_cookie.empty()) response.set(http::field::set_cookie, from.set_cookie);
  if (from.retry_after_s > 0) {
    response.set(http::field::retry_after, std::to_string(from.retry_after_s));
  }
  if (from.status == 405) response.set(http::field::allow, "GET, HEAD");
  const std::string& body = share_.text();
  response.body() = Body::value_type(body.data(), body.size());
  response.content_length(body.size());
  keep_alive_ = has_head_ && head_.keep_alive;
  response.keep_alive(keep_alive_);
}

void HttpSession::write() {
  stream_.tcp().expires_after(context_.options.answer_timeout);
  serializer_.emplace(*response_);
  auto done = [self = shared_from_this()](error_code error, std::size_t) {
    if (self->ended_) return;
    if (error) return self->end();
    self->on_written();
  };
  if (has_head_ && head_.method == "HEAD") {
    http::async_write_header(stream_, *serializer_, std::move(done));
  } else {
    http::async_write(stream_, *serializer_, std::move(done));
  }
}

void HttpSession::on_written() {
  serializer_.reset();
  response_.reset();
  share_ = {};
  if (keep_alive_) return read_next();
  silent_ = true;
  silent_since_ = Clock::time_point::min();  // the first to go
  stream_.tcp().expires_after(context_.options.linger_timeout);
  DoorStream::Tls* const tls = stream_.tls();
  if (tls == nullptr) return linger();
  tls->async_shutdown([self = shared_from_this()](error_code) {
    if (!self->ended_) self->linger();
  });
}

void HttpSession::linger() {
  error_code ignored;
  stream_.tcp().socket().shutdown(asio::ip::tcp::socket::shutdown_send, ignored);
  drain(kMaxLingerBytes);
}

void HttpSession::drain(std::size_t left) {
  stream_.tcp().async_read_some(
      asio::buffer(piece_), [self = shared_from_this(), left](error_code error, std::size_t size) {
        if (self->ended_) return;
        if (error || size >= left) return self->end();
        self->drain(left - size);
      });
}

void HttpSession::abort() { end(); }

void HttpSession::end() {
  if (ended_) return;
  ended_ = true;
  const auto self = shared_from_this();
  stream_.tcp().close();
  share_ = {};
  on_end_(this);
}

}  // namespace carpus::server::detail
