// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "soft_tissue/overlaps.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "fields/surface_test_support.hpp"
#include "soft_tissue/make_soft_tissue.hpp"
#include "soft_tissue/model_case_test_support.hpp"

namespace carpus::soft_tissue {
namespace {

using ::testing::IsEmpty;

TriangleMesh ball(const Vec3& middle, double radius_mm) {
  const Aabb box{middle - Vec3{1, 1, 1} * (radius_mm + 1),
                 middle + Vec3{1, 1, 1} * (radius_mm + 1)};
  return test::surface_of(box, [&](const Vec3& p) { return distance(p, middle) - radius_mm; });
}

/// A plate of 20 by 20 mm, and so thick.
TriangleMesh plate(double low_mm, double high_mm) {
  return fields::test::box({-10, -10, low_mm}, {10, 10, high_mm});
}

TEST(DepthBetween, IsThatOfTheDeepestPlaceWhicheverIsAskedFirst) {
  constexpr double kErrorMm = 0.1;  // of balls made of voxels
  const TriangleMesh a = ball({0, 0, 0}, 5);
  for (const double apart : {8.5, 9.5, 9.9}) {
    const TriangleMesh b = ball({0, 0.6 * apart, 0.8 * apart}, 5);
    EXPECT_NEAR(depth_between(a, b), 10 - apart, kErrorMm) << apart;
    EXPECT_EQ(depth_between(a, b), depth_between(b, a));
  }
  EXPECT_EQ(depth_between(a, ball({0, 6, 8.5}, 5)), 0);
  EXPECT_NEAR(depth_between(ball({0, 0, 0}, 2), a), 5, kErrorMm + 2);
}

TEST(DepthBetween, FindsWhatNoCornerIsIn) {
  // Large facets through each other, no corner of one in the other.
  TriangleMesh upright = plate(-0.5, 0.5);
  for (Vec3& v : upright.vertices) v = {v.z, v.x, v.y};
  constexpr double kHalfASampleMm = 0.125;
  EXPECT_NEAR(depth_between(plate(0, 1), upright), 0.5, kHalfASampleMm);
  EXPECT_NEAR(depth_between(plate(0, 1), plate(0.75, 2)), 0.25, 1e-9);
  EXPECT_EQ(depth_between(plate(0, 1), plate(1.05, 2)), 0);
}

TEST(Overlaps, FindsATubeInCartilageAndInAnotherTube) {
  cases::CaseData data;
  data.bones.resize(1);
  data.bones[0].bone = BoneId::Lunate;
  data.bones[0].label = 4;
  SoftTissue tissue;
  Cartilage c;
  c.label = 4;
  c.body = plate(0, 1);
  tissue.cartilage = {c};
  const auto tube = [](const std::string& name, double z_mm) {
    cases::Structure s;
    s.name = name;
    s.radius_mm = 1.5;
    s.course = {{{-6, 0, z_mm}, 0}, {{6, 0, z_mm}, 0}};
    return s;
  };
  data.structures = {tube("a", 2.25), tube("b", 5.05), tube("c", 8.2)};
  const std::vector<Overlap> found = overlaps_of(tissue, data);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].first, "cartilage of the lunate");
  EXPECT_EQ(found[0].second, "a");
  EXPECT_NEAR(found[0].mm, 0.25, 1e-9);
  EXPECT_EQ(found[1].first, "a");
  EXPECT_EQ(found[1].second, "b");
  EXPECT_NEAR(found[1].mm, 0.2, 1e-9);
}

TEST(Overlaps, FindsALigamentOfAWristPushedIntoItsNeighbours) {
  const cases::CaseData data = test::model_case(Side::Left, 1, Mat3::identity());
  SoftTissue tissue = make_soft_tissue(data);
  EXPECT_THAT(overlaps_of(tissue, data), IsEmpty());
  const auto of = [&](const std::string& id) -> Ligament& {
    return *std::find_if(tissue.ligaments.begin(), tissue.ligaments.end(),
                         [&](const Ligament& l) { return l.id == id; });
  };
  // The dorsal intercarpal ligament lies on the radiocarpal one; volar is inwards there.
  const Vec3 volar = data.wrist_from_patient.inverse().rotation * Vec3{0, 0, 1};
  for (Vec3& v : of("DIC").body.vertices) v += volar * 0.5;
  const std::vector<Overlap> found = overlaps_of(tissue, data);
  const auto pushed = std::find_if(found.begin(), found.end(), [](const Overlap& o) {
    return o.first == "DRC" && o.second == "DIC";
  });
  ASSERT_NE(pushed, found.end());
  EXPECT_GT(pushed->mm, 0.3);
  EXPECT_LT(pushed->mm, 0.7);
}

}  // namespace
}  // namespace carpus::soft_tissue
