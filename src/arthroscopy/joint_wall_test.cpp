// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/joint_wall.hpp"

#include <gtest/gtest.h>

#include "arthroscopy/generic_wrist_test_support.hpp"

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
    for (const auto& space : wrist.tissue.spaces) {
      if (space.id != wall.joint) continue;
      EXPECT_NEAR(volume_of(wall.surface), space.volume_mm3, 0.005 * space.volume_mm3);
    }
  }
}

}  // namespace
}  // namespace carpus::arthroscopy
