// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "collision/lp/touching_features.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "collision/lp/test_bodies.hpp"
#include "collision/lp/test_oracle.hpp"
#include "core/rng.hpp"

namespace carpus::collision {
namespace {

/// A vertex of one body put on a point of a face of the other, or the middles of two edges
/// together, a few units in the last place apart.
struct Touching {
  PairPose pose;
  ExactHint hint;
};

Touching touching(const ConvexBody& first, const ConvexBody& second, Rng& rng) {
  Touching t;
  t.pose.rotation = lp_test::any_rotation(rng);
  const Vec3 n = lp_test::any_direction(rng);  // from the first body to the second
  const auto top = [&](const ConvexBody& body, const Vec3& d) {
    std::uint32_t best = 0;
    for (std::uint32_t v = 0; v < body.vertices().size(); ++v) {
      if (dot(body.vertices()[v], d) > dot(body.vertices()[best], d)) best = v;
    }
    return best;
  };
  const std::uint32_t a = top(first, n);
  const std::uint32_t b = top(second, t.pose.rotation.transposed() * -n);
  const auto corners_at = [&](const ConvexBody& body, std::uint32_t vertex) {
    const std::uint32_t face =
        body.vertex_faces(vertex)[rng.below(body.vertex_faces(vertex).size())];
    return body.faces()[face].corners;
  };
  const auto middle = [](const ConvexBody& body, std::uint32_t p, std::uint32_t q) {
    return (body.vertices()[p] + body.vertices()[q]) * 0.5;
  };
  Vec3 on_first;
  Vec3 on_second;
  if (rng.below(2) == 0) {
    const auto face = corners_at(first, a);
    on_first = (first.vertices()[face[0]] + first.vertices()[face[1]] + first.vertices()[face[2]]) *
               (1.0 / 3);
    on_second = second.vertices()[b];
    t.hint.seed_count = 3;
    for (std::size_t i = 0; i < 3; ++i) t.hint.seeds[i] = {face[i], b};
  } else {
    const auto p = first.vertex_neighbours(a)[rng.below(first.vertex_neighbours(a).size())];
    const auto q = second.vertex_neighbours(b)[rng.below(second.vertex_neighbours(b).size())];
    on_first = middle(first, a, p);
    on_second = middle(second, b, q);
    t.hint.seed_count = 4;
    t.hint.seeds = {{{a, b}, {a, q}, {p, b}, {p, q}}};
  }
  t.pose.translation = on_first - t.pose.rotation * on_second;
  const double ulps = static_cast<double>(rng.below(7)) - 3;
  t.pose.translation[rng.below(3)] += ulps * 0x1p-50;
  return t;
}

TEST(TouchingFeatures, AreNeverWrongAndTellWhatTouchesFromOutside) {
  Rng rng(31);
  int decided = 0;
  int supporting = 0;
  int meets = 0;
  for (int i = 0; i < 120; ++i) {
    const ConvexBody first = lp_test::pebble(rng, 9);
    const ConvexBody second = lp_test::pebble(rng, 9, {-4, 1e3, 2});
    for (int k = 0; k < 6; ++k) {
      const Touching t = touching(first, second, rng);
      const PlacedBody placed{&second, t.pose.rotation, t.pose.translation};
      const PlacedBody still{&first, Mat3::identity(), {}};
      const Verdict verdict = touching_features_meet(still, placed, t.hint);
      const Verdict expected = lp_test::verdict_by_all_axes(first, second, t.pose);
      if (verdict != Verdict::Unknown) {
        EXPECT_EQ(verdict, expected) << i << " " << k;
        ++decided;
        meets += verdict == Verdict::Meet ? 1 : 0;
      }
      // Bodies a hundredth apart along n: then the features' plane is a supporting one.
      PairPose away = t.pose;
      const Vec3 shift = (t.pose.rotation * second.interior_point() + t.pose.translation -
                          first.interior_point()) *
                         1e-3;
      away.translation += shift;
      supporting += lp_test::verdict_by_all_axes(first, second, away) == Verdict::Apart ? 1 : 0;
    }
  }
  // Two random features of random bodies mostly do not face each other; those that do are told.
  EXPECT_GT(supporting, 40);
  EXPECT_GT(decided, supporting * 3 / 4);
  EXPECT_GT(meets, 10);
  EXPECT_LT(meets, decided - 10);
}

TEST(TouchingFeatures, SayNothingWithoutFeaturesOrWhereTheyAreLevel) {
  const ConvexBody cube = lp_test::box({1, 1, 1});
  const PlacedBody still{&cube, Mat3::identity(), {}};
  const PlacedBody beside{&cube, Mat3::identity(), {2, 0.5, 0.5}};
  EXPECT_EQ(touching_features_meet(still, beside, {}), Verdict::Unknown);
  ExactHint hint;
  hint.seed_count = 3;
  hint.seeds = {{{1, 0}, {3, 0}, {5, 0}, {0, 0}}};  // two faces on each other
  EXPECT_EQ(touching_features_meet(still, beside, hint), Verdict::Unknown);
}

}  // namespace
}  // namespace carpus::collision
