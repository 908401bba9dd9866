// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/make_screw.hpp"

#include <gtest/gtest.h>

#include <map>

#include "arthroscopy/generic_wrist_test_support.hpp"
#include "core/error.hpp"
#include "fields/distance_field.hpp"

namespace carpus::arthroscopy {
namespace {

using cases::ScrewFault;

/// The line along which it should lie: the two vertices of the scaphoid that are farthest apart.
const cases::CaseData& with_axis() {
  static const cases::CaseData kData = [] {
    cases::CaseData data = test::generic_wrist().data;
    for (const cases::Bone& bone : data.bones) {
      if (bone.bone != BoneId::Scaphoid) continue;
      Vec3 middle;
      for (const Vec3& v : bone.surface.vertices) middle += v;
      middle = middle / static_cast<double>(bone.surface.vertices.size());
      const auto farthest = [&](const Vec3& from) {
        Vec3 best = from;
        for (const Vec3& v : bone.surface.vertices) {
          if (distance(v, from) > distance(best, from)) best = v;
        }
        return best;
      };
      const Vec3 one = farthest(middle);
      const Vec3 two = farthest(one);
      const auto proximal = [&](const Vec3& at) {
        return (data.wrist_from_patient * Point<frame::Patient>{at}).v.x;
      };
      const bool is_one = proximal(one) > proximal(two);
      data.scaphoid.central_axis = {is_one ? one : two, is_one ? two : one};
    }
    return data;
  }();
  return kData;
}

cases::JointLesions made(std::uint64_t seed) {
  return make_screw(with_axis(), test::generic_wrist().map, seed);
}

double in_space(std::size_t joint, const Vec3& at) {
  const auto s = fields::sample_distance(test::generic_wrist().map.joints[joint].wall, at);
  return s.is_inside_grid ? -s.distance_mm : -4.0;
}

TEST(MakeScrew, EveryFaultComesAndShowsWhereItIsSaidTo) {
  std::map<ScrewFault, int> faults;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const cases::JointLesions made_now = made(seed);
    ASSERT_TRUE(made_now.screw) << seed;
    const cases::ControlledScrew& screw = *made_now.screw;
    ++faults[screw.fault];
    EXPECT_NEAR(distance(screw.tail, screw.tip), screw.length_mm, 1e-9);
    ASSERT_EQ(made_now.lesions.size(), cases::kScrewSites);
    const bool is_end_proud =
        screw.fault == ScrewFault::NotTurnedIn || screw.fault == ScrewFault::TooLong;
    EXPECT_EQ(says_proud(0, made_now.grades[0]), is_end_proud) << seed;
    EXPECT_EQ(says_proud(1, made_now.grades[1]), screw.fault == ScrewFault::OffAxis) << seed;
    EXPECT_EQ(says_proud(2, made_now.grades[2]), screw.fault == ScrewFault::Through) << seed;
    const double least = ScrewTable::generic().proud_mm[0];
    if (is_end_proud) {
      EXPECT_GE(screw.out_mm[0], least) << seed;
    }
    if (!is_end_proud) {
      EXPECT_LT(screw.out_mm[0], 0.2) << seed;
    }
    if (screw.fault == ScrewFault::OffAxis) {
      EXPECT_GE(screw.out_mm[1], 0.6) << seed;
    }
    if (screw.fault != ScrewFault::OffAxis) {
      EXPECT_LT(screw.out_mm[1], 0.0) << seed;
    }
    for (const cases::Lesion& site : made_now.lesions) {
      EXPECT_NEAR(in_space(site.joint, site.from), 0.0, 0.5) << seed << ": it is seen on the wall";
    }
    // Turned in until its end is covered it has bone before its tip, or not.
    const double spare = screw.line_mm - screw.length_mm;
    if (screw.fault == ScrewFault::NotTurnedIn) {
      EXPECT_GE(spare, 3.5) << seed;
    }
    if (screw.fault == ScrewFault::TooLong) {
      EXPECT_LT(spare, 2.0) << seed;
    }
  }
  EXPECT_GT(faults[ScrewFault::Harmless], 0);
  EXPECT_GT(faults[ScrewFault::NotTurnedIn], 0);
  EXPECT_GE(faults.size(), 4U);
}

TEST(MakeScrew, TheSameSeedGivesTheSameBits) {
  for (const std::uint64_t seed : {1U, 4U, 9U}) {
    const auto one = made(seed);
    const auto two = made(seed);
    EXPECT_EQ(one.screw->tail, two.screw->tail);
    EXPECT_EQ(one.screw->tip, two.screw->tip);
    EXPECT_EQ(one.grades, two.grades);
    EXPECT_EQ(one.lesions[2].from, two.lesions[2].from);
  }
}

TEST(MakeScrew, WithoutItsPlacesThereIsNone) {
  cases::ArthroscopicMap map = test::generic_wrist().map;
  std::erase_if(map.points, [](const auto& point) { return point.number == kScaphocapitate; });
  EXPECT_FALSE(make_screw(with_axis(), map, 1).screw);
}

TEST(InScrew, ABallIsOutByTheShortestWay) {
  cases::ControlledScrew screw;
  screw.tip = {0, 0, 20};
  screw.length_mm = 20;
  screw.tail_radius_mm = screw.tip_radius_mm = 2;
  const auto side = cases::in_screw(screw, {2.2, 0, 10}, 0.5);
  EXPECT_NEAR(side.depth_mm, 0.3, 1e-12);
  EXPECT_NEAR(side.out.x, 1, 1e-12);
  const auto end = cases::in_screw(screw, {0.5, 0, -0.4}, 0.5);
  EXPECT_NEAR(end.depth_mm, 0.1, 1e-12);
  EXPECT_NEAR(end.out.z, -1, 1e-12);
  EXPECT_LT(cases::in_screw(screw, {0, 0, -0.6}, 0.5).depth_mm, 0);
  EXPECT_LT(cases::in_screw(screw, {2.6, 0, 10}, 0.5).depth_mm, 0);
}

TEST(ScrewTable, SaysWhatIsWrong) {
  EXPECT_THROW((void)ScrewTable::parse("{}"), InvalidInput);
  EXPECT_THROW((void)ScrewTable::parse("nonsense"), InvalidInput);
  const ScrewTable& table = ScrewTable::generic();
  EXPECT_EQ(table.questions.findings[kScrewDecision].id, "screw_decision");
}

}  // namespace
}  // namespace carpus::arthroscopy
