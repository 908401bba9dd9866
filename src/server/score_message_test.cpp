// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/score_message.hpp"

#include <gtest/gtest.h>

#include "cases/synthetic_case_test_support.hpp"
#include "procedure/screw_catalogue.hpp"

namespace carpus::server {
namespace {

TEST(ScoreMessage, OfAnOperationThatDidNothingIsReadableAndSaysWhatWasNotMeasured) {
  const procedure::ScoreReport report =
      procedure::score_operation(cases::test::synthetic_case(), {});
  const protocol::ScoreReport message = score_message(report);
  const auto read = protocol::parse_stored_score(protocol::serialize_stored_score(message));
  ASSERT_TRUE(read.has_value()) << read.error();
  EXPECT_EQ(*read, message);
  ASSERT_EQ(read->items.size(), report.items.size());
  EXPECT_EQ(read->items[0].value, std::nullopt);
  EXPECT_EQ(read->items[0].grade, protocol::Grade::NotMeasured);
  EXPECT_EQ(read->overall, report.overall);
  EXPECT_EQ(read->must_haves.size(), report.must_haves.size());
  EXPECT_EQ(read->placement.screw, std::nullopt);
}

TEST(ScoreMessage, PutsScrewAndWireWhereTheyLie) {
  procedure::ScoreReport report;
  report.placement.wire = procedure::PlacedLine{{1, 2, 3}, {4, 5, 6}};
  report.placement.screw = procedure::PlacedLine{{7, 8, 9}, {10, 11, 12}};
  report.placement.screw_tip_diameter_mm = 3.5;
  report.placement.screw_tail_diameter_mm = 4.1;
  const protocol::Placement placement = score_message(report).placement;
  EXPECT_EQ(placement.wire, (protocol::PlacedWire{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(placement.screw, (protocol::PlacedScrew{{7, 8, 9}, {10, 11, 12}, 3.5, 4.1}));
}

TEST(ScrewTray, KeepsTheOrderOfTheIndicesAndHoldsOnlyScrewsForTheWire) {
  const protocol::ScrewTray tray = screw_tray();
  ASSERT_EQ(tray.screws.size(), procedure::screw_catalogue().size());
  for (std::size_t i = 0; i < tray.screws.size(); ++i) {
    EXPECT_EQ(tray.screws[i].index, static_cast<std::int64_t>(i));
    EXPECT_EQ(tray.screws[i].name, procedure::screw_catalogue()[i].name);
    EXPECT_EQ(tray.screws[i].wire_diameter_mm, procedure::kWireDiameterMm);
  }
  EXPECT_TRUE(protocol::parse_screw_tray(serialize(tray)).has_value());
}

}  // namespace
}  // namespace carpus::server
