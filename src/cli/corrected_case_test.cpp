// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/corrected_case.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "case_io/ply.hpp"
#include "case_io/trust_file.hpp"
#include "case_io/write_volume.hpp"
#include "core/error.hpp"

namespace carpus::cli {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

Grid<std::uint8_t> row_of(std::vector<std::uint8_t> labels) {
  GridGeometry g;
  g.size = {static_cast<int>(labels.size()), 1, 1};
  g.spacing = {0.5, 1, 1};
  return Grid<std::uint8_t>(g, std::move(labels));
}

TEST(CorrectedCase, SaysWhatAPersonChangedBoneByBone) {
  EXPECT_THAT(changes_between(row_of({0, 3, 3, 9}), row_of({0, 3, 3, 9})), IsEmpty());
  EXPECT_THAT(changes_between(row_of({0, 0, 3, 9, 9}), row_of({3, 3, 3, 0, 3})),
              ElementsAre("scaphoid: 1.5 mm3 added, 0.0 mm3 taken away",
                          "capitate: 0.0 mm3 added, 1.0 mm3 taken away"));
  EXPECT_THAT(changes_between(row_of({3, 16}), row_of({16, 16})),
              ElementsAre("scaphoid_proximal: 0.0 mm3 added, 0.5 mm3 taken away",
                          "scaphoid_distal: 0.5 mm3 added, 0.0 mm3 taken away"));
}

TEST(CorrectedCase, KeepsWhereTheEarlierOneCameFrom) {
  const fs::path folder =
      fs::temp_directory_path() / ("carpus_earlier_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  EXPECT_FALSE(is_case_folder(folder));
  std::ofstream(folder / "ct.nii.gz") << "scan";
  std::ofstream(folder / "case.json")
      << R"({"pseudonym": "demo", "provenance": {"simulated": true, "source": "a CT", "conventions": ["x"]}})";
  case_io::write_volume<std::uint8_t>(folder / "labels.nii.gz", row_of({1, 2}).view());
  ASSERT_TRUE(is_case_folder(folder));
  const EarlierCase earlier = read_earlier_case(folder);
  EXPECT_EQ(earlier.pseudonym, "demo");
  EXPECT_EQ(earlier.id, folder.filename().string());
  EXPECT_EQ(read_earlier_case(folder / "").id, earlier.id);
  const fs::path named = folder.string() + " Doe, Jane";
  fs::copy(folder, named);
  EXPECT_EQ(read_earlier_case(named).id, "");
  fs::remove_all(named);
  EXPECT_TRUE(earlier.provenance.simulated);
  EXPECT_EQ(earlier.provenance.source, "a CT");
  EXPECT_EQ(earlier.provenance.conventions.size(), 1U);
  EXPECT_EQ(earlier.version.labels[1], 2);
  EXPECT_THAT(earlier.version.bones, IsEmpty());
  fs::create_directory(folder / "bones");
  for (const char* bone : {"radius", "ulna"}) {
    TriangleMesh mesh;
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.facets = {{0, 1, 2}};
    case_io::write_ply(folder / "bones" / (std::string(bone) + ".ply"), mesh);
  }
  std::ofstream(folder / case_io::kTrustFile)
      << case_io::trust_text({{{"ulna", 0.25, true, "it is hollow"}}}, "carpus");
  const EarlierCase doubted = read_earlier_case(folder);
  ASSERT_EQ(doubted.version.bones.size(), 2U);
  EXPECT_FALSE(doubted.version.bones[0].trust);
  ASSERT_TRUE(doubted.version.bones[1].trust);
  EXPECT_TRUE(doubted.version.bones[1].trust->flagged);
  EXPECT_EQ(doubted.version.bones[1].trust->confidence, 0.25);
  EXPECT_EQ(doubted.version.bones[1].trust->why, "it is hollow");
  std::ofstream(folder / "case.json") << R"({"pseudonym": "demo", "provenance": {"simulated": 1}})";
  EXPECT_THROW((void)read_earlier_case(folder), InvalidInput);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace carpus::cli
