// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/keep_untouched.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace carpus::reconstruct {
namespace {

using ::testing::ElementsAre;

Grid<std::uint8_t> row_of(std::vector<std::uint8_t> labels) {
  GridGeometry g;
  g.size = {static_cast<int>(labels.size()), 1, 1};
  return Grid<std::uint8_t>(g, std::move(labels));
}

/// A triangle that is known again by where it lies.
TriangleMesh mesh_at(double x) {
  TriangleMesh mesh;
  mesh.vertices = {{x, 0, 0}, {x, 1, 0}, {x, 0, 1}};
  mesh.facets = {{0, 1, 2}};
  return mesh;
}

cases::Bone bone_of(std::uint8_t label) {
  cases::Bone bone;
  bone.label = label;
  bone.surface = MeshIn<frame::Bone>(mesh_at(100 + label));
  return bone;
}

TEST(KeepUntouched, OnlyBonesWhoseVoxelsWereChangedAreMadeAnew) {
  // A voxel went from bone 3 to bone 9; bone 1 is as it was, bone 7 has no earlier surface.
  const EarlierVersion earlier{row_of({1, 1, 0, 3, 3, 3, 9, 7}),
                               {{1, mesh_at(1)}, {3, mesh_at(3)}, {9, mesh_at(9)}}};
  const Grid<std::uint8_t> given = row_of({1, 1, 0, 3, 3, 9, 9, 7});
  cases::CaseData data;
  for (const int label : {1, 3, 7, 9}) {
    data.bones.push_back(bone_of(static_cast<std::uint8_t>(label)));
  }
  // As the surfaces made anew have it: bone 1 lost a voxel to 3 and won one at its side.
  data.labels = row_of({3, 1, 1, 3, 0, 9, 9, 7});
  const auto kept = keep_untouched(earlier, given, data);
  EXPECT_TRUE(kept[1]);
  EXPECT_FALSE(kept[3] || kept[7] || kept[9]);
  EXPECT_THAT(data.labels.values(), ElementsAre(1, 1, 0, 3, 0, 9, 9, 7));
  std::vector<double> lies_at;
  for (const cases::Bone& bone : data.bones) lies_at.push_back(bone.surface.vertices[0].x);
  EXPECT_THAT(lies_at, ElementsAre(1, 103, 107, 109));
}

TEST(KeepUntouched, ABoneIsLeftAloneWhereNothingChangedWithinOneAndAHalfMillimetres) {
  // Voxels of 1 mm: the change of bone 9 reaches two of them.
  const Grid<std::uint8_t> before = row_of({1, 0, 0, 9, 9, 9, 0, 3, 0, 0});
  const auto alone = left_alone(before, row_of({1, 0, 0, 9, 9, 0, 0, 3, 0, 0}));
  EXPECT_TRUE(alone[1]);
  EXPECT_FALSE(alone[9]);
  EXPECT_FALSE(alone[3]);
  EXPECT_TRUE(left_alone(before, before)[9]);
  // A bone that was not there before, over the border of the grid.
  EXPECT_FALSE(left_alone(before, row_of({1, 0, 0, 9, 9, 9, 0, 3, 0, 7}))[7]);
}

}  // namespace
}  // namespace carpus::reconstruct
