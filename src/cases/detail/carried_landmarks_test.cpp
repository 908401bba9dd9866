// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/detail/carried_landmarks.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace carpus::cases::detail {
namespace {

/// A bone that is a wedge with its sharp edge along y.
CaseData wedge() {
  CaseData data;
  Bone bone;
  bone.bone = BoneId::Radius;
  bone.surface.vertices = {{0, -5, 0}, {0, 5, 0}, {-10, 0, 1}, {-10, 0, -1}};
  bone.surface.facets = {{0, 1, 2}, {1, 0, 3}, {0, 2, 3}, {1, 3, 2}};
  data.bones.push_back(bone);
  return data;
}

TEST(WristSurfaces, KnowTheSideOfASharpEdgeWhicheverFacetIsNearest) {
  const CaseData data = wedge();
  const WristSurfaces surfaces(data);
  for (const double z : {-0.99, -0.5, 0.0, 0.5, 0.99}) {
    const Vec3 p{std::sqrt(1 - z * z), 0.3, z};  // 1 mm off the edge
    const WristSurfaces::Near near = surfaces.bone_near(p);
    EXPECT_NEAR(near.distance_mm, 1, 1e-9) << z;
    EXPECT_NEAR(dot(near.outwards, p - near.point), 1, 1e-9) << z;
  }
  EXPECT_LT(surfaces.bone_near({-5, 0.3, 0.1}).distance_mm, 0);
  EXPECT_GT(surfaces.bone_near({-5, 0.3, 2}).distance_mm, 0);
}

TEST(WristSurfaces, TakeWhatIsLeftOfCapsAtTheScansFacesForNoSkin) {
  CaseData data = wedge();
  data.skin.vertices = {{0, 0, 0.2}, {20, 0, 0.2}, {0, 20, 0.2}};
  data.skin.facets = {{0, 1, 2}};
  const Vec3 p{5, 5, -1};
  EXPECT_TRUE(WristSurfaces(data).depth_at(p).has_value());  // no CT, no faces
  GridGeometry volume;
  volume.size = {40, 40, 20};
  volume.origin = {-10, -10, 0};
  data.ct = Grid<std::int16_t>(volume);
  EXPECT_FALSE(WristSurfaces(data).depth_at(p).has_value());
}

}  // namespace
}  // namespace carpus::cases::detail
