// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The parts that naming is made of: eigenvectors, similarity fit, assignment, shapes.
#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "anatomy/assignment.hpp"
#include "anatomy/region_shape.hpp"
#include "anatomy/similarity_fit.hpp"
#include "core/rng.hpp"
#include "core/units.hpp"

namespace carpus::anatomy {
namespace {

Vec3 random_point(Rng& rng, double reach) {
  return {rng.uniform(-reach, reach), rng.uniform(-reach, reach), rng.uniform(-reach, reach)};
}

Mat3 random_rotation(Rng& rng) {
  return rotation_from_quaternion(rng.normal(), rng.normal(), rng.normal(), rng.normal());
}

RC_GTEST_PROP(SimilarityFit, FindsTheMotionThatWasApplied, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  const Similarity truth{random_rotation(rng), rng.uniform(0.85, 1.3), random_point(rng, 100)};
  std::vector<Vec3> from, to;
  std::vector<double> weights;
  for (int i = 0; i < 8; ++i) {
    from.push_back(random_point(rng, 40));
    to.push_back(truth * from.back());
    weights.push_back(rng.uniform(0.1, 1));
  }
  const Similarity fit = fit_similarity(from, to, weights, {0.85, 1.3});
  RC_ASSERT(std::abs(fit.scale - truth.scale) < 1e-9);
  for (const Vec3& p : from) RC_ASSERT(distance(fit * p, truth * p) < 1e-7);
}

RC_GTEST_PROP(SimilarityFit, NeverReflectsEvenIfThatWouldFitBetter, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  std::vector<Vec3> from, to;
  for (int i = 0; i < 8; ++i) {
    from.push_back(random_point(rng, 40));
    to.push_back({from.back().x, -from.back().y, from.back().z});
  }
  const std::vector<double> weights(from.size(), 1.0);
  const Similarity fit = fit_similarity(from, to, weights, {0.5, 2.0});
  RC_ASSERT(std::abs(fit.rotation.determinant() - 1) < 1e-9);
}

RC_GTEST_PROP(Assignment, IsAsCheapAsTheBestOfAllPermutations, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  const std::size_t rows = 1 + rng.below(4);
  const std::size_t columns = rows + rng.below(3);
  std::vector<double> costs(rows * columns);
  for (double& c : costs) c = std::floor(rng.uniform(-5, 20));  // ties are likely
  const auto column = assign_at_least_cost(costs, rows, columns);
  double cost = 0;
  std::vector<bool> taken(columns, false);
  for (std::size_t r = 0; r < rows; ++r) {
    RC_ASSERT(!taken[column[r]]);
    taken[column[r]] = true;
    cost += costs[r * columns + column[r]];
  }
  std::vector<std::size_t> order(columns);
  std::iota(order.begin(), order.end(), 0U);
  double best = 1e9;
  do {
    double sum = 0;
    for (std::size_t r = 0; r < rows; ++r) sum += costs[r * columns + order[r]];
    best = std::min(best, sum);
  } while (std::next_permutation(order.begin(), order.end()));
  RC_ASSERT(std::abs(cost - best) < 1e-9);
}

TEST(RegionShape, MeasuresBlocksAndSeesWhichLeaveTheVolume) {
  GridGeometry g;
  g.size = {60, 40, 80};
  g.spacing = {0.5, 0.5, 0.5};
  g.origin = {-3, 7, 11};
  Grid<std::uint16_t> labels(g);
  for (std::size_t i = 0; i < labels.values().size(); ++i) {
    const VoxelIndex v = g.index_of(i);
    if (v.x >= 4 && v.x < 24 && v.y >= 4 && v.y < 14 && v.z >= 4 && v.z < 44) labels[i] = 1;
    if (v.x >= 30 && v.x < 50 && v.y >= 10 && v.y < 30 && v.z >= 10) labels[i] = 2;
  }
  const auto shapes = measure_shapes(labels.view(), 2);
  // 20 x 10 x 40 voxels = 10 x 5 x 20 mm.
  EXPECT_FALSE(shapes[0].is_cut);
  EXPECT_NEAR(shapes[0].volume_mm3, 1000, 1e-9);
  EXPECT_NEAR(shapes[0].extents.x, 20 / std::sqrt(12), 0.01);
  EXPECT_NEAR(shapes[0].extents.y, 10 / std::sqrt(12), 0.01);
  EXPECT_NEAR(shapes[0].extents.z, 5 / std::sqrt(12), 0.01);
  EXPECT_NEAR(distance(shapes[0].centroid, g.patient_from_voxel({13.5, 8.5, 23.5})), 0, 1e-9);
  // A shaft leaving at high z: its last 17 mm at low z count.
  EXPECT_TRUE(shapes[1].is_cut);
  EXPECT_NEAR(shapes[1].volume_mm3, 100 * kJointEndLength, 1e-9);
  EXPECT_NEAR(gap_between(shapes[0], shapes[1]), 7 * 0.5, 0.3);
  EXPECT_NEAR(joined(shapes[0], shapes[0]).volume_mm3, 2000, 1e-9);
}

}  // namespace
}  // namespace carpus::anatomy
