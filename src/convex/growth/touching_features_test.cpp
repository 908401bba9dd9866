// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "convex/growth/touching_features.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "convex/bodies_test_support.hpp"
#include "convex/features/voronoi_features.hpp"
#include "convex/growth/test_oracle.hpp"
#include "core/rng.hpp"

namespace carpus::convex {
namespace {

struct Touching {
  PairPose pose;
  FeaturePair pair;
};

std::uint32_t top(const ConvexBody& body, const Vec3& d) {
  std::uint32_t best = 0;
  for (std::uint32_t v = 0; v < body.vertices().size(); ++v) {
    if (dot(body.vertices()[v], d) > dot(body.vertices()[best], d)) best = v;
  }
  return best;
}

/// Of `kind` and about the vertex.
Feature any_feature(const ConvexBody& body, std::uint32_t vertex, FeatureKind kind, Rng& rng) {
  if (kind == FeatureKind::Vertex) return Feature::vertex(vertex);
  const auto faces = body.vertex_faces(vertex);
  const std::size_t slot = rng.below(faces.size());
  if (kind == FeatureKind::Face) return Feature::face(faces[slot]);
  return body.derived<VoronoiFeatures>().spoke_edge(vertex, slot);
}

/// A point within the feature.
Vec3 middle_of(const ConvexBody& body, const Feature& feature) {
  const auto& v = body.vertices();
  if (feature.kind == FeatureKind::Vertex) return v[feature.id];
  if (feature.kind == FeatureKind::Edge) return (v[feature.id] + v[feature.head]) * 0.5;
  const auto& face = body.faces()[feature.id].corners;
  return (v[face[0]] + v[face[1]] + v[face[2]]) * (1.0 / 3);
}

/// A vertex of one body put on a point of a face of the other, or the middles of two edges
/// together, a few units in the last place apart.
Touching touching(const ConvexBody& first, const ConvexBody& second, Rng& rng) {
  Touching t;
  t.pose.rotation = test::random_rotation(rng);
  const Vec3 n = test::random_direction(rng);  // from the first body to the second
  const std::uint32_t a = top(first, n);
  const std::uint32_t b = top(second, t.pose.rotation.transposed() * -n);
  constexpr std::array kKinds{FeatureKind::Vertex, FeatureKind::Edge, FeatureKind::Face};
  const std::size_t kind = rng.below(3);
  t.pair = {any_feature(first, a, kKinds[kind], rng),
            any_feature(second, b, kKinds[2 - kind], rng)};
  t.pose.translation =
      middle_of(first, t.pair.first) - t.pose.rotation * middle_of(second, t.pair.second);
  const double ulps = static_cast<double>(rng.below(7)) - 3;
  t.pose.translation[rng.below(3)] += ulps * 0x1p-50;
  return t;
}

Verdict look(const ConvexBody& first, const ConvexBody& second, const Touching& t) {
  return touching_features_meet({&first, Mat3::identity(), {}},
                                {&second, t.pose.rotation, t.pose.translation}, t.pair);
}

TEST(TouchingFeatures, AreNeverWrongAndTellWhatTouchesFromOutside) {
  Rng rng(31);
  int decided = 0;
  int supporting = 0;
  int meets = 0;
  for (int i = 0; i < 120; ++i) {
    const ConvexBody first = test::pebble(rng, 9);
    const ConvexBody second = test::pebble(rng, 9, {-4, 1e3, 2});
    for (int k = 0; k < 6; ++k) {
      const Touching t = touching(first, second, rng);
      const Verdict verdict = look(first, second, t);
      if (verdict != Verdict::Unknown) {
        EXPECT_EQ(verdict, test::verdict_by_all_axes(first, second, t.pose)) << i << " " << k;
        ++decided;
        meets += verdict == Verdict::Meet ? 1 : 0;
      }
      // Bodies a thousandth apart: then the features' plane is a supporting one.
      PairPose away = t.pose;
      const Vec3 shift = (t.pose.rotation * second.interior_point() + t.pose.translation -
                          first.interior_point()) *
                         1e-3;
      away.translation += shift;
      supporting += test::verdict_by_all_axes(first, second, away) == Verdict::Apart ? 1 : 0;
    }
  }
  // Two random features of random bodies mostly do not face each other; those that do are told.
  EXPECT_GT(supporting, 40);
  EXPECT_GT(decided, supporting * 3 / 4);
  EXPECT_GT(meets, 10);
  EXPECT_LT(meets, decided - 10);
}

TEST(TouchingFeatures, AreSeenAlikeFromAThirdFrame) {
  Rng rng(32);
  int decided = 0;
  for (int i = 0; i < 300; ++i) {
    const ConvexBody first = test::pebble(rng, 12);
    const ConvexBody second = test::pebble(rng, 12);
    const Touching t = touching(first, second, rng);
    const Mat3 turn = test::random_rotation(rng);
    const Vec3 shift = test::random_direction(rng) * 50;
    const PlacedBody a{&first, turn, shift};
    PlacedBody b{&second, turn * t.pose.rotation, turn * t.pose.translation + shift};
    // Rounded, this is another pose: apart or not is decided anew.
    const Verdict verdict = touching_features_meet(a, b, t.pair);
    if (verdict == Verdict::Unknown) continue;
    ++decided;
    EXPECT_EQ(verdict, exactly_meet(a, b, {}).verdict) << i;
    EXPECT_EQ(verdict, touching_features_meet(b, a, {t.pair.second, t.pair.first})) << i;
  }
  EXPECT_GT(decided, 30);
}

TEST(TouchingFeatures, AreNeverWrongForNeedlesAndMatricesThatAreNoRotations) {
  Rng rng(33);
  int decided = 0;
  for (int i = 0; i < 600; ++i) {
    const double thin = std::pow(10.0, -static_cast<double>(rng.below(13)));
    const ConvexBody first =
        rng.below(2) == 0 ? test::pebble(rng, 8) : test::box({3, thin, thin * 2});
    const ConvexBody second = rng.below(2) == 0 ? test::pebble(rng, 8) : test::prism(5, 2, thin);
    Touching t = touching(first, second, rng);
    constexpr std::array kScales{1.0, 1 + 1e-9, 0.5, 1.0001, -1.0, 3.0};
    const double scale = kScales[rng.below(kScales.size())];
    for (Vec3& row : t.pose.rotation.rows) row *= scale;
    t.pose.translation =
        middle_of(first, t.pair.first) - t.pose.rotation * middle_of(second, t.pair.second);
    const Verdict verdict = look(first, second, t);
    if (verdict == Verdict::Unknown) continue;
    ++decided;
    EXPECT_EQ(verdict, test::verdict_by_all_axes(first, second, t.pose)) << i;
  }
  EXPECT_GT(decided, 20);
}

TEST(TouchingFeatures, SayNothingWhereTheyAreLevelOrBeyondBounds) {
  const ConvexBody cube = test::box({1, 1, 1});
  const auto& features = cube.derived<VoronoiFeatures>();
  const PlacedBody still{&cube, Mat3::identity(), {}};
  const auto verdict = [&](const PlacedBody& other, const FeaturePair& pair) {
    return touching_features_meet(still, other, pair);
  };
  const PlacedBody beside{&cube, Mat3::identity(), {2, 0.5, 0.5}};
  for (std::uint32_t f = 0; f < 6; ++f) {
    for (std::uint32_t v = 0; v < 8; ++v) {  // two faces on each other
      EXPECT_EQ(verdict(beside, {Feature::face(f), Feature::vertex(v)}), Verdict::Unknown);
      EXPECT_EQ(verdict(beside, {Feature::vertex(v), Feature::face(f)}), Verdict::Unknown);
    }
  }
  const Feature edge = features.spoke_edge(0, 0);
  EXPECT_EQ(verdict(beside, {edge, edge}), Verdict::Unknown);  // parallel
  EXPECT_EQ(verdict(beside, {edge, Feature::vertex(1)}), Verdict::Unknown);
  EXPECT_EQ(verdict(beside, {Feature::face(1), Feature::face(2)}), Verdict::Unknown);

  const FeaturePair pair{Feature::face(0), Feature::vertex(0)};
  EXPECT_EQ(verdict({&cube, Mat3::identity(), {NAN, 0, 0}}, pair), Verdict::Unknown);
  EXPECT_EQ(verdict({&cube, Mat3::identity(), {0, HUGE_VAL, 0}}, pair), Verdict::Unknown);
  Mat3 stretched;
  stretched.rows[0] *= 1e9;
  EXPECT_EQ(verdict({&cube, stretched, {3, 0, 0}}, pair), Verdict::Unknown);
  Mat3 none;
  none.rows[1].y = NAN;
  EXPECT_EQ(verdict({&cube, none, {3, 0, 0}}, pair), Verdict::Unknown);
}

}  // namespace
}  // namespace carpus::convex
