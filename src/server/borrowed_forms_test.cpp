// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the tests of nginx (http_host, http_uri, http_method, http_header_ows, body_chunked,
// ignore_invalid_headers) and of Beast (basic_parser, websocket's accept) try on a reader of
// requests, sent to this one through a socket with a second request behind it. Theirs accept some
// of it; here whatever is not one plain request is refused, and what follows it is not heard.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <thread>
#include <vector>

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
using testing::RawClient;

class BorrowedFormsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    NetworkOptions options;
    options.port = 0;
    options.linger_timeout = 10ms;
    server_ = std::make_unique<NetworkServer>(
        options, [](const HttpRequest& r) { return make_json("\"" + r.target + "\""); }, echo_);
    thread_ = std::thread([this] { server_->run(); });
    host_ = host_of(server_->port());
  }
  void TearDown() override {
    EXPECT_EQ(testing::request(server_->port(), "/still-there").result_int(), 200U);
    server_->stop();
    thread_.join();
  }
  [[nodiscard]] std::string answer_to(const std::string& bytes) const {
    RawClient client(server_->port());
    client.send(bytes + "GET /smuggled HTTP/1.1\r\nHost: " + host_ + "\r\n\r\n");
    return client.read_to_end();
  }
  void expect_refused(const std::string& bytes) const {
    const std::string answer = answer_to(bytes);
    EXPECT_THAT(answer, ::testing::AnyOf(StartsWith("HTTP/1.1 4"), StartsWith("HTTP/1.1 505")))
        << bytes;
    EXPECT_THAT(answer, Not(HasSubstr("/smuggled"))) << bytes;
  }
  [[nodiscard]] std::string line(const std::string& first) const {
    return first + "Host: " + host_ + "\r\n\r\n";
  }
  [[nodiscard]] std::string field(const std::string& field) const {
    return "GET / HTTP/1.1\r\nHost: " + host_ + "\r\n" + field + "\r\n";
  }

  Echo echo_;
  std::unique_ptr<NetworkServer> server_;
  std::thread thread_;
  std::string host_;
};

TEST_F(BorrowedFormsTest, FirstLines) {
  for (const char* first :
       {"\tGET / HTTP/1.0\r\n",     "GET\x01 / HTTP/1.0\r\n",
        "GET  / HTTP/1.0\r\n",      "GET \x01 HTTP/1.0\r\n",
        "GET /\x01 HTTP/1.0\r\n",   "GET /\x02 HTTP/1.1\r\n",
        "GET /  HTTP/1.0\r\n",      "GET / _TTP/1.0\r\n",
        "GET / H_TP/1.0\r\n",       "GET / HT_P/1.0\r\n",
        "GET / HTT_/1.0\r\n",       "GET / HTTP_1.0\r\n",
        "GET / HTTP/01.2\r\n",      "GET / HTTP/3.45\r\n",
        "GET / HTTP/67.89\r\n",     "GET / HTTP/x.0\r\n",
        "GET / HTTP/1.x\r\n",       "GET / HTTP/1.0 \r\n",
        "GET / HTTP/1_0\r\n",       "GET / HTTP/1.0\n\r\n",
        "GET / HTTP/1.0\n\r\r\n",   "GET / HTTP/1.0\r\r\n",
        "GET / / HTTP/1.1\r\n",     "GET /foo/bar/.#frag HTTP/1.1\r\n",
        "GET /?#frag HTTP/1.1\r\n", "GET http://localhost:1#frag HTTP/1.1\r\n",
        "GET #frag HTTP/1.1\r\n",   "GET http://localhost:1?a#frag HTTP/1.1\r\n",
        "GET /%aa#f HTTP/1.1\r\n",  "TRACE / HTTP/1.1\r\n",
        "PUT /a HTTP/1.1\r\n",      "CONNECT / HTTP/1.1\r\n",
        "G / HTTP/1.1\r\n",         "!#$%&'*+-.^_`|~09AZaz / HTTP/1.0\r\n"}) {
    expect_refused(line(first));
  }
}

TEST_F(BorrowedFormsTest, Hosts) {
  for (const char* host :
       {"example.com/\\:552", "\\e/xample.com", "..examp-LE.com",
        "com.exa-m.45..:", "[abcd::e\\f98:0/:7654:321]", "[abcd\\::ef98:0:7654:321/]:12",
        "[abcd::ef98:0:7654:321]..:98", "[ab..cd::ef98:0:7654:321]", "[v0a.!$&'()*+,;=-._~Az:]",
        "123.40.56.78:9000:80", "localhost\nHost: again", "localhost\x02", "www.abcd-ef.g02.xyz.",
        "abcd-ef.g02.xyz:80"}) {
    expect_refused("GET / HTTP/1.1\r\nHost: " + std::string(host) + "\r\n\r\n");
    expect_refused("GET http://" + std::string(host) + "/ HTTP/1.1\r\nHost: " + host_ + "\r\n\r\n");
  }
}

TEST_F(BorrowedFormsTest, Fields) {
  for (const char* text :
       {" f: v\r\n", "\tf: v\r\n", "f : v\r\n", "f\t: v\r\n", "f: \n\r\n", "f: v\r \r\n",
        "f: \r v\r\n", "\r \n\r\n", "f:\r\n \r\n", "f: v\r\n u\r\n", "f: \r\n\tx\r\n",
        "Connection: keep\r\n -alive\r\n", "Connection: close\r\n ,any\r\n", ": v\r\n",
        "f\x01: v\r\n", "f: \x7f\r\n"}) {
    expect_refused(field(text));
  }
}

TEST_F(BorrowedFormsTest, LengthsAndEncodings) {
  for (const char* value : {"", "18446744073709551616", "0 0", "0 1", ",", "0,", "1", "01", "9",
                            "42\r\n \t ", "0\r\nContent-Length: 0"}) {
    expect_refused(field("Content-Length: " + std::string(value) + "\r\n"));
  }
  for (const char* value :
       {"chunked", "chunked,", ",chunked", ", chunked", "gzip, chunked", "gzip", "chunked, gzip",
        "chunked,\r\n gzip", "bigchunked", "chunk\r\n ked", "barley\r\n chunked", "identity",
        "chunked\r\nTransfer-Encoding: chunked", "chunked, identity",
        "chunked\r\nContent-Length: 5"}) {
    expect_refused(field("Transfer-Encoding: " + std::string(value) + "\r\n") + "0\r\n\r\n");
    expect_refused("GET / HTTP/1.0\r\nHost: " + host_ + "\r\nTransfer-Encoding: " + value +
                   "\r\n\r\n0\r\n\r\n");
  }
  // Chunks that run away, or are many.
  expect_refused(field("Transfer-Encoding: chunked\r\n") + "4\r\nSEE-THIS\r\n0\r\n\r\n");
  expect_refused(field("Transfer-Encoding: chunked\r\n") +
                 "5;x\r\n*****\r\n0\r\nMD5: 0xff\r\n\r\n");
}

TEST_F(BorrowedFormsTest, WhitespaceAroundAValueIsNoneOfIt) {
  for (const char* text :
       {"f:\r\n", "f: \r\n", "f:\t\r\n", "f:\tv\t \r\n", "Content-Length: \t0\t\r\n",
        "Content-Length: 00\r\n", "Connection: ,\t,,x,, ,\t,,\r\n"}) {
    const std::string answer = answer_to(field(text) + "GET /end HTTP/1.1\r\nHost:\t" + host_ +
                                         "\t\r\nConnection: ,\t,,close,, ,\r\n\r\n");
    EXPECT_THAT(answer, ::testing::AllOf(StartsWith("HTTP/1.1 200"), HasSubstr("\"/end\"")))
        << text;
    EXPECT_THAT(answer, Not(HasSubstr("/smuggled"))) << text;
  }
}

TEST_F(BorrowedFormsTest, HandshakesThatAreNone) {
  const std::string key = "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";
  const std::string version = "Sec-WebSocket-Version: 13\r\n";
  const std::string connection = "Connection: Upgrade\r\n";
  const std::string upgrade = "Upgrade: websocket\r\n";
  const std::string from = "Host: " + host_ + "\r\nOrigin: http://" + host_ + "\r\n";
  const std::string get = "GET /ws HTTP/1.1\r\n";
  for (const std::string& bytes :
       {"POST /ws HTTP/1.1\r\n" + from + connection + upgrade + key + version,
        "GET /ws HTTP/1.0\r\n" + from + connection + upgrade + key + version,
        get + "Origin: http://" + host_ + "\r\n" + connection + upgrade + key + version,
        get + from + upgrade + key + version, get + from + connection + key + version,
        get + from + "Connection: keep-alive\r\n" + upgrade + key + version,
        get + from + connection + "Upgrade: carrier-pigeon\r\n" + key + version,
        get + from + connection + upgrade + version, get + from + connection + upgrade + key,
        get + from + connection + upgrade + key + "Sec-WebSocket-Version: 1\r\n",
        get + from + connection + upgrade + key + key + version,
        get + from + connection + upgrade + "Sec-WebSocket-Key: \r\n" + version,
        get + from + connection + upgrade + "Sec-WebSocket-Key: too short\r\n" + version,
        get + from + connection + upgrade + "Sec-WebSocket-Key: " + std::string(100, 'x') + "\r\n" +
            version}) {
    RawClient client(server_->port());
    client.send(bytes + "Connection: close\r\n\r\n");
    EXPECT_THAT(client.read_to_end(), Not(HasSubstr("101 Switching"))) << bytes;
  }
  EXPECT_EQ(echo_.opened, 0);
}

}  // namespace
}  // namespace carpus::server
