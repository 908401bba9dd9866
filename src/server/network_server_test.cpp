// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/network_server.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <thread>
#include <vector>

#include "core/error.hpp"
#include "server/echo_test_support.hpp"
#include "server/loopback_client_test_support.hpp"

namespace carpus::server {
namespace {

using ::testing::HasSubstr;
using namespace std::chrono_literals;
using testing::Echo;
using testing::exchange_raw;
using testing::host_of;
using testing::PageClient;
using testing::request;
using testing::upgrade_status;

class NetworkServerTest : public ::testing::Test {
 protected:
  void start(NetworkOptions options = {}) {
    options.port = 0;
    server_ = std::make_unique<NetworkServer>(
        options,
        [](const HttpRequest& r) {
          if (r.target == "/throws") throw IoError("the disk is on fire");
          return make_json("{\"target\":\"" + r.target + "\"}");
        },
        echo_);
    thread_ = std::thread([this] { server_->run(); });
  }
  void TearDown() override {
    if (server_) server_->stop();
    if (thread_.joinable()) thread_.join();
  }
  [[nodiscard]] std::uint16_t port() const { return server_->port(); }

  Echo echo_;
  std::unique_ptr<NetworkServer> server_;
  std::thread thread_;
};

TEST_F(NetworkServerTest, AnswersGetAndHeadWithSecurityHeaders) {
  start();
  const auto answer = request(port(), "/hello");
  EXPECT_EQ(answer.result_int(), 200U);
  EXPECT_EQ(answer.body(), "{\"target\":\"/hello\"}");
  EXPECT_EQ(answer["X-Content-Type-Options"], "nosniff");
  EXPECT_THAT(std::string(answer["Content-Security-Policy"]), HasSubstr("default-src 'self'"));
  EXPECT_EQ(answer["Cache-Control"], "no-store");
  const auto head = request(port(), "/hello", {}, boost::beast::http::verb::head);
  EXPECT_EQ(head.result_int(), 200U);
  EXPECT_EQ(head["Content-Length"], "19");
  EXPECT_TRUE(head.body().empty());
}

TEST_F(NetworkServerTest, RefusesOtherMethodsOtherHostsAndBodies) {
  start();
  EXPECT_EQ(request(port(), "/", {}, boost::beast::http::verb::delete_).result_int(), 405U);
  EXPECT_EQ(request(port(), "/", {{"Host", "evil.example"}}).result_int(), 421U);
  EXPECT_EQ(request(port(), "/", {{"Host", "127.0.0.1:1"}}).result_int(), 421U);
  EXPECT_THAT(exchange_raw(port(), "POST / HTTP/1.1\r\nHost: " + host_of(port()) +
                                       "\r\nContent-Length: 5\r\n\r\nhello"),
              HasSubstr("HTTP/1.1 405"));
  EXPECT_THAT(exchange_raw(port(), "GET / HTTP/1.1\r\nHost: " + host_of(port()) +
                                       "\r\nContent-Length: 5\r\n\r\nhello"),
              HasSubstr("HTTP/1.1 413"));
  EXPECT_EQ(request(port(), "/still-there").result_int(), 200U);
}

TEST_F(NetworkServerTest, AHandlerThatThrowsBecomesAnAnswer) {
  start();
  const auto answer = request(port(), "/throws");
  EXPECT_EQ(answer.result_int(), 500U);
  EXPECT_THAT(answer.body(), HasSubstr("the disk is on fire"));
}

TEST_F(NetworkServerTest, MalformedAndOversizedRequestsAreAnsweredAndClosed) {
  start();
  EXPECT_THAT(exchange_raw(port(), "rubbish\r\n\r\n"), HasSubstr("HTTP/1.1 400"));
  EXPECT_THAT(exchange_raw(port(), "GET / HTTP/1.1\r\nX: " + std::string(100000, 'x') + "\r\n\r\n"),
              HasSubstr("HTTP/1.1 431"));
  EXPECT_EQ(request(port(), "/still-there").result_int(), 200U);
}

TEST_F(NetworkServerTest, ClientThatSendsItsRequestTooSlowlyIsClosed) {
  NetworkOptions options;
  options.request_timeout = 200ms;
  start(options);
  const auto before = std::chrono::steady_clock::now();
  EXPECT_EQ(exchange_raw(port(), "GET / HTTP/1.1\r\nHost: "), "");
  const auto waited = std::chrono::steady_clock::now() - before;
  EXPECT_GE(waited, 150ms);
  EXPECT_LT(waited, 5s);
}

TEST_F(NetworkServerTest, ConnectionsBeyondTheLimitAreToldAndOthersGoOn) {
  NetworkOptions options;
  options.max_connections = 3;
  start(options);
  std::vector<std::unique_ptr<PageClient>> pages;
  for (int i = 0; i < 3; ++i) {
    pages.push_back(std::make_unique<PageClient>(port()));
    ASSERT_TRUE(pages.back()->is_connected());
    pages.back()->send("keep");
    EXPECT_TRUE(pages.back()->wait_for([](const auto&) { return true; }).has_value());
  }
  const auto answer = request(port(), "/");
  EXPECT_EQ(answer.result_int(), 503U);
  EXPECT_EQ(answer["Retry-After"], "5");
  pages[0]->send("still here");
  EXPECT_EQ(pages[0]->wait_for([](const auto&) { return true; })->content, "still here");
}

TEST_F(NetworkServerTest, WebSocketNeedsThePagesOwnOrigin) {
  start();
  EXPECT_EQ(upgrade_status(port(), "http://evil.example"), 403U);
  EXPECT_EQ(upgrade_status(port(), "http://127.0.0.1:1"), 403U);
  EXPECT_EQ(upgrade_status(port(), "https://" + host_of(port())), 403U);
  EXPECT_EQ(upgrade_status(port(), "null"), 403U);
  EXPECT_EQ(upgrade_status(port(), ""), 403U);
  EXPECT_EQ(upgrade_status(port(), "http://" + host_of(port()), "/other"), 404U);
  EXPECT_EQ(echo_.opened, 0);
  EXPECT_EQ(upgrade_status(port(), "http://" + host_of(port())), 101U);
  EXPECT_TRUE(PageClient(port()).is_connected());
}

TEST_F(NetworkServerTest, FramesGoThroughAndBinaryOnesAreTold) {
  start();
  PageClient page(port());
  page.send("hello");
  EXPECT_EQ(page.wait_for([](const auto&) { return true; })->content, "hello");
  page.send("\x01\x02", true);
  EXPECT_EQ(page.wait_for([](const auto&) { return true; })->content, "text!");
  page.send(std::string(100000, 'x'));
  EXPECT_EQ(page.wait_for([](const auto&) { return true; })->content.size(), 100000U);
  page.send("close");
  EXPECT_EQ(page.wait_for([](const auto&) { return true; })->content, "goodbye");
  EXPECT_TRUE(page.wait_until_closed());
}

TEST_F(NetworkServerTest, HugeFramesAndBrokenTextEndTheConnectionOnly) {
  start();
  PageClient page(port());
  page.send(std::string(2U << 20U, 'x'));
  EXPECT_TRUE(page.wait_until_closed());
  PageClient other(port());
  other.send("\xff\xfe");
  EXPECT_TRUE(other.wait_until_closed());
  EXPECT_EQ(request(port(), "/still-there").result_int(), 200U);
}

TEST_F(NetworkServerTest, PageThatVanishesIsNoticed) {
  start();
  {
    PageClient page(port());
    page.send("hello");
    (void)page.wait_for([](const auto&) { return true; });
    page.vanish();
  }
  for (int i = 0; i < 500 && echo_.closed == 0; ++i) std::this_thread::sleep_for(10ms);
  EXPECT_EQ(echo_.closed, 1);
}

TEST_F(NetworkServerTest, PageThatDoesNotAnswerPingsIsClosed) {
  NetworkOptions options;
  options.ping_interval = 50ms;
  options.page_timeout = 300ms;
  start(options);
  PageClient page(port());  // reads, and so answers pings, only while it waits for something
  (void)page.wait_for([](const auto&) { return false; }, 600ms);
  EXPECT_TRUE(page.is_connected());
  EXPECT_GT(echo_.alive, 3);
  for (int i = 0; i < 500 && echo_.closed == 0; ++i) std::this_thread::sleep_for(10ms);
  EXPECT_EQ(echo_.closed, 1);
}

TEST_F(NetworkServerTest, PageThatDoesNotReadIsDisconnectedBeforeMemoryFills) {
  start();
  PageClient page(port());
  page.send("flood");
  for (int i = 0; i < 500 && echo_.closed == 0; ++i) std::this_thread::sleep_for(10ms);
  EXPECT_EQ(echo_.closed, 1);
}

TEST_F(NetworkServerTest, StoppingClosesEveryPage) {
  start();
  PageClient page(port());
  ASSERT_TRUE(page.is_connected());
  page.send("x");
  (void)page.wait_for([](const auto&) { return true; });
  server_->stop();
  thread_.join();
  EXPECT_EQ(echo_.closed, 1);
  EXPECT_TRUE(page.wait_until_closed());
}

TEST_F(NetworkServerTest, PortInUseIsNamedWithTheOptionThatChangesIt) {
  start();
  NetworkOptions options;
  options.port = port();
  try {
    NetworkServer second(
        options, [](const HttpRequest&) { return HttpResponse{}; }, echo_);
    FAIL() << "two servers on one port";
  } catch (const IoError& error) {
    EXPECT_THAT(error.what(), HasSubstr("port " + std::to_string(port()) + " is in use"));
    EXPECT_THAT(error.what(), HasSubstr("--port"));
  }
}

TEST_F(NetworkServerTest, WhatTheServerWouldRefuseIsRefusedBeforeLongWork) {
  start();
  NetworkOptions options;
  options.port = port();
  EXPECT_THROW(require_network(options), IoError) << "the port is taken";
  options.port = 0;
  EXPECT_NO_THROW(require_network(options));
  options.certificate = "no_such_certificate.pem";
  options.key = "no_such_key.pem";
  EXPECT_THROW(require_network(options), IoError) << "no such certificate";
  options.certificate = options.key = "";
  options.public_url = "train.example.org";
  EXPECT_THROW(require_network(options), InvalidInput) << "no address of a page";
}

TEST_F(NetworkServerTest, AskingBeforeLongWorkLeavesThePortFree) {
  start();
  NetworkOptions options;
  options.port = port();
  server_->stop();
  thread_.join();
  server_.reset();
  EXPECT_NO_THROW(require_network(options));
  EXPECT_NO_THROW(require_network(options)) << "the first look kept it";
}

TEST_F(NetworkServerTest, AddressThatIsNoneIsRefused) {
  NetworkOptions options;
  options.address = "everywhere";
  EXPECT_THROW(NetworkServer(
                   options, [](const HttpRequest&) { return HttpResponse{}; }, echo_),
               InvalidInput);
}

}  // namespace
}  // namespace carpus::server
