// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/segmentation_study.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "core/error.hpp"

namespace carpus::cli {
namespace {

StudiedBone bone(double dice, double confidence, bool is_found = true) {
  return {3, dice, is_found, {}, {confidence, confidence < reconstruct::kTrustedConfidence, "why"}};
}

/// Of four that went wrong one is silent; of two that went well one is flagged.
SegmentationStudy small_study() {
  SegmentationStudy study;
  StudiedScan odd;
  odd.seed = 1;
  odd.bones = {bone(0.9, 0.1), bone(0.8, 0.9), bone(0.99, 0.95)};
  StudiedScan even;
  even.seed = 2;
  even.difficulty = 1;
  even.bones = {bone(0, 0, false), bone(0.5, 0.2), bone(0.98, 0.4)};
  study.scans = {odd, even};
  return study;
}

TEST(SegmentationStudy, CountsWhatWasToldAndWhatWasNot) {
  const auto study = small_study();
  const FlagFigures all = figures_of(study.scans, [](const auto&) { return true; });
  EXPECT_EQ(all.bones, 6U);
  EXPECT_EQ(all.wrong, 4U);
  EXPECT_EQ(all.told, 3U);
  EXPECT_EQ(all.false_alarms, 1U);
  EXPECT_NEAR(all.detection(), 0.75, 1e-12);
  EXPECT_NEAR(all.false_alarm_rate(), 0.5, 1e-12);
  EXPECT_EQ(all.wrong_found, 3U);
  EXPECT_EQ(all.flagged, 2U);
  EXPECT_NEAR(*all.auc, 5.0 / 6, 1e-12);
  EXPECT_EQ(figures_of(study.scans, [](const auto& s) { return s.seed == 1; }).bones, 3U);
  EXPECT_EQ(figures_of(study.scans, [](const auto& s) { return s.difficulty == 1; }).wrong, 2U);
  EXPECT_FALSE(figures_of(study.scans, [](const auto& s) { return s.difficulty == 3; }).auc);
}

TEST(SegmentationStudy, EachDifficultyMeetsEachSizeOfVoxel) {
  std::set<std::pair<int, double>> met;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    met.insert({static_cast<int>(seed / 2 % kDifficulties), study_voxel_mm(seed)});
  }
  EXPECT_EQ(met.size(), 4U * kDifficulties);
}

TEST(SegmentationStudy, NamesTheSilentOnesAndDrawsEachBone) {
  const auto study = small_study();
  EXPECT_NE(segmentation_study_text(study).find("silent: seed 1 scaphoid"), std::string::npos);
  const auto json = nlohmann::json::parse(segmentation_study_json(study));
  EXPECT_EQ(json["all"]["told"], 3);
  EXPECT_EQ(json["scans"][1]["bones"][0]["flagged"], true);
  EXPECT_EQ(json["scans"][0]["bones"][0]["concerns"].size(), json["concerns"].size());
  EXPECT_NE(segmentation_study_picture(study).find("<svg"), std::string::npos);
}

TEST(SegmentationStudy, GoesOnFromItsRowsWhereverItWasStopped) {
  SegmentationStudy study = small_study();
  study.scans[0].conditions = {"metal 0.40"};
  study.scans[0].voxel_mm = 0.7;
  study.scans[0].bones[0].evidence.contact = 0.25;
  const std::string rows = row_of(study.scans[0]) + row_of(study.scans[1]);
  const SegmentationStudy again = study_of_rows(rows, "rows");
  ASSERT_EQ(again.scans.size(), 2U);
  EXPECT_EQ(again.scans[0].voxel_mm, 0.7);
  EXPECT_EQ(again.scans[0].conditions, study.scans[0].conditions);
  EXPECT_EQ(again.scans[0].bones[0].evidence.contact, 0.25);
  EXPECT_EQ(again.scans[1].difficulty, 1);
  EXPECT_FALSE(again.scans[1].bones[0].is_found);
  EXPECT_EQ(row_of(again.scans[0]) + row_of(again.scans[1]), rows);
  EXPECT_EQ(study_of_rows(rows.substr(0, rows.size() - 9), "rows").scans.size(), 1U);
  EXPECT_THROW((void)study_of_rows("half\n" + rows, "rows"), InvalidInput);
}

}  // namespace
}  // namespace carpus::cli
