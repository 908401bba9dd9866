// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/protocol_messages.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace carpus::server::protocol {
namespace {

namespace fs = std::filesystem;

std::string read_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file.is_open()) << path;
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// Parses and, where accepted, writes again.
using RoundTrip = std::function<Result<std::string>(std::string_view)>;

template <typename Message>
RoundTrip round_trip(Result<Message> (*parse)(std::string_view)) {
  return [parse](std::string_view text) -> Result<std::string> {
    const Result<Message> message = parse(text);
    if (!message) return Refusal{message.error()};
    return serialize(*message);
  };
}

std::vector<std::pair<std::string, RoundTrip>> directions() {
  return {{"page_to_host", round_trip(&parse_page_message)},
          {"host_to_page", round_trip(&parse_host_message)},
          {"http", round_trip(&parse_case_description)}};
}

TEST(ProtocolMessages, ValidFixturesSurviveReadingAndWriting) {
  int count = 0;
  for (const auto& [direction, read_and_write] : directions()) {
    for (const auto& entry : fs::directory_iterator("protocol/fixtures/valid/" + direction)) {
      const std::string text = read_file(entry.path());
      const Result<std::string> again = read_and_write(text);
      ASSERT_TRUE(again.has_value()) << entry.path() << ": " << again.error();
      EXPECT_EQ(nlohmann::json::parse(*again), nlohmann::json::parse(text)) << entry.path();
      ++count;
    }
  }
  EXPECT_GE(count, 25);
}

TEST(ProtocolMessages, InvalidFixturesAreRefusedWithAReason) {
  int count = 0;
  for (const auto& [direction, read_and_write] : directions()) {
    for (const auto& entry : fs::directory_iterator("protocol/fixtures/invalid/" + direction)) {
      const Result<std::string> refused = read_and_write(read_file(entry.path()));
      EXPECT_FALSE(refused.has_value()) << entry.path();
      if (!refused) {
        EXPECT_FALSE(refused.error().empty()) << entry.path();
      }
      ++count;
    }
  }
  EXPECT_GE(count, 45);
}

TEST(ProtocolMessages, RefusalsNameTheFieldAndItsRange) {
  const auto refused = parse_page_message(R"({"type":"select_screw","index":256})");
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error(), "select_screw: field 'index' must be an integer from 0 to 255");
}

TEST(ProtocolMessages, TextLongerThanTheLimitIsNotEvenParsed) {
  const std::string long_text = R"({"type":"undo","x":")" + std::string(kMaxTextBytes, 'a') + "\"}";
  const auto refused = parse_page_message(long_text);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error(), "longer than 16384 bytes");
}

TEST(ProtocolMessages, EveryPrefixAndEverySingleByteChangeIsAnsweredWithoutHarm) {
  const std::string text = read_file("protocol/fixtures/valid/page_to_host/tool.json");
  for (std::size_t length = 0; length < text.size(); ++length) {
    EXPECT_FALSE(parse_page_message(text.substr(0, length)).has_value()) << length;
  }
  for (std::size_t i = 0; i < text.size(); ++i) {
    for (int byte = 0; byte < 256; ++byte) {
      std::string changed = text;
      changed[i] = static_cast<char>(byte);
      const auto result = parse_page_message(changed);
      if (!result) continue;
      // What is accepted must be in range: writing and reading it again gives the same.
      const auto again = parse_page_message(serialize(*result));
      ASSERT_TRUE(again.has_value()) << changed;
      EXPECT_EQ(*again, *result);
    }
  }
}

}  // namespace
}  // namespace carpus::server::protocol
