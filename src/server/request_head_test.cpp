// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Forms of a request that readers are known to disagree about: each is refused, or read one way.
#include "server/request_head.hpp"

#include <gtest/gtest.h>

#include <string>

#include "core/rng.hpp"

namespace carpus::server {
namespace {

std::string with_fields(const std::string& fields) {
  return "GET / HTTP/1.1\r\nHost: here:1\r\n" + fields + "\r\n";
}

/// The status of the refusal, 200 where it is accepted.
unsigned status_of(const std::string& bytes) {
  const HeadEnd found = find_head_end(bytes);
  if (found.problem) return found.problem->status;
  if (found.end == 0) return 0;
  const auto parsed = parse_request_head(std::string_view(bytes).substr(0, found.end));
  if (const auto* problem = std::get_if<RequestProblem>(&parsed)) {
    EXPECT_FALSE(problem->reason.empty());
    return problem->status;
  }
  return 200;
}

RequestHead accepted(const std::string& bytes) {
  const auto parsed = parse_request_head(bytes);
  if (const auto* problem = std::get_if<RequestProblem>(&parsed)) {
    ADD_FAILURE() << problem->reason << "\n" << bytes;
    return {};
  }
  return std::get<RequestHead>(parsed);
}

TEST(RequestHead, ReadsMethodTargetHostAndFields) {
  const RequestHead head =
      accepted("GET /a?b=c HTTP/1.1\r\nHOST:  here:8080\t\r\nX-Thing: a b\r\nEmpty:\r\n\r\n");
  EXPECT_EQ(head.method, "GET");
  EXPECT_EQ(head.target, "/a?b=c");
  EXPECT_EQ(head.authority, "here:8080");
  EXPECT_TRUE(head.keep_alive);
  EXPECT_EQ(head.find("x-thing"), "a b");
  EXPECT_EQ(head.find("empty"), "");
  EXPECT_EQ(head.find("other"), std::nullopt);
}

TEST(RequestHead, AbsoluteFormIsThePathOfTheHostItNames) {
  const RequestHead head = accepted("GET HTTP://here:1/a?b HTTP/1.1\r\nHost: HERE:1\r\n\r\n");
  EXPECT_EQ(head.target, "/a?b");
  EXPECT_EQ(head.authority, "HERE:1");
  EXPECT_EQ(accepted("GET https://here HTTP/1.1\r\nHost: here\r\n\r\n").target, "/");
  EXPECT_EQ(accepted("GET http://here?q HTTP/1.1\r\nHost: here\r\n\r\n").target, "/?q");
}

TEST(RequestHead, ConnectionStaysOpenAsItsVersionAndFieldSay) {
  EXPECT_FALSE(accepted(with_fields("Connection: Upgrade, Close\r\n")).keep_alive);
  EXPECT_TRUE(accepted(with_fields("Connection: upgrade\r\n")).keep_alive);
  EXPECT_FALSE(accepted("GET / HTTP/1.0\r\nHost: h\r\n\r\n").keep_alive);
  EXPECT_TRUE(accepted("GET / HTTP/1.0\r\nHost: h\r\nConnection: Keep-Alive\r\n\r\n").keep_alive);
}

TEST(RequestHead, ChangesAreSpokenOfAtTheirAddressesAlone) {
  const auto change = [](const std::string& method, const std::string& target) {
    const std::string length = method == "PUT" ? "Content-Length: 5\r\n" : "";
    return method + " " + target + " HTTP/1.1\r\nHost: here\r\n" + length + "\r\n";
  };
  EXPECT_EQ(accepted(change("PUT", "/api/asset?attempt=1")).body_bytes, 5U);
  EXPECT_EQ(accepted(change("PUT", "/api/new_case/file?word=w")).body_bytes, 5U);
  for (const char* target : {"/api/asset/", "/api/asset/1", "/api/assets", "/api/%61sset",
                             "/api/attempts/1", "/x?/api/asset", "//api/asset"}) {
    EXPECT_EQ(status_of(change("PUT", target)), 405U) << target;
  }
  for (const char* method : {"POST", "DELETE"}) {
    EXPECT_EQ(status_of(change(method, "/api/asset?attempt=1")), 405U) << method;
  }
}

TEST(RequestHead, RefusesWhatReadersDisagreeAbout) {
  struct Case {
    const char* what;
    std::string bytes;
    unsigned status;
  };
  const std::vector<Case> cases{
      {"no Host", "GET / HTTP/1.1\r\n\r\n", 400},
      {"empty Host", "GET / HTTP/1.1\r\nHost:\r\n\r\n", 400},
      {"Host twice", with_fields("Host: here:1\r\n"), 400},
      {"Host twice, another", with_fields("host: there\r\n"), 400},
      {"absolute form for another host", "GET http://there/ HTTP/1.1\r\nHost: here\r\n\r\n", 400},
      {"absolute form without a host", "GET http:///x HTTP/1.1\r\nHost: here\r\n\r\n", 400},
      {"another scheme", "GET ftp://here/ HTTP/1.1\r\nHost: here\r\n\r\n", 400},
      {"asterisk", "GET * HTTP/1.1\r\nHost: here\r\n\r\n", 400},
      {"no target", "GET  HTTP/1.1\r\nHost: here\r\n\r\n", 400},
      {"a space in the target", "GET /a b HTTP/1.1\r\nHost: here\r\n\r\n", 400},
      {"a tab between", "GET\t/\tHTTP/1.1\r\nHost: here\r\n\r\n", 400},
      {"a fragment", "GET /#a HTTP/1.1\r\nHost: here\r\n\r\n", 400},
      {"a byte of another alphabet", "GET /\xc3\xa9 HTTP/1.1\r\nHost: here\r\n\r\n", 400},
      {"no version", "GET /\r\nHost: here\r\n\r\n", 400},
      {"small letters", "GET / http/1.1\r\nHost: here\r\n\r\n", 400},
      {"version 1.10", "GET / HTTP/1.10\r\nHost: here\r\n\r\n", 400},
      {"version 2", "GET / HTTP/2.0\r\nHost: here\r\n\r\n", 505},
      {"version 1.2", "GET / HTTP/1.2\r\nHost: here\r\n\r\n", 505},
      {"HTTP/2's preface", "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n", 505},
      {"POST", "POST / HTTP/1.1\r\nHost: here\r\nContent-Length: 0\r\n\r\n", 405},
      {"CONNECT", "CONNECT here:1 HTTP/1.1\r\nHost: here:1\r\n\r\n", 405},
      {"OPTIONS *", "OPTIONS * HTTP/1.1\r\nHost: here\r\n\r\n", 405},
      {"get in small letters", "get / HTTP/1.1\r\nHost: here\r\n\r\n", 405},
      {"a method that is none", "G(T / HTTP/1.1\r\nHost: here\r\n\r\n", 400},
      {"a body", with_fields("Content-Length: 5\r\n"), 413},
      {"a length beyond 64 bits", with_fields("Content-Length: 18446744073709551616\r\n"), 413},
      {"a signed length", with_fields("Content-Length: +0\r\n"), 400},
      {"a negative length", with_fields("Content-Length: -1\r\n"), 400},
      {"a hexadecimal length", with_fields("Content-Length: 0x0\r\n"), 400},
      {"a list of lengths", with_fields("Content-Length: 0, 0\r\n"), 400},
      {"length twice", with_fields("Content-Length: 0\r\nContent-Length: 0\r\n"), 400},
      {"an empty length", with_fields("Content-Length:\r\n"), 400},
      {"chunks", with_fields("Transfer-Encoding: chunked\r\n"), 413},
      {"xchunked", with_fields("Transfer-Encoding: xchunked\r\n"), 400},
      {"chunked, identity", with_fields("Transfer-Encoding: chunked, identity\r\n"), 400},
      {"gzip, chunked", with_fields("Transfer-Encoding: gzip, chunked\r\n"), 400},
      {"chunked twice", with_fields("Transfer-Encoding: chunked\r\nTransfer-Encoding: chunked\r\n"),
       400},
      {"chunked with a vertical tab",
       with_fields("Transfer-Encoding: \x0b"
                   "chunked\r\n"),
       400},
      {"length and chunks", with_fields("Content-Length: 0\r\nTransfer-Encoding: chunked\r\n"),
       400},
      {"Origin twice", with_fields("Origin: http://here:1\r\nOrigin: http://there\r\n"), 400},
      {"a folded field", with_fields("X: a\r\n b\r\n"), 400},
      {"a folded first field", "GET / HTTP/1.1\r\n Host: here\r\n\r\n", 400},
      {"a space before the colon", with_fields("Content-Length : 0\r\n"), 400},
      {"a name with a space", with_fields("Content Length: 0\r\n"), 400},
      {"no name", with_fields(": x\r\n"), 400},
      {"no colon", with_fields("rubbish\r\n"), 400},
      {"a carriage return in a value", with_fields("X: a\rb\r\n"), 400},
      {"a line feed alone", "GET / HTTP/1.1\nHost: here\n\n", 400},
      {"a line feed alone at the end", "GET / HTTP/1.1\r\nHost: here\r\n\n", 400},
      {"a zero byte", with_fields(std::string("X: a\0b\r\n", 8)), 400},
      {"a control character", with_fields("X: a\x01\r\n"), 400},
      {"an empty line first", "\r\nGET / HTTP/1.1\r\nHost: here\r\n\r\n", 400},
      {"rubbish", "rubbish\r\n\r\n", 400},
      {"TLS where none is spoken", std::string("\x16\x03\x01\x02\x00\x01\x00", 7), 400},
  };
  for (const Case& one : cases) EXPECT_EQ(status_of(one.bytes), one.status) << one.what;
}

TEST(RequestHead, LengthAndNumberOfFieldsAreLimited) {
  EXPECT_EQ(status_of(with_fields("X: " + std::string(16000, 'x') + "\r\n")), 200U);
  EXPECT_EQ(status_of(with_fields("X: " + std::string(17000, 'x') + "\r\n")), 431U);
  std::string fields;
  for (std::size_t i = 1; i < kMaxHeadFields; ++i) fields += "X:\r\n";
  EXPECT_EQ(status_of(with_fields(fields)), 200U);
  EXPECT_EQ(status_of(with_fields(fields + "X:\r\n")), 431U);
}

TEST(RequestHead, EndIsFoundHoweverTheBytesArrive) {
  const std::string bytes = with_fields("X: y\r\n") + "GET /next";
  for (std::size_t step = 1; step < bytes.size(); ++step) {
    std::size_t scanned = 0;
    HeadEnd found;
    for (std::size_t size = 0; size < bytes.size() && found.end == 0;) {
      size = std::min(size + step, bytes.size());
      found = find_head_end(std::string_view(bytes).substr(0, size), scanned);
      scanned = size;
    }
    EXPECT_EQ(found.end, bytes.size() - 9) << step;
    EXPECT_FALSE(found.problem.has_value());
  }
}

/// What whoever reads on may rely on.
void expect_unambiguous(const RequestHead& head, const std::string& bytes) {
  EXPECT_TRUE(head.method == "GET" || head.method == "HEAD") << bytes;
  ASSERT_FALSE(head.target.empty() || head.authority.empty()) << bytes;
  EXPECT_EQ(head.target.front(), '/') << bytes;
  std::size_t hosts = 0;
  for (const RequestField& field : head.fields) {
    hosts += field.name == "host" ? 1 : 0;
    EXPECT_NE(field.name, "transfer-encoding") << bytes;
    for (const char c : field.value) {
      EXPECT_TRUE(c == '\t' || (static_cast<unsigned char>(c) >= 0x20 && c != 0x7F)) << bytes;
    }
  }
  EXPECT_EQ(hosts, 1U) << bytes;
}

TEST(RequestHead, WhateverIsChangedIsReadOneWayOrRefused) {
  Rng rng(7);
  const std::string whole =
      "GET http://here:1/a?b HTTP/1.1\r\nHost: here:1\r\nContent-Length: 0\r\n"
      "Transfer-Encoding: chunked\r\nConnection: close, x\r\nX : y\r\n z\r\n\r\n";
  const std::string pieces = std::string("\0\r\n\t :,;/?#GETHTP10.\x80\xff", 22) + "\r\n\r\n";
  int accepted = 0;
  for (int i = 0; i < 100'000; ++i) {
    // Lines of it in any number, then single bytes changed, dropped and repeated.
    std::string bytes = whole.substr(0, whole.find("\n") + 1);
    for (std::size_t at = bytes.size(); at < whole.size();) {
      const std::size_t end = whole.find('\n', at) + 1;
      for (auto copies = rng.below(3); copies > 0; --copies) bytes += whole.substr(at, end - at);
      at = end;
    }
    if (rng.below(2) == 0) bytes += "\r\n";
    for (auto changes = rng.below(4); changes > 0; --changes) {
      const auto at = static_cast<std::size_t>(rng.below(bytes.size()));
      const char piece = pieces[static_cast<std::size_t>(rng.below(pieces.size()))];
      switch (rng.below(3)) {
        case 0:
          bytes[at] = piece;
          break;
        case 1:
          bytes.erase(at, 1);
          break;
        default:
          bytes.insert(at, 1, piece);
      }
    }
    const HeadEnd found = find_head_end(bytes);
    if (found.problem || found.end == 0) continue;
    const auto parsed = parse_request_head(std::string_view(bytes).substr(0, found.end));
    if (const auto* head = std::get_if<RequestHead>(&parsed)) {
      ++accepted;
      expect_unambiguous(*head, bytes);
    }
  }
  EXPECT_GT(accepted, 100);
}

}  // namespace
}  // namespace carpus::server
