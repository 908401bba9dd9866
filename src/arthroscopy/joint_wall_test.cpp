// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/joint_wall.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <vector>

#include "arthroscopy/generic_wrist_test_support.hpp"
#include "fields/triangle_tree.hpp"
#include "mesh/genus.hpp"

namespace carpus::arthroscopy {
namespace {

TEST(JointWall, OfBothJointsIsClosedAndDrawnInTime) {
  const test::GenericWrist& wrist = test::generic_wrist();
  const std::vector<JointWall> walls = make_joint_walls(wrist.data, wrist.tissue);
  ASSERT_EQ(walls.size(), 2U);
  for (const JointWall& wall : walls) {
    EXPECT_EQ(check_surface(wall.surface), SurfaceStatus::Ok) << wall.joint;
    EXPECT_LE(wall.surface.facets.size(), 13500U) << wall.joint;
    EXPECT_LT(wall.simplified_by_mm, 0.03) << wall.joint;
    const std::size_t count = wall.surface.vertices.size();
    EXPECT_EQ(wall.lining.size(), count);
    EXPECT_EQ(wall.fibre.size(), count);
    EXPECT_EQ(wall.proximal.size(), count);
    EXPECT_EQ(wall.distal.size(), count);
    EXPECT_EQ(wall.distal_share.size(), count);
    EXPECT_EQ(wall.carried.size(), count);
    for (const auto& space : wrist.tissue.spaces) {
      if (space.id != wall.joint) continue;
      EXPECT_NEAR(volume_of(wall.surface), space.volume_mm3, 0.005 * space.volume_mm3);
    }
  }
}

TEST(JointWall, BonesThatTouchedInTheScanAreBridgedByNothing) {
  const test::GenericWrist& wrist = test::generic_wrist();
  std::size_t parted = 0;
  for (const JointWall& wall : make_joint_walls(wrist.data, wrist.tissue)) {
    for (const auto& space : wrist.tissue.spaces) {
      if (space.id != wall.joint) continue;
      EXPECT_EQ(mesh::genus_of(wall.surface),
                mesh::genus_of(space.surface) - static_cast<int>(wall.parted));
    }
    parted += wall.parted;
  }
  EXPECT_GT(parted, 0U);
}

/// Distance fields end at 4 mm: what lies beyond them went with the first bone of the row, apart
/// from all about it.
TEST(JointWall, EachPlaceGoesWithTheBoneOfItsRowThatIsNearest) {
  const test::GenericWrist& wrist = test::generic_wrist();
  const auto& bones = wrist.data.bones;
  std::vector<fields::TriangleTree> trees;
  for (const cases::Bone& bone : bones) trees.emplace_back(bone.surface);
  constexpr double kNearlyMm = 1.0;  // fields are coarse, and what was cut through is smoothed
  const auto nearest_mm = [&](const Vec3& at, std::initializer_list<BoneId> row) {
    double least = 1e9;
    for (std::size_t b = 0; b < bones.size(); ++b) {
      if (std::find(row.begin(), row.end(), bones[b].bone) == row.end()) continue;
      least = std::min(least, std::sqrt(trees[b].nearest(at)->squared_distance));
    }
    return least;
  };
  std::size_t far = 0;
  for (const JointWall& wall : make_joint_walls(wrist.data, wrist.tissue)) {
    std::size_t wrong = 0;
    const bool is_midcarpal = wall.joint == "midcarpal";
    for (std::size_t v = 0; v < wall.surface.vertices.size(); ++v) {
      const Vec3& at = wall.surface.vertices[v];
      const double row_mm = nearest_mm(at, {BoneId::Scaphoid, BoneId::Lunate, BoneId::Triquetrum});
      const std::uint8_t body = is_midcarpal ? wall.proximal[v] : wall.distal[v];
      const double own_mm = std::sqrt(trees[body].nearest(at)->squared_distance);
      if (own_mm > row_mm + kNearlyMm) ++wrong;
      if (row_mm > 4.0) ++far;
    }
    EXPECT_EQ(wrong, 0U) << wall.joint;
  }
  EXPECT_GT(far, 0U);
}

/// With the nearest bone alone, neighbours that go with different ones tore apart as these parted.
TEST(JointWall, NoFacetIsTornWhereScaphoidAndLunatePart) {
  const test::GenericWrist& wrist = test::generic_wrist();
  const auto& bones = wrist.data.bones;
  const auto share_of = [&](const Carried& one, BoneId bone) {
    float sum = 0;
    for (std::size_t k = 0; k < Carried::kMost; ++k) {
      if (one.share[k] > 0 && bones[one.body[k]].bone == bone) sum += one.share[k];
    }
    return sum;
  };
  for (const JointWall& wall : make_joint_walls(wrist.data, wrist.tissue)) {
    std::size_t edges = 0;
    std::size_t torn = 0;
    float whole = 0;
    for (const Triangle& t : wall.surface.facets) {
      for (std::size_t k = 0; k < 3; ++k) {
        const float a = share_of(wall.carried[t[k]], BoneId::Scaphoid);
        const float b = share_of(wall.carried[t[(k + 1) % 3]], BoneId::Scaphoid);
        ++edges;
        torn += std::abs(a - b) > 0.7F ? 1 : 0;
        whole = std::max(whole, a);
      }
    }
    EXPECT_GT(whole, 0.99F) << wall.joint;  // on the scaphoid it goes with that alone
    EXPECT_EQ(torn, 0U) << wall.joint << " of " << edges;
  }
}

TEST(JointWall, FibresRunOnFromVertexToVertexOfALigament) {
  const test::GenericWrist& wrist = test::generic_wrist();
  std::size_t woven = 0;
  for (const JointWall& wall : make_joint_walls(wrist.data, wrist.tissue)) {
    for (const Triangle& t : wall.surface.facets) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 a = wall.fibre[t[k]];
        const Vec3 b = wall.fibre[t[(k + 1) % 3]];
        if (a.z < 0.9 || b.z < 0.9) continue;
        ++woven;
        const double apart_mm =
            distance(wall.surface.vertices[t[k]], wall.surface.vertices[t[(k + 1) % 3]]);
        // Strands fan out, and their ends lie a stretch apart.
        EXPECT_LT(std::hypot(a.x - b.x, a.y - b.y), 4 * apart_mm + 1.5);
      }
    }
    for (std::size_t v = 0; v < wall.fibre.size(); ++v) {
      EXPECT_GE(wall.fibre[v].z, 0);
      EXPECT_LE(wall.fibre[v].z, 1);
    }
  }
  EXPECT_GT(woven, 1000U);
}

}  // namespace
}  // namespace carpus::arthroscopy
