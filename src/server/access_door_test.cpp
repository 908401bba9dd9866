// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Links, TLS and slow work through real sockets on loopback.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <future>
#include <memory>
#include <thread>
#include <vector>

#include "core/error.hpp"
#include "server/certificate_test_support.hpp"
#include "server/echo_test_support.hpp"
#include "server/loopback_client_test_support.hpp"
#include "server/network_server.hpp"
//
#include <boost/asio/ssl.hpp>
#include <boost/beast/ssl/ssl_stream.hpp>
#include <boost/beast/websocket/ssl.hpp>

namespace carpus::server {
namespace {

namespace fs = std::filesystem;
namespace asio = boost::asio;
namespace beast = boost::beast;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using namespace std::chrono_literals;
using testing::exchange_raw;
using testing::Headers;
using testing::host_of;
using testing::HttpAnswer;
using testing::kPatience;
using testing::RawClient;
using testing::request;

class AccessDoorTest : public ::testing::Test {
 protected:
  AccessDoorTest() {
    std::string name = (fs::temp_directory_path() / "carpus-door-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    options_.port = 0;
    options_.request_timeout = 400ms;
    options_.linger_timeout = 200ms;
  }
  ~AccessDoorTest() override {
    if (server_) server_->stop();
    if (thread_.joinable()) thread_.join();
    fs::remove_all(folder_);
  }
  void start() {
    server_ = std::make_unique<NetworkServer>(
        options_,
        [this](const HttpRequest& r) {
          if (r.target == "/slow") go_.wait();
          return make_json(r.guest.role == Role::Instructor ? "instructor" : "trainee");
        },
        echo_);
    thread_ = std::thread([this] { server_->run(); });
  }
  void use_tls() {
    options_.certificate = folder_ / "station.crt";
    options_.key = folder_ / "station.key";
    testing::write_certificate(options_.certificate, options_.key);
  }
  [[nodiscard]] std::uint16_t port() const { return server_->port(); }
  [[nodiscard]] std::string cookie_for(const std::string& token) const {
    const std::string set(request(port(), "/?token=" + token)["Set-Cookie"]);
    return set.substr(0, set.find(';'));
  }
  [[nodiscard]] Headers upgrade(const std::string& scheme = "http://") const {
    return {{"Connection", "Upgrade"},
            {"Upgrade", "websocket"},
            {"Sec-WebSocket-Version", "13"},
            {"Sec-WebSocket-Key", "dGhlIHNhbXBsZSBub25jZQ=="},
            {"Origin", scheme + host_of(port())}};
  }

  fs::path folder_;
  NetworkOptions options_;
  testing::Echo echo_;
  std::promise<void> let_go_;
  std::shared_future<void> go_ = let_go_.get_future().share();
  std::unique_ptr<NetworkServer> server_;
  std::thread thread_;
};

TEST_F(AccessDoorTest, LinkLetsInWithItsRoleAndNothingElseDoes) {
  options_.links = make_access_links();
  start();
  for (const char* target : {"/", "/index.html", "/api/case", "/api/attempts", "/?token=x"}) {
    EXPECT_EQ(request(port(), target).result_int(), 403U) << target;
  }
  EXPECT_EQ(request(port(), "/ws", upgrade()).result_int(), 403U);
  const HttpAnswer entry = request(port(), "/?token=" + options_.links->trainee);
  EXPECT_EQ(entry.result_int(), 200U);
  EXPECT_EQ(entry["Cache-Control"], "no-store");
  EXPECT_EQ(entry["Referrer-Policy"], "no-referrer");
  EXPECT_THAT(std::string(entry["Set-Cookie"]), Not(HasSubstr("Secure")));
  const Headers trainee{{"Cookie", cookie_for(options_.links->trainee)}};
  const Headers instructor{{"Cookie", cookie_for(options_.links->instructor)}};
  EXPECT_EQ(request(port(), "/", trainee).body(), "trainee");
  EXPECT_EQ(request(port(), "/", instructor).body(), "instructor");
  Headers page = upgrade();
  page["Cookie"] = trainee.at("Cookie");
  EXPECT_EQ(request(port(), "/ws", page).result_int(), 101U);
  page["Origin"] = "http://evil.example";
  EXPECT_EQ(request(port(), "/ws", page).result_int(), 403U);
  EXPECT_EQ(request(port(), "/", {{"Cookie", trainee.at("Cookie")}, {"Host", "evil.example"}})
                .result_int(),
            421U);
}

TEST_F(AccessDoorTest, FailuresAreCountedByTheAddressThatTheProxySaw) {
  options_.links = make_access_links();
  options_.public_url = "https://train.example.org";
  start();
  const auto fail_from = [&](const char* address) {
    return request(port(), "/?token=x",
                   {{"Host", "train.example.org"}, {"X-Forwarded-For", address}})
        .result_int();
  };
  for (int i = 0; i < 40; ++i) (void)fail_from("203.0.113.5");
  EXPECT_EQ(fail_from("203.0.113.5"), 429U);
  // Whoever asks can add addresses before the last, and none behind it.
  EXPECT_EQ(fail_from("198.51.100.7, 203.0.113.5"), 429U);
  EXPECT_EQ(fail_from("198.51.100.7"), 403U);
  EXPECT_THAT(std::string(request(port(), "/?token=" + options_.links->trainee,
                                  {{"Host", "train.example.org"}})["Set-Cookie"]),
              HasSubstr("; Secure"));
}

TEST_F(AccessDoorTest, SlowAnswersKeepNobodyElseWaiting) {
  options_.lane_of = [](const HttpRequest& r) { return r.target == "/slow" ? 1U : 0U; };
  start();
  std::vector<std::unique_ptr<RawClient>> slow;
  for (int i = 0; i < 31; ++i) {
    slow.push_back(std::make_unique<RawClient>(port()));
    slow.back()->send("GET /slow HTTP/1.1\r\nHost: " + host_of(port()) +
                      "\r\nConnection: close\r\n\r\n");
  }
  // Those wait until they are let go.
  EXPECT_EQ(request(port(), "/").result_int(), 200U);
  let_go_.set_value();
  for (const auto& client : slow) EXPECT_THAT(client->read_to_end(), StartsWith("HTTP/1.1 200"));
}

TEST_F(AccessDoorTest, StationStopsWhileSlowAnswersWait) {
  options_.lane_of = [](const HttpRequest& r) { return r.target == "/slow" ? 1U : 0U; };
  start();
  RawClient client(port());
  client.send("GET /slow HTTP/1.1\r\nHost: " + host_of(port()) + "\r\n\r\n");
  EXPECT_EQ(request(port(), "/").result_int(), 200U);
  server_->stop();
  thread_.join();
  let_go_.set_value();
  server_.reset();
  EXPECT_TRUE(client.wait_until_closed());
}

/// One request over TLS.
HttpAnswer request_by_tls(std::uint16_t port, const std::string& target, const Headers& headers) {
  asio::io_context context;
  asio::ssl::context tls(asio::ssl::context::tls_client);
  beast::ssl_stream<beast::tcp_stream> stream(context, tls);
  stream.next_layer().connect(testing::loopback(port));
  stream.handshake(asio::ssl::stream_base::client);
  beast::http::request<beast::http::empty_body> message(beast::http::verb::get, target, 11);
  message.set(beast::http::field::host, host_of(port));
  message.keep_alive(false);
  for (const auto& [name, value] : headers) message.set(name, value);
  beast::http::write(stream, message);
  beast::flat_buffer buffer;
  beast::http::response_parser<beast::http::string_body> parser;
  beast::http::read(stream, buffer, parser);
  boost::system::error_code end;
  stream.shutdown(end);
  EXPECT_TRUE(!end || end == asio::error::eof) << end.message();
  return parser.release();
}

TEST_F(AccessDoorTest, AllOfItGoesThroughTls) {
  use_tls();
  options_.links = make_access_links();
  start();
  EXPECT_THAT(server_->url(), StartsWith("https://127.0.0.1:"));
  const std::string set(
      request_by_tls(port(), "/?token=" + options_.links->instructor, {})["Set-Cookie"]);
  EXPECT_THAT(set, HasSubstr("; Secure"));
  const std::string cookie = set.substr(0, set.find(';'));
  EXPECT_EQ(request_by_tls(port(), "/", {{"Cookie", cookie}}).body(), "instructor");
  EXPECT_EQ(request_by_tls(port(), "/", {}).result_int(), 403U);

  asio::io_context context;
  asio::ssl::context tls(asio::ssl::context::tls_client);
  beast::websocket::stream<beast::ssl_stream<beast::tcp_stream>> page(context, tls);
  beast::get_lowest_layer(page).connect(testing::loopback(port()));
  page.next_layer().handshake(asio::ssl::stream_base::client);
  page.set_option(
      beast::websocket::stream_base::decorator([&](beast::websocket::request_type& message) {
        message.set(beast::http::field::origin, "https://" + host_of(port()));
        message.set(beast::http::field::cookie, cookie);
      }));
  page.handshake(host_of(port()), "/ws");
  page.write(asio::buffer(std::string(100'000, 'x')));
  beast::flat_buffer heard;
  page.read(heard);
  EXPECT_EQ(heard.size(), 100'000U);
  page.close(beast::websocket::close_code::normal);
}

TEST_F(AccessDoorTest, WhoDoesNotSpeakTlsOrTooOldOneIsClosed) {
  use_tls();
  start();
  EXPECT_THAT(exchange_raw(port(), "GET / HTTP/1.1\r\nHost: " + host_of(port()) + "\r\n\r\n"),
              Not(HasSubstr("HTTP")));
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(exchange_raw(port(), ""), "");
  EXPECT_EQ(exchange_raw(port(), "\x16\x03\x01"), "");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, kPatience);
  asio::io_context context;
  asio::ssl::context old(asio::ssl::context::tls_client);
  ::SSL_CTX_set_security_level(old.native_handle(), 0);
  ::SSL_CTX_set_max_proto_version(old.native_handle(), TLS1_1_VERSION);
  asio::ssl::stream<asio::ip::tcp::socket> stream(context, old);
  stream.lowest_layer().connect(testing::loopback(port()));
  boost::system::error_code error;
  stream.handshake(asio::ssl::stream_base::client, error);
  EXPECT_TRUE(error.failed());
  EXPECT_EQ(request_by_tls(port(), "/", {}).result_int(), 200U);
}

TEST_F(AccessDoorTest, FilesForTlsThatAreNoneAreNamed) {
  use_tls();
  const auto refusal = [&] {
    try {
      start();
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("started");
  };
  const fs::path key = options_.key;
  options_.key.clear();
  EXPECT_THAT(refusal(), HasSubstr("--certificate and --key"));
  options_.key = folder_ / "none";
  EXPECT_THAT(refusal(), HasSubstr("(--key)"));
  options_.key = options_.certificate;
  EXPECT_THAT(refusal(), HasSubstr("(--key)"));
  testing::write_certificate(folder_ / "other.crt", folder_ / "other.key");
  options_.key = folder_ / "other.key";
  EXPECT_THAT(refusal(), HasSubstr("fits the certificate"));
  options_.key = key;
  std::ofstream(options_.certificate) << "rubbish";
  EXPECT_THAT(refusal(), HasSubstr("(--certificate)"));
}

}  // namespace
}  // namespace carpus::server
