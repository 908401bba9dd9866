// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/origin_guard.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace carpus::server {
namespace {

TEST(OriginGuard, StationIsCalledByAddressLocalhostOrItsNameAndItsPort) {
  const OriginGuard guard(8080, {"Theatre"});
  for (const char* host : {"127.0.0.1:8080", "localhost:8080", "LOCALHOST:8080", "[::1]:8080",
                           "192.168.1.5:8080", "theatre:8080"}) {
    EXPECT_TRUE(guard.accepts_host(host)) << host;
  }
  for (const char* host :
       {"", "localhost", "127.0.0.1", "127.0.0.1:80", "evil.example:8080", "1.2.3.4.evil:8080",
        "user@localhost:8080", "localhost:8080:8080", "localhost:08080", "train.example.org"}) {
    EXPECT_FALSE(guard.accepts_host(host)) << host;
  }
}

TEST(OriginGuard, OriginIsThePageThatWasAsked) {
  const OriginGuard plain(8080, {});
  EXPECT_TRUE(plain.accepts_origin("http://127.0.0.1:8080", "127.0.0.1:8080"));
  EXPECT_FALSE(plain.accepts_origin("https://127.0.0.1:8080", "127.0.0.1:8080"));
  EXPECT_FALSE(plain.accepts_origin("http://localhost:8080", "127.0.0.1:8080"));
  EXPECT_FALSE(plain.accepts_origin("null", "127.0.0.1:8080"));
  const OriginGuard secure(443, {"theatre"}, true);
  EXPECT_TRUE(secure.accepts_origin("https://theatre", "theatre"));
  EXPECT_FALSE(secure.accepts_origin("http://theatre", "theatre"));
}

TEST(OriginGuard, ProxysAddressIsOursWhereItWasGiven) {
  const OriginGuard guard(8080, {}, false, parse_public_url("https://Train.example.org/"));
  EXPECT_TRUE(guard.accepts_host("train.example.org"));
  EXPECT_TRUE(guard.accepts_host("127.0.0.1:8080"));
  EXPECT_FALSE(guard.accepts_host("train.example.org:8080"));
  EXPECT_TRUE(guard.accepts_origin("https://train.example.org", "train.example.org"));
  EXPECT_FALSE(guard.accepts_origin("http://train.example.org", "train.example.org"));
  EXPECT_FALSE(guard.accepts_origin("https://train.example.org", "127.0.0.1:8080"));
}

TEST(OriginGuard, PublicAddressIsASiteAlone) {
  EXPECT_EQ(parse_public_url("http://10.0.0.1:81").authority, "10.0.0.1:81");
  for (const char* text : {"", "train.example.org", "ftp://a", "https://", "https:///",
                           "https://a/b", "https://a?b", "https://me@a", "https://a b"}) {
    EXPECT_THROW((void)parse_public_url(text), InvalidInput) << text;
  }
}

}  // namespace
}  // namespace carpus::server
