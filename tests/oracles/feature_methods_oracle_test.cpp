// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The methods that walk over features against all separating axes and all pairs of features in long
// double: random and symmetric solids, jumps and small steps, bodies brought to within 1 to 1e-8 mm
// of touching. CARPUS_LONG=1 runs 5000 pairs instead of 60.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "convex/bodies_test_support.hpp"
#include "convex/features/feature_test_support.hpp"
#include "convex/pair_query.hpp"
#include "core/amount_test_support.hpp"
#include "oracles/exhaustive_distance.hpp"
#include "survey/methods.hpp"

namespace carpus {
namespace {

using convex::Closest;
using convex::PairPose;
using convex::PairQuery;
using convex::Verdict;
using survey::Method;

constexpr std::array kNames{"lin_canny", "v_clip", "swift", "q_collide"};

std::uint64_t pair_count() { return test::amount<std::uint64_t>(60, 60, 5000); }

/// A bone-sized move, a jump on the lattice, or a step that ends near touching.
class Poses {
 public:
  Poses(const ConvexPolytope& first, const ConvexPolytope& second, Rng& rng)
      : first_(oracles::body_of<long double>(first, Mat3::identity(), {})),
        second_(second),
        rng_(rng) {}

  PairPose next() {
    const std::uint64_t kind = rng_.below(4);
    const Vec3 axis = normalized_or(test::random_vector(rng_), {1, 0, 0});
    if (kind == 0) {
      rotation_ = Mat3::identity();
      const auto c = [&] { return static_cast<double>(rng_.below(30)) - 15; };
      translation_ = {c(), c(), c()};
    } else if (kind == 1) {
      rotation_ = test::random_rotation(rng_);
      translation_ = test::random_vector(rng_) * 5.0;
    } else if (kind == 2) {
      rotation_ = rotation_about(axis, 0.02 * rng_.normal()) * rotation_;
      translation_ += test::random_vector(rng_) * 0.1;
    } else {
      rotation_ = rotation_about(axis, tiny(17)) * rotation_;
      const long double target = rng_.below(3) == 0 ? -tiny(9) : tiny(9);
      const Vec3 away = normalized_or(translation_, {1, 0, 0});
      for (int i = 0; i < 3; ++i) translation_ += away * static_cast<double>(target - gap());
    }
    return {rotation_, translation_};
  }
  /// Over all separating axes; positive where the bodies are apart.
  [[nodiscard]] long double gap() const {
    return oracles::separation(first_,
                               oracles::body_of<long double>(second_, rotation_, translation_));
  }

 private:
  double tiny(std::uint64_t decades) {
    return std::pow(10.0, -static_cast<double>(rng_.below(decades)));
  }

  oracles::Body<long double> first_;
  const ConvexPolytope& second_;
  Rng& rng_;
  Mat3 rotation_;
  Vec3 translation_{9, 0, 0};
};

void expect_agreement(const Method& method,
                      const Verdict verdict,
                      const std::optional<Closest>& closest,
                      long double gap,
                      long double distance) {
  if (verdict == Verdict::Unknown) {
    EXPECT_EQ(method.name, "lin_canny");
    EXPECT_LE(gap, 2e-9L);
    return;
  }
  if (gap > 2e-9L) {
    EXPECT_EQ(verdict, Verdict::Apart) << method.name << " at " << gap;
  }
  if (gap < -1e-9L) {
    EXPECT_EQ(verdict, Verdict::Meet) << method.name << " at " << gap;
  }
  if (!method.gives_distance) return;
  EXPECT_EQ(closest.has_value(), verdict == Verdict::Apart);
  if (closest && gap > 1e-6L) {
    EXPECT_NEAR(closest->distance_mm, static_cast<double>(distance), 1e-9) << method.name;
  }
}

TEST(FeatureMethodsOracle, AgreeWithAllAxesAndAllPairsOfFeatures) {
  std::array<int, 2> seen{};
  for (std::uint64_t seed = 0; seed < pair_count(); ++seed) {
    Rng rng(seed + 77'000);
    const convex::ConvexBody first = test::random_body(rng);
    const convex::ConvexBody second = test::random_body(rng);
    std::vector<std::unique_ptr<PairQuery>> queries;
    for (const char* name : kNames) {
      queries.push_back(survey::find_method(name)->make(first, second));
    }
    Poses poses(first.polytope(), second.polytope(), rng);
    for (int step = 0; step < 12; ++step) {
      const PairPose pose = poses.next();
      const long double gap = poses.gap();
      long double distance = 0;
      if (gap > 0) {
        distance = oracles::exhaustive_distance(
            oracles::place(first.polytope(), Mat3::identity(), {}),
            oracles::place(second.polytope(), pose.rotation, pose.translation));
      }
      for (std::size_t i = 0; i < kNames.size(); ++i) {
        const Verdict verdict = queries[i]->meets(pose);
        expect_agreement(*survey::find_method(kNames[i]), verdict, queries[i]->closest(pose), gap,
                         distance);
      }
      ASSERT_FALSE(testing::Test::HasFailure()) << "seed " << seed << " step " << step;
      ++seen[gap > 0 ? 0 : 1];
    }
  }
  EXPECT_GT(seen[0], 200);
  EXPECT_GT(seen[1], 100);
}

}  // namespace
}  // namespace carpus
