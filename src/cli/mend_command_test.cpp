// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A small case, one of its bones painted, and the files that come of it.
#include "cli/mend_command.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "case_io/case_folder.hpp"
#include "case_io/read_volume.hpp"
#include "case_io/write_volume.hpp"
#include "cases/synthetic_case_test_support.hpp"
#include "core/error.hpp"

namespace carpus::cli {
namespace {

namespace fs = std::filesystem;

class Mend : public testing::Test {
 protected:
  Mend() : data_(cases::test::synthetic_case()) {
    std::string name = (fs::temp_directory_path() / "mend_XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    case_io::write_case(data_, folder_ / "case");
  }
  ~Mend() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  void run(std::vector<std::string> more) const {
    CLI::App app;
    add_mend_command(app);
    std::vector<std::string> words{"mend",     (folder_ / "case").string(),
                                   "--labels", (folder_ / "painted.nii.gz").string(),
                                   "--out",    (folder_ / "out").string()};
    words.insert(words.end(), more.begin(), more.end());
    std::reverse(words.begin(), words.end());  // as CLI11 takes them
    app.parse(words);
  }
  void paint(const Grid<std::uint8_t>& labels) const {
    case_io::write_volume<std::uint8_t>(folder_ / "painted.nii.gz", labels.view());
  }
  [[nodiscard]] nlohmann::json told() const {
    std::ifstream file(folder_ / "out" / "mended.json");
    return nlohmann::json::parse(file);
  }
  cases::CaseData data_;
  fs::path folder_;
};

TEST_F(Mend, MakesTheBonesThatWerePaintedAndNoOther) {
  const std::uint8_t label = data_.bones.front().label;
  Grid<std::uint8_t> labels = data_.labels;
  const int middle = labels.geometry().size[0] / 2;
  std::size_t taken = 0;
  for (std::size_t i = 0; i < labels.values().size() && taken < 5; ++i) {
    if (labels[i] != label || labels.geometry().index_of(i).x > middle) continue;
    labels[i] = 0;
    ++taken;
  }
  ASSERT_GT(taken, 0U);
  paint(labels);
  run({});
  ASSERT_EQ(told()["bones"].size(), 1U);
  EXPECT_EQ(told()["bones"][0]["label"], label);
  EXPECT_GT(told()["bones"][0]["volume_mm3"], 0);
  EXPECT_TRUE(fs::exists(folder_ / "out" / "bones.glb"));
  EXPECT_FALSE(fs::exists(folder_ / "out" / "labels.nii.gz"));
  EXPECT_THROW(run({}), IoError) << "the folder exists";
  run({"--grow", "--force"});
  const Grid<std::uint8_t> grown = case_io::read_labels(folder_ / "out" / "labels.nii.gz");
  for (std::size_t i = 0; i < grown.values().size(); ++i) {
    if (data_.labels[i] != label && data_.labels[i] != 0) {
      ASSERT_EQ(grown[i], data_.labels[i]);
    }
  }
}

TEST_F(Mend, RefusesLabelsThatAreAsTheyWereAndWhatIsNoCase) {
  paint(data_.labels);
  EXPECT_THROW(run({}), InvalidInput);
  fs::remove(folder_ / "case" / "case.json");
  EXPECT_THROW(run({}), InvalidInput);
}

}  // namespace
}  // namespace carpus::cli
