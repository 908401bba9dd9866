// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "protocol/messages.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "protocol/bodies.hpp"

namespace carpus::protocol {
namespace {

TEST(PageMessages, RefusalsNameTheFieldAndItsRange) {
  const auto refused = parse_page_message(R"({"type":"act","id":"pick_up","item":255})");
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error(), "act: field 'item' must be an integer from 0 to 254");
}

TEST(PageMessages, TextLongerThanTheLimitIsNotEvenParsed) {
  const std::string long_text =
      R"({"type":"pause","x":")" + std::string(kMaxTextBytes, 'a') + "\"}";
  const auto refused = parse_page_message(long_text);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error(), "longer than 16384 bytes");
}

ScoreReport small_report() {
  ScoreReport report;
  report.score_version = 1;
  report.items = {ScoreItem{}, ScoreItem{}};
  report.items[1].id = "time_s";
  return report;
}

TEST(NestedRecords, RefusalsSayWhereInTheTextItIs) {
  std::string text = serialize_stored_score(small_report());
  const std::string unit = R"("id":"time_s","label":"","value":null,"unit":"")";
  const auto at = text.find(unit);
  ASSERT_NE(at, std::string::npos) << text;
  const auto with = [&](const std::string& other) {
    return parse_stored_score(std::string(text).replace(at, unit.size(), other)).error();
  };
  EXPECT_EQ(with(R"("id":"time_s","label":"","value":"2","unit":"")"),
            "field 'items[1].value' must be a number from -1000000000.0 to 1000000000.0");
  EXPECT_EQ(with(R"("id":"time_s","label":"","value":null)"), "field 'items[1].unit' is missing");
  EXPECT_EQ(with(unit + R"(,"colour":1)"), R"(unknown field "items[1].colour")");
}

TEST(OptionalFields, AreNothingWhenNullOrMissingAndAlwaysWritten) {
  const std::string text = serialize_stored_score(small_report());
  EXPECT_NE(text.find(R"("wire":null)"), std::string::npos);
  EXPECT_NE(text.find(R"("true_length_mm":null)"), std::string::npos);
  std::string without = text;
  without.erase(without.find(R"("true_length_mm":null,)"), 22);
  const auto read = parse_stored_score(without);
  ASSERT_TRUE(read.has_value()) << read.error();
  EXPECT_EQ(*read, small_report());
}

TEST(Writers, MakeTextsFitSoThatTheOtherSideTakesThem) {
  LoggedEvent event;
  event.kind = std::string(40, 'k');
  event.text = "caf\xC3\xA9 \x01 broken \xC3( end\xFF";
  const auto read = parse_stored_events(serialize_stored_events({event}));
  ASSERT_TRUE(read.has_value()) << read.error();
  EXPECT_EQ(read->at(0).kind, std::string(31, 'k') + "…");
  EXPECT_EQ(read->at(0).text, "caf\xC3\xA9   broken \xEF\xBF\xBD( end\xEF\xBF\xBD");
  event.text.clear();
  for (int i = 0; i < 300; ++i) event.text += "\xF0\x9F\xA6\xB4";
  const auto bones = parse_host_message(serialize(HostMessage(Event{event})));
  ASSERT_TRUE(bones.has_value()) << bones.error();
  EXPECT_EQ(std::get<Event>(*bones).text.size(), 255U * 4 + 3);
}

TEST(Writers, LeaveANumberThatIsNoneToBeRefused) {
  Snapshot snapshot;
  snapshot.hands.resize(2);
  snapshot.dose_cgy_cm2 = std::numeric_limits<double>::quiet_NaN();
  const auto refused = parse_host_message(serialize(HostMessage(snapshot)));
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error(),
            "snapshot: field 'dose_cgy_cm2' must be a number from 0.0 to 1000000.0");
}

TEST(HostMessages, MayBeLongerThanAPagesAndHaveTheirOwnLimit) {
  Score score;
  score.report = small_report();
  score.report.items.assign(64, ScoreItem{});
  for (ScoreItem& item : score.report.items) item.reason = std::string(1024, 'r');
  const std::string text = serialize(HostMessage(score));
  EXPECT_GT(text.size(), kMaxTextBytes);
  EXPECT_TRUE(parse_host_message(text).has_value());
  EXPECT_EQ(parse_host_message(text + std::string(8 << 20, ' ')).error(),
            "longer than 8388608 bytes");
}

TEST(StoredEvents, AreAListAndRefusedAsAnythingElse) {
  EXPECT_TRUE(parse_stored_events("[]").has_value());
  for (const char* text : {"", "{}", "null", "[[]]", "[1]", R"({"stored_events":[]})", "[],[]"}) {
    EXPECT_FALSE(parse_stored_events(text).has_value()) << text;
  }
}

}  // namespace
}  // namespace carpus::protocol
