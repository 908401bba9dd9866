// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/lay_beside.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "cases/structures.hpp"
#include "fields/exact_surface.hpp"
#include "fields/surface_test_support.hpp"

namespace carpus::cases {
namespace {

Structure tube(const std::string& id, const Vec3& from, const Vec3& to, double radius_mm) {
  Structure s;
  s.id = id;
  s.name = id;
  s.radius_mm = radius_mm;
  constexpr int kPieces = 32;
  for (int i = 0; i <= kPieces; ++i) {
    const double share = static_cast<double>(i) / kPieces;
    s.course.push_back({from + (to - from) * share, share});
  }
  return s;
}

/// Least distance of a tube's surface from a body's, five places to a millimetre.
double gap_mm(const Structure& tube, const TriangleMesh& body) {
  const fields::ExactSurface exact(body);
  double least = 1e9;
  for (std::size_t i = 1; i < tube.course.size(); ++i) {
    for (int k = 0; k <= 8; ++k) {
      const Vec3& a = tube.course[i - 1].at;
      least = std::min(least, exact.signed_distance(a + (tube.course[i].at - a) * (k / 8.0)));
    }
  }
  return least - tube.radius_mm;
}

/// The sharpest turn of a course from one piece to the next [deg].
double sharpest_turn_deg(const Structure& s) {
  double sharpest = 0;
  for (std::size_t i = 1; i + 1 < s.course.size(); ++i) {
    const Vec3 in = normalized_or(s.course[i].at - s.course[i - 1].at, {});
    const Vec3 out = normalized_or(s.course[i + 1].at - s.course[i].at, {});
    sharpest = std::max(sharpest, std::acos(std::min(1.0, dot(in, out))) * 57.2957795);
  }
  return sharpest;
}

constexpr double kRadiusMm = 1.1;
constexpr double kMostMm = 0.1;

/// A slab of bone with a band of ligament across it, and skin 12 mm above: +z is outwards.
class LayBeside : public ::testing::Test {
 protected:
  LayBeside() {
    Bone bone;
    bone.bone = BoneId::Radius;
    bone.surface = MeshIn<frame::Bone>(fields::test::box({-40, -20, -10}, {40, 20, 0}));
    data_.bones.push_back(std::move(bone));
    data_.skin = MeshIn<frame::Patient>(fields::test::box({-60, -40, -30}, {60, 40, 12}));
  }
  void lay() {
    const std::vector<const TriangleMesh*> bodies{&band_};
    lay_structures_beside(data_, bodies);
  }
  TriangleMesh band_ = fields::test::box({-5, -15, 0.05}, {5, 15, 1.6});
  CaseData data_;
};

TEST_F(LayBeside, LiftsATendonOverALigamentTowardsTheSkinAndNowhereSharply) {
  data_.structures = {tube("tendon", {-24, 0, 1.4}, {24, 0, 1.4}, kRadiusMm)};
  const double before_mm = length_of(data_.structures[0]);
  ASSERT_LT(gap_mm(data_.structures[0], band_), -1);
  lay();
  const Structure& laid = data_.structures[0];
  EXPECT_GE(gap_mm(laid, band_), -kMostMm);
  EXPECT_GE(gap_mm(laid, data_.bones[0].surface), -kMostMm);
  EXPECT_NEAR(laid.course[16].at.z, 1.6 + kRadiusMm, 0.3);
  EXPECT_NEAR(length_of(laid), before_mm, 0.02 * before_mm);
  EXPECT_LT(sharpest_turn_deg(laid), 25);
  // What lies beside the band by centimetres hardly moves, and each point keeps its share.
  EXPECT_LT(distance(laid.course.front().at, Vec3{-24, 0, 1.4}), 0.4);
  for (std::size_t i = 0; i < laid.course.size(); ++i) {
    EXPECT_EQ(laid.course[i].hand_share, static_cast<double>(i) / 32);
  }
}

TEST_F(LayBeside, BringsWhatLiesUnderALigamentOutOnItsOtherSide) {
  // Its middle is nearer to the band's deep side than to its other one.
  data_.structures = {tube("tendon", {-24, 0, 0.6}, {24, 0, 0.6}, kRadiusMm)};
  lay();
  EXPECT_GE(gap_mm(data_.structures[0], band_), -kMostMm);
  EXPECT_GE(gap_mm(data_.structures[0], data_.bones[0].surface), -kMostMm);
  EXPECT_GT(data_.structures[0].course[16].at.z, 1.6 + kRadiusMm - kMostMm);
}

TEST_F(LayBeside, PartsTubesThatCrossBetweenTheirPoints) {
  // By their points alone they are apart by 0.9 mm.
  data_.structures = {tube("one", {-23.25, 0, 5}, {24.75, 0, 5}, 0.7),
                      tube("other", {0, -23.25, 5.4}, {0, 24.75, 5.4}, 0.7)};
  lay();
  const Structure& one = data_.structures[0];
  double least = 1e9;
  for (std::size_t i = 1; i < one.course.size(); ++i) {
    for (int k = 0; k <= 8; ++k) {
      const Vec3& a = one.course[i - 1].at;
      const Vec3 p = a + (one.course[i].at - a) * (k / 8.0);
      least = std::min(least, distance_to(data_.structures[1], p) - one.radius_mm);
    }
  }
  EXPECT_GE(least, -kMostMm);
  EXPECT_GT(data_.structures[1].course[15].at.z, one.course[15].at.z) << "the upper one stays so";
}

TEST_F(LayBeside, LeavesWhatIsClearToTheBitAndDoesNothingTwice) {
  data_.structures = {tube("clear", {-24, 3, 6.1}, {24, 3.3, 6.7}, kRadiusMm)};
  const CaseData before = data_;
  lay();
  EXPECT_EQ(data_.structures, before.structures);
  data_.structures.push_back(tube("tendon", {-24, -4, 1.4}, {24, -4, 1.4}, kRadiusMm));
  lay();
  EXPECT_EQ(data_.structures[0], before.structures[0]);
  const std::vector<Structure> once = data_.structures;
  lay();
  EXPECT_EQ(data_.structures, once);
}

}  // namespace
}  // namespace carpus::cases
