// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/detail/web_socket_session.hpp"

#include "core/version.hpp"

namespace carpus::server::detail {

namespace beast = boost::beast;
namespace websocket = beast::websocket;
using boost::system::error_code;

WebSocketSession::WebSocketSession(DoorStream&& stream,
                                   Peer peer,
                                   const NetworkOptions& options,
                                   PageHandler& handler,
                                   std::function<void(WebSocketSession*)> on_end)
    : socket_(std::move(stream)),
      peer_(std::move(peer)),
      ping_timer_(socket_.get_executor()),
      options_(options),
      handler_(handler),
      on_end_(std::move(on_end)) {}

void WebSocketSession::accept(const beast::http::request<beast::http::string_body>& request) {
  websocket::stream_base::timeout timeout{};
  timeout.handshake_timeout = options_.request_timeout;
  // Silence is judged by check_alive, which is finer than Beast's idle timer.
  timeout.idle_timeout = websocket::stream_base::none();
  timeout.keep_alive_pings = false;
  socket_.set_option(timeout);
  socket_.read_message_max(kMaxFrameBytes);
  // Compression stays off, as it is unless asked for: a small frame cannot grow.
  socket_.control_callback([this](websocket::frame_type, beast::string_view) {
    on_control();  // the callback is owned by the stream
  });
  socket_.set_option(websocket::stream_base::decorator([](websocket::response_type& response) {
    response.set(beast::http::field::server, kProgramVersion);
  }));
  socket_.next_layer().tcp().expires_never();
  socket_.async_accept(request, [self = shared_from_this()](error_code error) {
    if (error) return self->end();
    self->on_accept();
  });
}

void WebSocketSession::on_accept() {
  if (ended_) return;
  open_ = true;
  last_heard_ = std::chrono::steady_clock::now();
  handler_.on_open(shared_from_this());
  read_next();
  ping_later();
}

void WebSocketSession::read_next() {
  socket_.async_read(buffer_, [self = shared_from_this()](error_code error, std::size_t) {
    if (error) return self->end();
    self->on_read();
  });
}

void WebSocketSession::on_read() {
  if (ended_) return;
  heard();
  if (!closing_) {
    if (socket_.got_text()) {
      const auto bytes = buffer_.cdata();
      handler_.on_text(shared_from_this(), {static_cast<const char*>(bytes.data()), bytes.size()});
    } else {
      handler_.on_binary(shared_from_this());
    }
  }
  buffer_.consume(buffer_.size());
  if (!ended_) read_next();
}

void WebSocketSession::heard() {
  last_heard_ = std::chrono::steady_clock::now();
  if (open_) handler_.on_alive(shared_from_this());
}

void WebSocketSession::on_control() {
  if (!control_frames_.allows(Clock::now())) return abort_later();
  heard();
}

/// Because the caller does not expect on_close meanwhile.
void WebSocketSession::abort_later() {
  closing_ = true;
  boost::asio::post(socket_.get_executor(), [self = shared_from_this()] { self->abort(); });
}

void WebSocketSession::enqueue(Frame frame) {
  if (ended_ || closing_) return;
  waiting_bytes_ += frame.content.size();
  if (waiting_bytes_ > kMaxWaitingBytes || queue_.size() >= kMaxWaitingFrames) {
    return abort_later();
  }
  queue_.push_back(std::move(frame));
  if (!writing_) write_next();
}

void WebSocketSession::write_next() {
  if (ended_) return;
  if (queue_.empty()) {
    if (closing_) close_socket();
    return;
  }
  writing_ = true;
  socket_.binary(queue_.front().is_binary);
  socket_.async_write(boost::asio::buffer(queue_.front().content),
                      [self = shared_from_this()](error_code error, std::size_t) {
                        self->writing_ = false;
                        self->waiting_bytes_ -= self->queue_.front().content.size();
                        self->queue_.pop_front();
                        if (error) return self->end();
                        self->write_next();
                      });
}

void WebSocketSession::ping_later() {
  ping_timer_.expires_after(options_.ping_interval);
  ping_timer_.async_wait([self = shared_from_this()](error_code error) {
    if (!error && !self->ended_) self->check_alive();
  });
}

void WebSocketSession::check_alive() {
  const auto now = Clock::now();
  if (now - last_heard_ > options_.page_timeout) return abort();
  if (!is_kept_ && now - opened_at_ > options_.hello_timeout) return abort();
  if (!pinging_) {
    pinging_ = true;
    socket_.async_ping({}, [self = shared_from_this()](error_code error) {
      self->pinging_ = false;
      if (error) self->end();
    });
  }
  ping_later();
}

void WebSocketSession::close() {
  if (ended_ || closing_) return;
  closing_ = true;
  if (!writing_) write_next();
}

void WebSocketSession::close_socket() {
  socket_.async_close(websocket::close_code::normal,
                      [self = shared_from_this()](error_code) { self->end(); });
}

void WebSocketSession::abort() {
  error_code ignored;
  socket_.next_layer().tcp().socket().close(ignored);
  end();
}

void WebSocketSession::end() {
  if (ended_) return;
  ended_ = true;
  ping_timer_.cancel();
  const auto self = shared_from_this();
  error_code ignored;
  socket_.next_layer().tcp().socket().close(ignored);
  if (open_) handler_.on_close(self);
  open_ = false;
  on_end_(this);
}

}  // namespace carpus::server::detail
