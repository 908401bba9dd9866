// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/simulated_scan.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "case_io/write_volume.hpp"

namespace carpus::cli {
namespace {

namespace fs = std::filesystem;

class SimulatedScan : public ::testing::Test {
 protected:
  SimulatedScan() {
    std::string name = (fs::temp_directory_path() / "carpus-scan-XXXXXX").string();
    root_ = ::mkdtemp(name.data());
    fs::create_directories(folder());
  }
  ~SimulatedScan() override { fs::remove_all(root_); }

  /// Two folders down, so that nothing of other tests is beside it or above.
  [[nodiscard]] fs::path folder() const { return root_ / "study" / "scan"; }
  [[nodiscard]] static Grid<std::int16_t> ct() {
    GridGeometry g;
    g.size = {6, 5, 9};
    g.spacing = {1, 1, 1};
    return Grid<std::int16_t>(g, 40);
  }
  fs::path write(const std::string& name, const std::string& description) const {
    case_io::write_volume<std::int16_t>(folder() / name, ct().view(), description);
    return folder() / name;
  }
  fs::path write_series(const std::string& name, const std::string& description) const {
    case_io::DicomDescription text;
    text.series_description = description;
    case_io::write_dicom_series(folder() / name, ct().view(), text);
    return folder() / name;
  }

 private:
  fs::path root_;
};

TEST_F(SimulatedScan, IsKnownByItsOwnWordsWhereverItIsCopied) {
  for (const char* name : {"ct.nii.gz", "ct.nii", "ct.nrrd", "ct.mha"}) {
    EXPECT_TRUE(is_simulated_scan(write(name, "Simulated wrist, seed 1"))) << name;
  }
  const fs::path series = write_series("series", "simulated wrist, seed 1");
  EXPECT_TRUE(is_simulated_scan(series));
  EXPECT_TRUE(is_simulated_scan(series / "IM_0002.dcm"));
}

TEST_F(SimulatedScan, IsKnownByItsTruthBesideItOrAbove) {
  const fs::path volume = write("ct.nii.gz", "");
  ASSERT_FALSE(is_simulated_scan(volume));
  std::ofstream(folder() / ".." / "truth.json") << "{}";
  EXPECT_TRUE(is_simulated_scan(volume));
  EXPECT_TRUE(is_simulated_scan(folder()));
}

TEST_F(SimulatedScan, IsNotWhatSaysNothingOfTheKind) {
  for (const char* name : {"ct.nii.gz", "ct.nrrd", "ct.mha"}) {
    EXPECT_FALSE(is_simulated_scan(write(name, ""))) << name;
    EXPECT_FALSE(is_simulated_scan(write(name, "wrist 0.6 mm, bone kernel"))) << name;
  }
  EXPECT_FALSE(is_simulated_scan(write_series("series", "wrist")));
}

}  // namespace
}  // namespace carpus::cli
