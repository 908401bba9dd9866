// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "survey/features/separating_cone.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "core/rng.hpp"

namespace carpus::survey {
namespace {

Vec3 random_vector(Rng& rng) { return {rng.normal(), rng.normal(), rng.normal()}; }

TEST(SeparatingCone, StaysUphillAlongEveryDifference) {
  Rng rng(1);
  for (int sample = 0; sample < 500; ++sample) {
    const Vec3 axis = normalized_or(random_vector(rng), {1, 0, 0});
    SeparatingCone cone;
    std::vector<Vec3> differences;
    for (std::uint32_t i = 0; i < 60; ++i) {
      Vec3 d = random_vector(rng);
      if (dot(d, axis) < 0) d = -d;  // the axis separates, and so must stay inside
      differences.push_back(d);
      if (i == 0) {
        cone.start({d, i, i});
      } else {
        ASSERT_EQ(cone.cut({d, i, i}, 0), SeparatingCone::Cut::Left);
      }
      EXPECT_TRUE(cone.contains(axis));
      for (const Vec3& known : differences) EXPECT_GT(dot(cone.centre(), known), 0);
    }
  }
}

TEST(SeparatingCone, IsEmptyOnceTheOriginIsSurrounded) {
  Rng rng(2);
  for (int sample = 0; sample < 500; ++sample) {
    SeparatingCone cone;
    cone.start({random_vector(rng), 0, 0});
    std::uint32_t i = 1;
    while (true) {  // four random vectors surround the origin with a chance of 1 in 8
      const VertexDifference by{random_vector(rng), i, i};
      if (cone.cut(by, 0) == SeparatingCone::Cut::Nothing) {
        const auto around = cone.around_origin(by);
        ASSERT_TRUE(around);
        // The origin as a sum of the four, by Cramer's rule: all weights have one sign.
        const auto& [a, b, c, d] = *around;
        const double of_d = dot(a.vector, cross(b.vector, c.vector));
        const double of_a = -dot(d.vector, cross(b.vector, c.vector));
        const double of_b = -dot(a.vector, cross(d.vector, c.vector));
        const double of_c = -dot(a.vector, cross(b.vector, d.vector));
        EXPECT_GT(of_a * of_d, 0);
        EXPECT_GT(of_b * of_d, 0);
        EXPECT_GT(of_c * of_d, 0);
        break;
      }
      ASSERT_LT(++i, 100U);
    }
  }
}

TEST(SeparatingCone, OpenAlongAThinWedgeIsNotTakenForEmpty) {
  // Two differences almost opposite leave a wedge through the z axis; which a third one halves.
  for (const double width : {1e-3, 1e-6, 1e-9}) {
    SeparatingCone cone;
    cone.start({{1, 0, width}, 0, 0});
    EXPECT_EQ(cone.cut({{-1, 0, width}, 1, 1}, 0), SeparatingCone::Cut::Left);
    EXPECT_TRUE(cone.contains({0, 0, 1}));
    EXPECT_EQ(cone.cut({{0, 1, width}, 2, 2}, 0), SeparatingCone::Cut::Left);
    EXPECT_EQ(cone.cut({{0, -1, width}, 3, 3}, 0), SeparatingCone::Cut::Left);
    EXPECT_TRUE(cone.contains({0, 0, 1}));
    EXPECT_EQ(cone.cut({{0, 0, -1}, 4, 4}, 0), SeparatingCone::Cut::Nothing);
  }
}

}  // namespace
}  // namespace carpus::survey
