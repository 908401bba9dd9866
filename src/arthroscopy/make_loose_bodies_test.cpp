// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/make_loose_bodies.hpp"

#include <gtest/gtest.h>

#include <array>
#include <set>

#include "arthroscopy/generic_wrist_test_support.hpp"
#include "arthroscopy/pathology_table.hpp"
#include "fields/distance_field.hpp"

namespace carpus::arthroscopy {
namespace {

constexpr std::array<std::uint8_t, 4> kPlaces{8, 11, 16, 17};

cases::JointLesions made(std::uint64_t seed, std::span<const std::uint8_t> places = kPlaces) {
  const test::GenericWrist& wrist = test::generic_wrist();
  return make_loose_bodies(wrist.data, wrist.map, {{1, 3}, {0.9, 1.4}, places}, seed);
}

TEST(MakeLooseBodies, SoManyAndSoLargeAsAskedEachByAPlaceOfItsOwnOnTheWall) {
  const cases::ArthroscopicMap& map = test::generic_wrist().map;
  std::set<std::size_t> counts;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const cases::JointLesions bodies = made(seed);
    counts.insert(bodies.lesions.size());
    for (const cases::Lesion& body : bodies.lesions) {
      EXPECT_EQ(body.look, cases::LesionLook::Loose);
      EXPECT_GE(body.radius_mm, 0.9);
      EXPECT_LE(body.radius_mm, 1.4);
      const Vec3 foot = body.from + body.outwards * (0.9 * body.radius_mm);
      const double off = fields::sample_distance(map.joints[body.joint].wall, foot).distance_mm;
      EXPECT_NEAR(off, 0, 0.5) << seed << ": it lies on the wall";
      for (const cases::Lesion& other : bodies.lesions) {
        if (&other == &body) continue;
        EXPECT_GT(distance(other.from, body.from), 1.0) << seed;
      }
    }
  }
  EXPECT_EQ(counts, (std::set<std::size_t>{1, 2, 3}));
}

TEST(MakeLooseBodies, TheSameSeedGivesTheSameAndAnExaminationKnowsOfThem) {
  const cases::JointLesions one = made(5);
  const cases::JointLesions two = made(5);
  ASSERT_EQ(one.lesions.size(), two.lesions.size());
  for (std::size_t i = 0; i < one.lesions.size(); ++i) {
    EXPECT_EQ(one.lesions[i].from, two.lesions[i].from);
  }
  const std::size_t finding = one.lesions.front().finding;
  EXPECT_EQ(PathologyTable::generic().findings[finding].id, "loose_body");
  EXPECT_EQ(one.grades[finding], 1);
}

TEST(MakeLooseBodies, WhereTheCaseLacksThePlacesThereAreFewer) {
  constexpr std::array<std::uint8_t, 2> kElsewhere{30, 31};
  EXPECT_TRUE(made(1, kElsewhere).lesions.empty());
}

}  // namespace
}  // namespace carpus::arthroscopy
