// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/ground_truth.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <string>

#include "case_io/write_volume.hpp"
#include "core/error.hpp"

namespace carpus::reconstruct {
namespace {

namespace fs = std::filesystem;

class GroundTruthFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("carpus_truth_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
    GridGeometry g;
    g.size = {6, 1, 1};
    Grid<std::uint8_t> labels(g, std::vector<std::uint8_t>{1, 3, 16, 17, 40, 0});
    case_io::write_volume<std::uint8_t>(folder_ / "labels.nii.gz", labels.view());
  }
  void TearDown() override { fs::remove_all(folder_); }
  void write_names(const std::string& text) { std::ofstream(folder_ / "labels.json") << text; }
  [[nodiscard]] std::vector<int> read() const {
    const GroundTruth truth = read_ground_truth(folder_ / "labels.nii.gz");
    return {truth.labels.values().begin(), truth.labels.values().end()};
  }
  fs::path folder_;
};

TEST_F(GroundTruthFile, WithoutNamesHasTheCaseFoldersNumbersAndGapTissueIsNoBone) {
  EXPECT_EQ(read(), (std::vector<int>{1, 3, 16, 0, 0, 0}));
}

TEST_F(GroundTruthFile, TakesItsNumbersFromTheNamesBesideIt) {
  write_names(
      R"({"ulna": 1, "scaphoid": 3, "scaphoid_distal_fragment": 16, "nonunion_gap_tissue": 17,
                 "lunate": 40, "note": "remarks do not count"})");
  EXPECT_EQ(read(), (std::vector<int>{2, 3, 16, 0, 4, 0}));
  write_names(R"({"scaphoid_proximal": 1, "scaphoid_distal": 3})");
  EXPECT_EQ(read(), (std::vector<int>{3, 16, 0, 0, 0, 0}));
}

TEST_F(GroundTruthFile, RefusesNamesThatMakeNoSense) {
  write_names("[1, 2");
  EXPECT_THROW((void)read(), InvalidInput);
  write_names(R"({"radius": 300})");
  EXPECT_THROW((void)read(), InvalidInput);
}

TEST(CompareLabels, GivesDicePerBoneOfTheTruth) {
  GridGeometry g;
  g.size = {8, 1, 1};
  const Grid<std::uint8_t> found(g, std::vector<std::uint8_t>{1, 1, 1, 2, 2, 0, 5, 0});
  const GroundTruth truth{Grid<std::uint8_t>(g, std::vector<std::uint8_t>{1, 1, 2, 2, 2, 2, 0, 7})};
  const auto dice = compare_labels(found.view(), truth);
  ASSERT_EQ(dice.size(), 3U);
  EXPECT_EQ(dice[0].label, 1);
  EXPECT_DOUBLE_EQ(dice[0].dice, 2.0 * 2 / 5);
  EXPECT_DOUBLE_EQ(dice[1].dice, 2.0 * 2 / 6);
  EXPECT_EQ(dice[2].label, 7);
  EXPECT_EQ(dice[2].dice, 0.0);
}

TEST(CompareLabels, RefusesAnotherScansTruth) {
  GridGeometry g;
  g.size = {4, 4, 4};
  const Grid<std::uint8_t> found(g);
  GridGeometry other = g;
  other.origin.z = 1;
  EXPECT_THROW((void)compare_labels(found.view(), {Grid<std::uint8_t>(other)}), InvalidInput);
  other = g;
  other.size[2] = 5;
  EXPECT_THROW((void)compare_labels(found.view(), {Grid<std::uint8_t>(other)}), InvalidInput);
}

}  // namespace
}  // namespace carpus::reconstruct
