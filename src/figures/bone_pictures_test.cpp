// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "figures/bone_pictures.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace carpus::figures {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A closed tetrahedron about a point of Patient [mm].
cases::Bone tetrahedron(BoneId id, const Vec3& at, BonePart part = BonePart::Whole) {
  cases::Bone bone;
  bone.bone = id;
  bone.part = part;
  TriangleMesh mesh{{at, at + Vec3{4, 0, 0}, at + Vec3{0, 4, 0}, at + Vec3{0, 0, 4}},
                    {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}}};
  bone.surface = MeshIn<frame::Bone>(std::move(mesh));
  return bone;
}

cases::CaseData broken_wrist() {
  cases::CaseData data;
  data.bones.push_back(tetrahedron(BoneId::Radius, {30, 0, 0}));  // Wrist is Patient; +x proximal
  data.bones.push_back(tetrahedron(BoneId::Scaphoid, {0, 0, 0}, BonePart::Proximal));
  data.bones.push_back(tetrahedron(BoneId::Scaphoid, {-8, 0, 0}, BonePart::Distal));
  return data;
}

double highest(const TriangleMesh& mesh) {
  return std::max_element(mesh.vertices.begin(), mesh.vertices.end(),
                          [](const Vec3& a, const Vec3& b) { return a.z < b.z; })
      ->z;
}

TEST(BonePictures, ABrokenBoneIsOneAndTheFingersPointUp) {
  const auto bones = drawn_bones(broken_wrist());
  ASSERT_EQ(bones.size(), 2U);
  EXPECT_EQ(bones[0].bone, BoneId::Radius);
  EXPECT_EQ(bones[1].surface.facets.size(), 8U);
  EXPECT_EQ(check_surface(bones[1].surface), SurfaceStatus::Ok) << "turned, never mirrored";
  EXPECT_GT(volume_of(bones[1].surface), 0);
  EXPECT_EQ(highest(bones[0].surface), -30);
  EXPECT_EQ(highest(bones[1].surface), 8);
  EXPECT_EQ(outline_points(bones[1], 4).size(), 4U);
}

TEST(BonePictures, TheMarkedBoneHasAnArrowAndAColour) {
  const auto bones = drawn_bones(broken_wrist());
  const BoneId scaphoid = BoneId::Scaphoid;
  const std::string marked = draw_wrist(bones, WristSide::Volar, Facets::Shaded, &scaphoid);
  const std::string plain = draw_wrist(bones, WristSide::Volar);
  EXPECT_THAT(marked, HasSubstr("#c4161c"));
  EXPECT_THAT(plain, Not(HasSubstr("#c4161c")));
  EXPECT_NE(draw_wrist(bones, WristSide::Dorsal), plain);
  EXPECT_THAT(draw_wrist(bones, WristSide::Dorsal, Facets::Outlined),
              HasSubstr("stroke=\"#3a3226\""));
}

TEST(BonePictures, TexturedFacetsTakeTheirColourFromTheBitmap) {
  const auto data = broken_wrist();
  const auto bones = drawn_bones(data);
  EXPECT_EQ(bones[1].texture.size(), bones[1].surface.facets.size());
  EXPECT_NE(draw_wrist(bones, WristSide::Dorsal, Facets::Textured),
            draw_wrist(bones, WristSide::Dorsal));
  const std::string mapping = draw_texture_mapping(data.bones[0], data.ct.view());
  EXPECT_THAT(mapping, HasSubstr("128 x 128 texels"));
}

TEST(BonePictures, HullsStandBesideAndAboutTheirBones) {
  const auto bones = drawn_bones(broken_wrist());
  const std::string rows = draw_bones_and_hulls({&bones[0], &bones[1]});
  EXPECT_THAT(rows, HasSubstr("Radius, 4 facets"));
  EXPECT_THAT(rows, HasSubstr("Scaphoid, 8 facets"));
  EXPECT_THAT(rows, HasSubstr("its convex hull, "));
  EXPECT_THAT(draw_bones_in_hulls({&bones[0], &bones[1]}), HasSubstr("(b) Scaphoid"));
}

}  // namespace
}  // namespace carpus::figures
