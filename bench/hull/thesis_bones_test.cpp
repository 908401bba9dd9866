// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/hull/thesis_bones.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>

#include "case_io/ply.hpp"
#include "core/error.hpp"

namespace carpus::bench {
namespace {

namespace fs = std::filesystem;

/// Two bones of a few vertices: one of the wrist, one of the knee.
const std::array<ThesisRow, 2> kTable{{
    {.name = "Hamate", .surface = "hamate", .model = BoneId::Hamate, .vertices = 300},
    {.name = "Patella", .surface = "patella", .model = BoneId::Pisiform, .vertices = 300},
}};

class ThesisBones : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  void put_tetrahedron(const char* name) const {
    case_io::write_ply(folder_ / name, {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                        {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}});
  }

  fs::path folder_ =
      fs::temp_directory_path() / ("carpus_thesis_bones_" + std::to_string(::getpid()));
};

TEST_F(ThesisBones, AMissingFolderIsAnErrorAndNotTheParametricWrist) {
  EXPECT_THROW((void)thesis_bones(kTable, folder_ / "missing"), IoError);
}

TEST_F(ThesisBones, AFolderWithoutAnyOfTheBonesIsAnError) {
  put_tetrahedron("radius.ply");
  EXPECT_THROW((void)thesis_bones(kTable, folder_), IoError);
}

TEST_F(ThesisBones, WithoutAFolderTheModelIsWhatWasAskedForButNoKnee) {
  const std::vector<PointSet> bones = thesis_bones(kTable, {});
  EXPECT_EQ(bones[0].name, "Hamate");
  EXPECT_FALSE(bones[0].origin.is_stand_in);
  EXPECT_TRUE(has_thesis_count(bones[0].origin, bones[0].points.size()));
  EXPECT_EQ(bones[0].origin.surface_facets, 2 * bones[0].points.size() - 4);
  EXPECT_TRUE(bones[1].origin.is_stand_in);
  EXPECT_EQ(bones[1].origin.source, "pisiform of the parametric wrist (simulated)");
}

TEST_F(ThesisBones, WhatTheFolderLacksIsSaidAndSoIsACountNotReached) {
  put_tetrahedron("hamate.ply");
  const std::vector<PointSet> bones = thesis_bones(kTable, folder_);
  EXPECT_EQ(note_on(bones[0].origin, 4), "4 vertices for the thesis's 300");
  EXPECT_EQ(note_on(bones[1].origin, 300),
            "pisiform of the parametric wrist (simulated) stands for it");
}

TEST_F(ThesisBones, ABonesOwnSurfaceComesBeforeItsStandIn) {
  put_tetrahedron("pisiform.ply");
  EXPECT_EQ(thesis_bones(kTable, folder_)[1].origin.source, "pisiform.ply");
  EXPECT_TRUE(thesis_bones(kTable, folder_)[1].origin.is_stand_in);
  put_tetrahedron("patella.ply");
  EXPECT_EQ(thesis_bones(kTable, folder_)[1].origin.source, "patella.ply");
  EXPECT_FALSE(thesis_bones(kTable, folder_)[1].origin.is_stand_in);
}

}  // namespace
}  // namespace carpus::bench
