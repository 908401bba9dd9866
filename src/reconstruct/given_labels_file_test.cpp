// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/given_labels_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <vector>

#include "case_io/dicom_segmentation.hpp"
#include "case_io/write_volume.hpp"
#include "core/error.hpp"

namespace carpus::reconstruct {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class GivenLabelsFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("carpus_given_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
    GridGeometry g;
    g.size = {6, 1, 1};
    labels_ = Grid<std::uint8_t>(g, std::vector<std::uint8_t>{1, 3, 16, 17, 40, 0});
    case_io::write_volume<std::uint8_t>(folder_ / "mine.nii.gz", labels_.view());
  }
  void TearDown() override { fs::remove_all(folder_); }
  [[nodiscard]] fs::path names(const std::string& text) const {
    std::ofstream(folder_ / "names.json") << text;
    return folder_ / "names.json";
  }
  [[nodiscard]] std::vector<int> read(const fs::path& file, const fs::path& names = {}) {
    warned_.clear();
    const Grid<std::uint8_t> labels =
        read_given_labels(folder_ / file, names, labels_.geometry(),
                          [this](const std::string& text) { warned_.push_back(text); });
    return {labels.values().begin(), labels.values().end()};
  }
  [[nodiscard]] std::string refusal(const fs::path& names) {
    try {
      (void)read("mine.nii.gz", names);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
  fs::path folder_;
  Grid<std::uint8_t> labels_;
  std::vector<std::string> warned_;
};

TEST_F(GivenLabelsFile, HasTheCaseFoldersNumbersWithoutNamesAndSaysWhatItLeavesOut) {
  EXPECT_THAT(read("mine.nii.gz"), ElementsAre(1, 3, 16, 0, 0, 0));
  EXPECT_THAT(warned_, ElementsAre(HasSubstr("number 17"), HasSubstr("number 40")));
}

TEST_F(GivenLabelsFile, TakesTheNamesThatAreGiven) {
  EXPECT_THAT(read("mine.nii.gz", names(R"({"capitate": 1, "radius": 40})")),
              ElementsAre(9, 0, 0, 0, 1, 0));
  EXPECT_EQ(warned_.size(), 3U);
}

TEST_F(GivenLabelsFile, RefusesNamesThatCouldMeanAnotherBone) {
  EXPECT_THAT(refusal(names(R"({"capitat": 1})")), HasSubstr("no bone 'capitat'"));
  EXPECT_THAT(refusal(names(R"({"capitate": 0})")), HasSubstr("from 1 to 255"));
  EXPECT_THAT(refusal(names(R"({"capitate": "1"})")), HasSubstr("from 1 to 255"));
  EXPECT_THAT(refusal(names(R"({"capitate": 1, "hamate": 1})")), HasSubstr("two bones"));
  EXPECT_THAT(refusal(names(R"({"capitate": 99})")), HasSubstr("none of its numbers"));
  EXPECT_NE(refusal(names("[1, 2")), "");
  EXPECT_NE(refusal(names(std::string(70000, ' '))), "");
  EXPECT_NE(refusal(folder_), "");
}

TEST_F(GivenLabelsFile, KnowsTheSegmentsOfADicomSegmentationByTheirNames) {
  case_io::write_dicom_segmentation(folder_ / "mine.dcm", labels_.view(),
                                    {{1, "Hamate"}, {3, "Metacarpal 3"}, {16, "tumour"}},
                                    {"demo", true, "carpus"});
  EXPECT_THAT(read("mine.dcm"), ElementsAre(10, 13, 0, 0, 0, 0));
  EXPECT_THAT(warned_, ElementsAre(HasSubstr("number 3")));
  EXPECT_THAT(read("mine.dcm", names(R"({"lunate": 3})")), ElementsAre(0, 0, 4, 0, 0, 0));
}

}  // namespace
}  // namespace carpus::reconstruct
