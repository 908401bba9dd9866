// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What somebody may send who means harm: the door refuses it, keeps little of it, and goes on
// serving others. All of it on loopback, with shortened deadlines.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <thread>
#include <vector>

#include "core/is_sanitized.hpp"
#include "server/echo_test_support.hpp"
#include "server/loopback_client_test_support.hpp"
#include "server/network_server.hpp"

namespace carpus::server {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using namespace std::chrono_literals;
using testing::Echo;
using testing::host_of;
using testing::kPatience;
using testing::PageClient;
using testing::RawClient;
using testing::request;

/// What the process holds in memory [MiB]; 0 where a sanitizer holds more than we do.
std::size_t resident_mib() {
  if (kIsSanitized) return 0;
  std::ifstream file("/proc/self/statm");
  std::size_t whole = 0;
  std::size_t resident = 0;
  file >> whole >> resident;
  return resident * 4096U >> 20U;
}

class HostileTrafficTest : public ::testing::Test {
 protected:
  void start(NetworkOptions options = quick()) {
    options.port = 0;
    server_ = std::make_unique<NetworkServer>(
        options,
        [](const HttpRequest& r) {
          if (r.target == "/large") return make_json(std::string(4U << 20U, 'x'));
          return make_json("\"" + r.target + "\"");
        },
        echo_);
    thread_ = std::thread([this] { server_->run(); });
    before_mib_ = resident_mib();
  }
  static NetworkOptions quick() {
    NetworkOptions options;
    options.request_timeout = 400ms;
    options.answer_timeout = 400ms;
    options.linger_timeout = 200ms;
    options.hello_timeout = 400ms;
    options.ping_interval = 50ms;
    options.page_timeout = 2s;
    return options;
  }
  /// Deadlines that no test waits for: what is answered or closed is so for another reason.
  static NetworkOptions patient() {
    NetworkOptions options = quick();
    options.request_timeout = options.answer_timeout = options.hello_timeout =
        options.page_timeout = 1h;
    return options;
  }
  void TearDown() override {
    EXPECT_EQ(request(port(), "/still-there").result_int(), 200U);
    server_->stop();
    thread_.join();
  }
  [[nodiscard]] std::uint16_t port() const { return server_->port(); }
  [[nodiscard]] std::string head(const std::string& fields = "") const {
    return "GET / HTTP/1.1\r\nHost: " + host_of(port()) + "\r\n" + fields + "\r\n";
  }
  [[nodiscard]] std::string upgrade(const std::string& fields = "") const {
    return "GET /ws HTTP/1.1\r\nHost: " + host_of(port()) + "\r\nOrigin: http://" +
           host_of(port()) +
           "\r\nConnection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
           "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n" +
           fields + "\r\n";
  }
  void expect_little_memory() const {
    if (before_mib_ > 0) {
      EXPECT_LT(resident_mib(), before_mib_ + 64);
    }
  }

  Echo echo_;
  std::unique_ptr<NetworkServer> server_;
  std::thread thread_;
  std::size_t before_mib_ = 0;
};

/// One frame as RFC 6455 §5.2 has it.
std::string frame(unsigned first_byte,
                  const std::string& payload,
                  bool masked = true,
                  std::uint64_t claimed = ~std::uint64_t{0}) {
  const std::uint64_t size = claimed == ~std::uint64_t{0} ? payload.size() : claimed;
  std::string bytes(1, static_cast<char>(first_byte));
  const unsigned mask_bit = masked ? 0x80U : 0U;
  const auto append = [&](int count) {
    for (int i = count - 1; i >= 0; --i) bytes += static_cast<char>(size >> (8 * i) & 0xFFU);
  };
  if (size < 126) {
    bytes += static_cast<char>(mask_bit | size);
  } else if (size < 65536) {
    bytes += static_cast<char>(mask_bit | 126U);
    append(2);
  } else {
    bytes += static_cast<char>(mask_bit | 127U);
    append(8);
  }
  if (masked) bytes += std::string(4, '\0');  // a mask of zeros leaves the payload as it is
  return bytes + payload;
}

constexpr unsigned kFin = 0x80;
constexpr unsigned kContinuation = 0x0;
constexpr unsigned kText = 0x1;
constexpr unsigned kBinary = 0x2;
constexpr unsigned kClose = 0x8;
constexpr unsigned kPing = 0x9;

TEST_F(HostileTrafficTest, RequestsThatReadersDisagreeAboutAreRefusedAndTheConnectionClosed) {
  start();
  const std::string smuggled = "GET /smuggled HTTP/1.1\r\nHost: " + host_of(port()) + "\r\n\r\n";
  for (const std::string& fields :
       {std::string("Content-Length: 44\r\n"),
        std::string("Content-Length: 0\r\nContent-Length: 44\r\n"),
        std::string("Transfer-Encoding: chunked\r\n"),
        std::string("Transfer-Encoding: xchunked\r\n"),
        std::string("Transfer-Encoding: chunked\r\nContent-Length: 44\r\n"),
        std::string("Transfer-Encoding : chunked\r\n"), std::string("X: a\r\n b\r\n"),
        std::string("X: a\nContent-Length: 44\r\n"), std::string("X: a\rContent-Length: 44\r\n"),
        std::string("Host: elsewhere\r\n")}) {
    RawClient client(port());
    client.send(head(fields) + smuggled);
    const std::string answer = client.read_to_end();
    EXPECT_THAT(answer, StartsWith("HTTP/1.1 4")) << fields;
    EXPECT_THAT(answer, HasSubstr("Connection: close")) << fields;
    EXPECT_THAT(answer, Not(HasSubstr("/smuggled"))) << fields;
  }
}

TEST_F(HostileTrafficTest, AbsoluteFormIsAnsweredForThisStationAlone) {
  start();
  const std::string ours = "GET http://" + host_of(port()) +
                           "/there HTTP/1.1\r\nHost: " + host_of(port()) +
                           "\r\nConnection: close\r\n\r\n";
  EXPECT_THAT(testing::exchange_raw(port(), ours), HasSubstr("\"/there\""));
  const std::string other = "GET http://evil.example/ HTTP/1.1\r\nHost: evil.example\r\n\r\n";
  EXPECT_THAT(testing::exchange_raw(port(), other), StartsWith("HTTP/1.1 421"));
}

TEST_F(HostileTrafficTest, ChunksTheirExtensionsAndTrailersAreNeverKept) {
  start();
  const std::string large(1U << 20U, 'x');
  for (const std::string& start : {"1;" + large, "0\r\nTrailer: " + large, std::string("1\r\n")}) {
    RawClient client(port());
    client.send(head("Transfer-Encoding: chunked\r\n") + start);
    for (int i = 0; i < 16 && client.send(large); ++i) {
    }
    EXPECT_TRUE(client.wait_until_closed());
  }
  expect_little_memory();
}

TEST_F(HostileTrafficTest, RefusalArrivesAlthoughMoreWasSentThanIsRead) {
  start();
  RawClient client(port());
  client.send(head("Content-Length: 100000\r\n") + std::string(100'000, 'x'));
  EXPECT_THAT(client.read_to_end(), HasSubstr("Requests have no body here."));
}

TEST_F(HostileTrafficTest, HeadsWithoutEndAreRefusedAt16KiB) {
  start();
  RawClient client(port());
  client.send("GET / HTTP/1.1\r\nX: " + std::string(60'000, 'x'));
  EXPECT_THAT(client.read_to_end(), StartsWith("HTTP/1.1 431"));
  RawClient fields(port());
  std::string many;
  for (int i = 0; i < 20'000; ++i) many += "a:b\r\n";
  fields.send("GET / HTTP/1.1\r\n" + many);
  EXPECT_THAT(fields.read_to_end(), StartsWith("HTTP/1.1 431"));
}

TEST_F(HostileTrafficTest, SlowLorisIsClosedHoweverOftenItSaysSomething) {
  start();
  RawClient client(port());
  const auto begin = std::chrono::steady_clock::now();
  client.send("GET / HTTP/1.1\r\n");
  while (client.send("X: y\r\n") && std::chrono::steady_clock::now() - begin < kPatience) {
    std::this_thread::sleep_for(20ms);
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, kPatience);
}

TEST_F(HostileTrafficTest, WhoReadsAnAnswerTooSlowlyIsClosed) {
  start();
  std::vector<std::unique_ptr<RawClient>> clients;
  for (int i = 0; i < 16; ++i) {
    clients.push_back(std::make_unique<RawClient>(port()));
    clients.back()->send("GET /large HTTP/1.1\r\nHost: " + host_of(port()) + "\r\n\r\n");
  }
  std::this_thread::sleep_for(100ms);
  expect_little_memory();
  std::this_thread::sleep_for(1s);
  for (const auto& client : clients) EXPECT_TRUE(client->wait_until_closed());
}

TEST_F(HostileTrafficTest, ManyRequestsAtOnceAreAnsweredInTheirOrder) {
  start();
  RawClient client(port());
  std::string many;
  for (int i = 0; i < 200; ++i) {
    many += "GET /" + std::to_string(i) + " HTTP/1.1\r\nHost: " + host_of(port()) + "\r\n\r\n";
  }
  client.send(many + head("Connection: close\r\n"));
  const std::string answers = client.read_to_end();
  std::size_t at = 0;
  for (int i = 0; i < 200; ++i) {
    at = answers.find("\"/" + std::to_string(i) + "\"", at);
    ASSERT_NE(at, std::string::npos) << i;
  }
}

TEST_F(HostileTrafficTest, SilentSocketsDoNotLockOthersOut) {
  start(patient());
  std::vector<std::unique_ptr<RawClient>> silent;
  for (int i = 0; i < 200; ++i) silent.push_back(std::make_unique<RawClient>(port()));
  EXPECT_EQ(request(port(), "/").result_int(), 200U);
  PageClient page(port());
  EXPECT_TRUE(page.is_connected());
}

TEST_F(HostileTrafficTest, PageThatSaysHelloKeepsItsPlaceAgainstSilentOnes) {
  NetworkOptions options = patient();
  options.max_connections = 4;
  start(options);
  PageClient page(port());
  page.send("keep");
  ASSERT_TRUE(page.wait_for([](const auto&) { return true; }).has_value());
  std::vector<std::unique_ptr<RawClient>> silent;
  for (int i = 0; i < 40; ++i) {
    silent.push_back(std::make_unique<RawClient>(port()));
    silent.back()->send(i % 2 == 0 ? "" : upgrade());
  }
  page.send("still here");
  EXPECT_TRUE(page.wait_for([](const auto& f) { return f.content == "still here"; }).has_value());
}

TEST_F(HostileTrafficTest, OneAddressHasNotAllThePlaces) {
  NetworkOptions options = patient();
  options.max_per_address = 2;
  start(options);
  std::vector<std::unique_ptr<PageClient>> pages;
  for (int i = 0; i < 2; ++i) {
    pages.push_back(std::make_unique<PageClient>(port()));
    pages.back()->send("keep");
    ASSERT_TRUE(pages.back()->wait_for([](const auto&) { return true; }).has_value());
  }
  EXPECT_EQ(request(port(), "/").result_int(), 503U);
  pages.pop_back();
  for (int i = 0; i < 100 && echo_.closed == 0; ++i) std::this_thread::sleep_for(10ms);
}

TEST_F(HostileTrafficTest, PageThatNeverSaysHelloIsClosed) {
  start();
  PageClient page(port());
  page.send("anything");
  EXPECT_TRUE(page.wait_for([](const auto&) { return true; }).has_value());
  EXPECT_TRUE(page.wait_until_closed());
}

TEST_F(HostileTrafficTest, FramesThatBreakTheRulesEndTheConnection) {
  start(patient());
  struct Case {
    const char* what;
    std::string bytes;
  };
  const std::vector<Case> cases{
      {"no mask", frame(kFin | kText, "hello", false)},
      {"a reserved bit, as compression sets it", frame(kFin | 0x40U | kText, "hello")},
      {"another reserved bit", frame(kFin | 0x10U | kText, "hello")},
      {"a reserved opcode", frame(kFin | 0x3U, "hello")},
      {"a reserved control opcode", frame(kFin | 0xBU, "")},
      {"a ping in parts", frame(kPing, "hello")},
      {"a ping of 126 bytes", frame(kFin | kPing, std::string(126, 'x'))},
      {"a continuation of nothing", frame(kFin | kContinuation, "hello")},
      {"a new message within one", frame(kText, "a") + frame(kFin | kText, "b")},
      {"text that is not UTF-8", frame(kFin | kText, "\xc3\x28")},
      {"a surrogate in UTF-8", frame(kFin | kText, "\xed\xa0\x80")},
      {"text that ends within a character", frame(kFin | kText, "\xe2\x82")},
      {"broken text in parts", frame(kText, "\xf0\x90") + frame(kFin | kContinuation, "x")},
      {"a length of 2^63", frame(kFin | kBinary, "", true, std::uint64_t{1} << 63U)},
      {"a length of 1 GiB", frame(kFin | kBinary, "", true, std::uint64_t{1} << 30U)},
      {"a length beyond ours", frame(kFin | kText, std::string(200'000, 'x'))},
      {"parts that are too long together",
       frame(kText, std::string(100'000, 'x')) +
           frame(kFin | kContinuation, std::string(100'000, 'x'))},
      {"a goodbye of one byte", frame(kFin | kClose, "x")},
      {"a goodbye for a reason that is none", frame(kFin | kClose, std::string("\x03\xed", 2))},
      {"a goodbye that is not UTF-8", frame(kFin | kClose, std::string("\x03\xe8\xff", 3))},
  };
  for (const Case& one : cases) {
    RawClient client(port());
    client.send(upgrade());
    ASSERT_THAT(client.read_until("\r\n\r\n"), StartsWith("HTTP/1.1 101")) << one.what;
    client.send(frame(kFin | kText, "keep") + one.bytes);
    EXPECT_TRUE(client.wait_until_closed()) << one.what;
  }
  expect_little_memory();
}

TEST_F(HostileTrafficTest, CompressionIsNotSpoken) {
  start();
  RawClient client(port());
  client.send(upgrade("Sec-WebSocket-Extensions: permessage-deflate; client_max_window_bits\r\n"));
  const std::string answer = client.read_until("\r\n\r\n");
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 101"));
  EXPECT_THAT(answer, Not(HasSubstr("Extensions")));
}

TEST_F(HostileTrafficTest, UpgradesThatAreNoneAreRefused) {
  start();
  for (const std::string& bytes :
       {upgrade("Sec-WebSocket-Version: 8\r\n"), upgrade() + frame(kFin | kText, "too early"),
        "GET /ws HTTP/1.1\r\nHost: " + host_of(port()) + "\r\nOrigin: http://" + host_of(port()) +
            "\r\nConnection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n\r\n"}) {
    RawClient client(port());
    client.send(bytes);
    EXPECT_THAT(client.read_to_end(), Not(StartsWith("HTTP/1.1 101")));
  }
  EXPECT_EQ(echo_.opened, 0);
}

TEST_F(HostileTrafficTest, FloodOfPingsEndsTheConnection) {
  start(patient());
  PageClient other(port());
  other.send("keep");
  RawClient client(port());
  client.send(upgrade());
  client.read_until("\r\n\r\n");
  client.send(frame(kFin | kText, "keep"));
  std::string pings;
  for (int i = 0; i < 5000; ++i) pings += frame(kFin | kPing, std::string(125, 'x'));
  client.send(pings);
  EXPECT_TRUE(client.wait_until_closed());
  other.send("still here");
  EXPECT_TRUE(other.wait_for([](const auto& f) { return f.content == "still here"; }).has_value());
  expect_little_memory();
}

TEST_F(HostileTrafficTest, PartsWithoutEndAreNotHeldForAMessage) {
  start();
  RawClient client(port());
  client.send(upgrade());
  client.read_until("\r\n\r\n");
  client.send(frame(kText, "a"));
  std::string empty;
  for (int i = 0; i < 10'000; ++i) empty += frame(kContinuation, "");
  // It is read as slowly as the limit says, and nobody is told of a message that does not end.
  for (int i = 0; i < 20 && client.send(empty); ++i) {
  }
  EXPECT_TRUE(client.wait_until_closed());
  EXPECT_EQ(echo_.heard, 0);
  expect_little_memory();
}

TEST_F(HostileTrafficTest, ConnectionsThatComeAndGoLeaveNothingBehind) {
  start();
  const auto descriptors = [] {
    return std::distance(std::filesystem::directory_iterator("/proc/self/fd"),
                         std::filesystem::directory_iterator());
  };
  const auto before = descriptors();
  for (int i = 0; i < 500; ++i) {
    RawClient client(port());
    if (i % 4 == 1) client.send("GET / HT");
    if (i % 4 == 2) client.send(head());
    if (i % 4 == 3) client.send(upgrade());
  }
  const auto until = std::chrono::steady_clock::now() + kPatience;
  while (descriptors() > before && std::chrono::steady_clock::now() < until) {
    std::this_thread::sleep_for(10ms);
  }
  EXPECT_LE(descriptors(), before);
  expect_little_memory();
}

}  // namespace
}  // namespace carpus::server
