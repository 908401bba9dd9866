// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "session/scope_message.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "instruments/instrument.hpp"
#include "simulation/lesions_of.hpp"

namespace carpus::session {
namespace {

procedure::Procedure arthroscopy() {
  procedure::Procedure made;
  made.tray = {instruments::instrument_of("arthroscope_1_9_30").value()};
  return made;
}

procedure::Procedure exercises() {
  procedure::Procedure made = arthroscopy();
  made.drill.emplace();
  made.drill->hold = {2, 7, 11};
  made.drill->hold_s = 3;
  made.drill->touch = {8};
  made.drill->line = {8, 11, 16};
  return made;
}

/// The joint lies below 1 mm.
Grid<float> wall() {
  Grid<float> made(GridGeometry{{40, 8, 8}, {1, 1, 1}, {-5, -4, -4}});
  std::size_t at = 0;
  for (int z = 0; z < 8; ++z) {
    for (int i = 0; i < 40 * 8; ++i) made.values()[at++] = static_cast<float>(z - 4 - 1);
  }
  return made;
}

cases::CaseData with_places() {
  cases::CaseData data;
  data.bones.emplace_back();
  data.bones.back().bone = BoneId::Radius;
  cases::ArthroscopicMap map;
  map.joints.push_back({"radiocarpal", "radiocarpal joint", wall(), 0, 0});
  double at = 0;
  for (const int number : {2, 7, 8, 11, 16}) {
    cases::TourPoint place;
    place.number = number;
    place.at = {at, 0, 0};
    at += 5;
    map.points.push_back(place);
  }
  data.arthroscopy = std::make_shared<const cases::ArthroscopicMap>(map);
  return data;
}

simulation::Snapshot holding(procedure::Mode mode) {
  simulation::Snapshot now;
  now.mode = mode;
  now.scope.hand = 0;
  now.scope.hold_ticks = 1500;
  now.scope.facts.drill.held = 1;
  now.scope.is_level = false;
  now.scope.is_probe_seen = false;
  return now;
}

TEST(ScopeMessage, TellsHowFarAnExerciseIs) {
  const cases::CaseData data = with_places();
  const auto message = scope_message(data, exercises(), holding(procedure::Mode::Practice));
  ASSERT_TRUE(message && message->drill);
  EXPECT_EQ(message->drill->held, 1);
  EXPECT_DOUBLE_EQ(message->drill->hold_share, 0.5);
  EXPECT_FALSE(message->drill->level);
  EXPECT_FALSE(message->drill->probe_seen);
}

TEST(ScopeMessage, AnAssessedHandSeesByItselfWhatIsWrongWithThePicture) {
  const cases::CaseData data = with_places();
  const auto message = scope_message(data, exercises(), holding(procedure::Mode::Assessed));
  ASSERT_TRUE(message && message->drill);
  EXPECT_TRUE(message->drill->level);
  EXPECT_TRUE(message->drill->probe_seen);
}

TEST(ScopeMessage, OtherArthroscopiesHaveNoExercises) {
  const cases::CaseData data = with_places();
  const auto message = scope_message(data, arthroscopy(), holding(procedure::Mode::Practice));
  ASSERT_TRUE(message);
  EXPECT_FALSE(message->drill);
}

TEST(ScopeMessage, TellsWhereFloatsWhatIsNotOut) {
  simulation::Snapshot now = holding(procedure::Mode::Assessed);
  now.scope.loose[0] = {2, 1, {1.23456, -2, 3}};
  now.scope.loose_count = 1;
  now.scope.are_closed = {false, true};
  now.scope.facts.loose.out = 1;
  const auto message = scope_message(with_places(), arthroscopy(), now);
  ASSERT_TRUE(message);
  ASSERT_EQ(message->loose.size(), 1U);
  EXPECT_EQ(message->loose[0].lesion, 2);
  EXPECT_EQ(message->loose[0].hand, 1);
  EXPECT_DOUBLE_EQ(message->loose[0].at_mm.x, 1.23);
  EXPECT_EQ(message->jaws_closed, (std::vector<std::int64_t>{0, 1}));
  EXPECT_EQ(message->loose_out, 1);
}

TEST(ScopeMessage, TellsWhereCartilageWasBitten) {
  simulation::Snapshot now = holding(procedure::Mode::Assessed);
  EXPECT_TRUE(scope_message(with_places(), arthroscopy(), now)->scuffs.empty());
  now.scope.scuffs[0] = {0, {1.23456, -2, 3}};
  now.scope.scuff_count = 1;
  const auto message = scope_message(with_places(), arthroscopy(), now);
  ASSERT_TRUE(message);
  ASSERT_EQ(message->scuffs.size(), 1U);
  EXPECT_EQ(message->scuffs[0].joint, with_places().arthroscopy->joints.front().id);
  EXPECT_DOUBLE_EQ(message->scuffs[0].at_mm.x, 1.23);
}

TEST(ScopeMessage, TellsOfFluidWhatPumpAndPictureShow) {
  simulation::Snapshot now = holding(procedure::Mode::Assessed);
  EXPECT_FALSE(scope_message(with_places(), arthroscopy(), now)->fluid) << "there is none";
  now.scope.fluid.is_there = true;
  now.scope.fluid.inflow_steps = 7;
  now.scope.fluid.pressure_mmhg = 25.93;
  now.scope.fluid.haze_per_mm = 0.12345;
  const auto message = scope_message(with_places(), arthroscopy(), now);
  ASSERT_TRUE(message && message->fluid);
  EXPECT_DOUBLE_EQ(message->fluid->inflow_mmhg, 35);
  EXPECT_DOUBLE_EQ(message->fluid->pressure_mmhg, 26);
  EXPECT_DOUBLE_EQ(message->fluid->haze_per_mm, 0.123);
  EXPECT_TRUE(message->fluid->outflow_open);
}

TEST(ScopeMessage, TellsWhatIsLeftToShaveAndHowTheMouthIsHeld) {
  simulation::Snapshot now = holding(procedure::Mode::Assessed);
  now.scope.piece_count = 3;
  now.scope.pieces_left = {100, 42, 0};
  now.scope.mouth_deg = {0.0, -89.6};
  now.scope.are_running = {false, true};
  const auto message = scope_message(with_places(), arthroscopy(), now);
  ASSERT_TRUE(message);
  EXPECT_EQ(message->pieces_left, (std::vector<std::int64_t>{100, 42, 0}));
  EXPECT_EQ(message->mouth_deg, (std::vector<std::int64_t>{0, -90}));
  EXPECT_EQ(message->running, (std::vector<std::int64_t>{0, 1}));
  now.scope.piece_count = 0;
  const auto without = scope_message(with_places(), arthroscopy(), now);
  ASSERT_TRUE(without);
  EXPECT_TRUE(without->pieces_left.empty() && without->mouth_deg.empty());
  EXPECT_TRUE(without->running.empty()) << "nothing is to be shaved";
}

TEST(ScopeMessage, WhatYieldsIsToldAsScannedTheDiscFirstAndThenByHowMuchItIsOff) {
  cases::CaseData data = with_places();
  cases::ArthroscopicMap map = *data.arthroscopy;
  cases::LigamentBand band;
  band.id = "scapholunate";
  band.at = {{1, 2, 3}, {4, 5, 6}};
  map.bands.push_back(band);
  data.arthroscopy = std::make_shared<const cases::ArthroscopicMap>(map);
  const auto plan = arthroscopy_of(data, arthroscopy(), 1);
  ASSERT_EQ(plan->sheets.size(), 2U);
  EXPECT_EQ(plan->sheets[0].kind, protocol::SheetKind::Disc);
  EXPECT_TRUE(plan->sheets[0].places_mm.empty()) << "this wrist has none";
  EXPECT_EQ(plan->sheets[1].id, "scapholunate");
  EXPECT_EQ(plan->sheets[1].kind, protocol::SheetKind::Ligament);
  EXPECT_EQ(plan->sheets[1].places_mm, band.at);
  simulation::Snapshot now;
  now.sheets[1].count = 2;
  EXPECT_TRUE(sheet_message(now, 1).off_um.empty()) << "as scanned";
  now.sheets[1].off[1] = {0, 0, 0.25F};
  const protocol::Sheet off = sheet_message(now, 1);
  EXPECT_EQ(off.sheet, 1);
  EXPECT_EQ(off.off_um, (std::vector<std::int64_t>{0, 0, 0, 0, 0, 250}));
}

TEST(ScopeMessage, TuftsAreToldWhereTheyStand) {
  const cases::CaseData data = with_places();
  procedure::Procedure shaving = arthroscopy();
  shaving.shaving.emplace();
  shaving.shaving->synovium = {{1, 1}, {3, 3}, {16}};
  const auto plan = arthroscopy_of(data, shaving, 1);
  ASSERT_TRUE(plan);
  const auto made = simulation::lesions_of(data, shaving, 1);
  ASSERT_TRUE(made);
  ASSERT_EQ(plan->pieces.size(), 3U);
  for (std::size_t i = 0; i < plan->pieces.size(); ++i) {
    const protocol::TissuePiece& piece = plan->pieces[i];
    EXPECT_EQ(piece.kind, protocol::TissueKind::Synovium);
    EXPECT_EQ(piece.joint, "radiocarpal");
    EXPECT_EQ(piece.body, "radius");
    EXPECT_EQ(piece.at_mm, made->pieces[i].at);
    EXPECT_EQ(piece.inwards, made->pieces[i].inwards);
    EXPECT_EQ(piece.height_mm, made->pieces[i].height_mm);
    EXPECT_FALSE(piece.is_loose) << "of the disc alone";
  }
  EXPECT_TRUE(arthroscopy_of(data, arthroscopy(), 1)->pieces.empty());
}

TEST(ScopeMessage, TheLineOfAnExerciseIsToldPointByPoint) {
  const cases::CaseData data = with_places();
  const auto plan = arthroscopy_of(data, exercises(), 1);
  ASSERT_TRUE(plan && plan->drill);
  EXPECT_EQ(plan->drill->hold, (std::vector<std::int64_t>{2, 7, 11}));
  // From 8 by 11 to 16: 10 mm, a point each, on the wall.
  ASSERT_EQ(plan->drill->line_mm.size(), 11U);
  EXPECT_NEAR(distance(plan->drill->line_mm.front(), {10, 0, 1}), 0, 1e-6);
  EXPECT_NEAR(distance(plan->drill->line_mm.back(), {20, 0, 1}), 0, 1e-6);
}

}  // namespace
}  // namespace carpus::session
