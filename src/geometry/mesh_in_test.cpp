// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "geometry/mesh_in.hpp"

#include <gtest/gtest.h>

#include <type_traits>

namespace carpus {
namespace {

using OfBone = MeshIn<frame::Bone>;
using OfPatient = MeshIn<frame::Patient>;

static_assert(!std::is_convertible_v<OfBone, OfPatient>);
static_assert(!std::is_assignable_v<OfPatient&, OfBone>);
static_assert(!std::is_assignable_v<OfPatient&, TriangleMesh>, "its frame must be said");
static_assert(std::is_convertible_v<const OfBone&, const TriangleMesh&>);

TEST(MeshIn, ComesIntoAnotherFrameByAPose) {
  const OfBone bone(TriangleMesh{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}}});
  const Pose<frame::Patient, frame::Bone> lifted{{}, {0, 0, 5}};
  const OfPatient moved = lifted * bone;
  EXPECT_EQ(moved.vertices[0], (Vec3{1, 0, 5}));
  EXPECT_EQ(moved.facets, bone.facets);
}

}  // namespace
}  // namespace carpus
