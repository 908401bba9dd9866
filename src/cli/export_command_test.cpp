// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/export_command.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "case_io/case_folder.hpp"
#include "case_io/read_volume.hpp"
#include "case_io/surface_file.hpp"
#include "cases/synthetic_case_test_support.hpp"
#include "core/error.hpp"

namespace carpus::cli {
namespace {

namespace fs = std::filesystem;

/// One case for all tests; each has a folder of its own for what it writes.
class Export : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    std::string name = (fs::temp_directory_path() / "export_XXXXXX").string();
    shared_folder() = ::mkdtemp(name.data());
    case_io::write_case(data(), shared_folder() / "case");
  }
  static void TearDownTestSuite() {
    std::error_code ignored;
    fs::remove_all(shared_folder(), ignored);
  }
  static const cases::CaseData& data() {
    static const cases::CaseData kData = cases::test::synthetic_case();
    return kData;
  }
  void run(const std::string& out, std::vector<std::string> more = {}) const {
    CLI::App app;
    add_export_command(app);
    std::vector<std::string> words{"export", (shared_folder() / "case").string(), "--out",
                                   written(out).string()};
    words.insert(words.end(), more.begin(), more.end());
    std::reverse(words.begin(), words.end());  // as CLI11 takes them
    app.parse(words);
  }
  [[nodiscard]] static fs::path written(const std::string& name) {
    const fs::path folder =
        shared_folder() / testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::create_directories(folder);
    return folder / name;
  }

 private:
  static fs::path& shared_folder() {
    static fs::path folder;
    return folder;
  }
};

TEST_F(Export, WritesEveryFormatByItsEnding) {
  for (const char* name : {"bones.3mf", "bones.glb", "bones.dcm", "labels.nii.gz", "labels.nrrd"}) {
    run(name);
    EXPECT_GT(fs::file_size(written(name)), 1000U) << name;
  }
  const Grid<std::uint8_t> labels = case_io::read_labels(written("labels.nii.gz"));
  EXPECT_TRUE(std::equal(labels.values().begin(), labels.values().end(),
                         data().labels.values().begin(), data().labels.values().end()));
  run("{}.obj");
  for (const cases::Bone& bone : data().bones) {
    const fs::path file = written(std::string(name_of(bone.bone, bone.part)) + ".obj");
    EXPECT_EQ(case_io::read_surface(file).vertices.size(), bone.surface.vertices.size());
  }
}

TEST_F(Export, OfChosenBonesAloneLeavesTheOthersOut) {
  run("labels.nrrd", {"--bones", "scaphoid"});
  const Grid<std::uint8_t> labels = case_io::read_labels(written("labels.nrrd"));
  for (const std::uint8_t label : labels.values()) ASSERT_TRUE(label == 0 || label == 3);
  EXPECT_NE(std::count(labels.values().begin(), labels.values().end(), 3), 0);
}

TEST_F(Export, SaysWhatItCannotDo) {
  EXPECT_THROW(run("bones.stp"), UsageError);
  EXPECT_THROW(run("bones.stl"), UsageError);
  EXPECT_THROW(run("bones_{}.glb"), UsageError);
  EXPECT_THROW(run("bones.glb", {"--bones", "femur"}), UsageError);
  run("bones.glb");
  EXPECT_THROW(run("bones.glb"), IoError);
  EXPECT_NO_THROW(run("bones.glb", {"--force"}));
}

}  // namespace
}  // namespace carpus::cli
