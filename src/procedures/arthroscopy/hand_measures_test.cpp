// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedures/arthroscopy/hand_measures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "instruments/instrument.hpp"

namespace carpus::procedures::arthroscopy {
namespace {

using procedure::CartilageScuff;
using procedure::Scuffing;

cases::CaseData two_bones() {
  cases::CaseData data;
  data.bones.resize(2);
  data.bones[0].bone = BoneId::Radius;
  data.bones[1].bone = BoneId::Lunate;
  return data;
}

procedure::ScopeRecord scuffed() {
  const auto probe = *instruments::instrument_of("hook_probe");
  procedure::ScopeRecord scope;
  scope.entries = 1;
  scope.scuff_places = {{100, 1, {1, 2, 3}, 8.5, probe, Scuffing::Pressed},
                        {200, 1, {1, 2, 4}, 9.1, probe, Scuffing::Pressed},
                        {300, 0, {5, 6, 7}, 0, probe, Scuffing::Bitten}};
  scope.scuffs = 5;
  return scope;
}

TEST(HandMeasures, SmoothnessIsTheMeanOfTheStretchesLogarithms) {
  const double octaves = 12 * std::log(2.0);
  const auto measure = smoothness("scope_smoothness", {1.5, 120, 10});
  ASSERT_TRUE(measure.value.has_value());
  EXPECT_NEAR(*measure.value, -(octaves + std::log(1.5) / 10), 1e-12);
  EXPECT_NE(measure.finding.find("10 stretches"), std::string::npos) << measure.finding;
}

TEST(HandMeasures, WhoHardlyMovedShowsNoSmoothHand) {
  EXPECT_FALSE(smoothness("scope_smoothness", {}).value.has_value());
  EXPECT_FALSE(smoothness("scope_smoothness", {1.5, 69, kLeastStretches - 1}).value.has_value());
}

TEST(HandMeasures, ScuffsAreToldByBoneWithTheWorstOfEach) {
  const auto measure = cartilage_scuffs(two_bones(), scuffed());
  EXPECT_EQ(measure.value, 5.0) << "also those whose places were not kept";
  EXPECT_NE(measure.finding.find("radius, 1 place, bitten"), std::string::npos) << measure.finding;
  EXPECT_NE(measure.finding.find("lunate, 2 places, pressed with up to 9.1 N"), std::string::npos)
      << measure.finding;
  procedure::ScopeRecord none;
  EXPECT_FALSE(cartilage_scuffs(two_bones(), none).value.has_value()) << "no scope went in";
  none.entries = 1;
  EXPECT_EQ(cartilage_scuffs(two_bones(), none).value, 0.0);
}

TEST(HandMeasures, TheReportHasThePlacesWithBoneAndInstrument) {
  procedure::OperationRecord record;
  record.scope = scuffed();
  record.scope->scuff_places.push_back({400, 7, {}, 9, 0, Scuffing::Pressed});
  procedure::ScoreReport report;
  tell_scuffs(report, two_bones(), record);
  ASSERT_EQ(report.scuffs.size(), 3U) << "of bones that there are";
  EXPECT_EQ(report.scuffs[1].bone, BoneId::Lunate);
  EXPECT_EQ(report.scuffs[1].scuff, scuffed().scuff_places[1]);
  EXPECT_EQ(report.scuffs[1].instrument,
            instruments::catalogue()[*instruments::instrument_of("hook_probe")].name);
}

}  // namespace
}  // namespace carpus::procedures::arthroscopy
