// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "convex/growth/growth_features.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "convex/bodies_test_support.hpp"
#include "convex/growth/growth_start.hpp"
#include "convex/growth/rows_proof.hpp"
#include "core/rng.hpp"

namespace carpus::convex {
namespace {

bool is_same(const Feature& a, const Feature& b) {
  if (a.kind != b.kind) return false;
  if (a.kind != FeatureKind::Edge) return a.id == b.id;
  return std::minmax(a.id, a.head) == std::minmax(b.id, b.head);
}

struct GrowthFeatures : testing::Test {
  Rng rng{9};
  ConvexBody first = test::pebble(rng, 80);
  ConvexBody second = test::pebble(rng, 80);
  ProofBody first_proofs{first};
  ProofBody second_proofs{second};
  RelativePose pose;
  GrowthMemory memory;

  void SetUp() override {
    ASSERT_TRUE(relative_pose(*first_proofs.facets, *second_proofs.facets,
                              {test::random_rotation(rng), {20, 3, -2}}, pose));
  }
  Feature any_edge(const VoronoiFeatures& body) {
    const auto face = static_cast<std::uint32_t>(rng.below(body.face_count()));
    return body.side_edge(face, rng.below(body.sides(face).size()));
  }
};

TEST_F(GrowthFeatures, ComeBackFromTheRowsThatTheyGave) {
  for (int i = 0; i < 300; ++i) {
    const auto face = [&](const ConvexBody& body) {
      return Feature::face(static_cast<std::uint32_t>(rng.below(body.faces().size())));
    };
    const auto vertex = [&](const ConvexBody& body) {
      return Feature::vertex(static_cast<std::uint32_t>(rng.below(body.vertices().size())));
    };
    for (const FeaturePair& pair :
         {FeaturePair{face(first), vertex(second)}, FeaturePair{vertex(first), face(second)},
          FeaturePair{any_edge(*first_proofs.features), any_edge(*second_proofs.features)}}) {
      ASSERT_TRUE(set_rows(first_proofs, second_proofs, pose, pair, memory));
      for (int k = 0; k < 4; ++k) {
        EXPECT_EQ(memory.rows[static_cast<std::size_t>(k)].is_second, k >= memory.first_rows);
      }
      FeaturePair back;
      ASSERT_TRUE(features_of_rows(first_proofs, second_proofs, memory, back));
      EXPECT_TRUE(is_same(back.first, pair.first)) << i;
      EXPECT_TRUE(is_same(back.second, pair.second)) << i;
    }
  }
}

TEST_F(GrowthFeatures, OfAVertexAndTheFaceOverItAreABasis) {
  int usable = 0;
  for (std::uint32_t f = 0; f < first_proofs.facets->size(); ++f) {
    const FeaturePair pair = features_from_faces(first_proofs, second_proofs, pose, f, 0);
    ASSERT_TRUE(set_rows(first_proofs, second_proofs, pose, pair, memory));
    SeparationProof proof;
    usable += separation_of_rows(memory.rows, memory.first_rows, pose, 1, 1, proof) ? 1 : 0;
  }
  EXPECT_EQ(usable, static_cast<int>(first_proofs.facets->size()));
}

TEST_F(GrowthFeatures, WithoutABasisChangeNothing) {
  ASSERT_TRUE(
      set_rows(first_proofs, second_proofs, pose, {Feature::face(1), Feature::vertex(2)}, memory));
  const GrowthMemory before = memory;
  EXPECT_FALSE(set_rows(first_proofs, second_proofs, pose, {Feature::vertex(1), Feature::vertex(2)},
                        memory));
  EXPECT_FALSE(set_rows(first_proofs, second_proofs, pose,
                        {any_edge(*first_proofs.features), Feature::vertex(2)}, memory));
  EXPECT_EQ(memory.first_rows, before.first_rows);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(memory.rows[k].face, before.rows[k].face);
  memory.rows[2].face = GrowthRow::kNoFace;
  FeaturePair pair;
  EXPECT_FALSE(features_of_rows(first_proofs, second_proofs, memory, pair));
}

TEST_F(GrowthFeatures, SeedExactArithmeticWithTheirCorners) {
  const auto seeds = [&](const FeaturePair& pair) {
    return hint_of(first_proofs, second_proofs, pair, {1, 0, 0}).seed_count;
  };
  const Feature a = any_edge(*first_proofs.features);
  const Feature b = any_edge(*second_proofs.features);
  EXPECT_EQ(seeds({a, b}), 4U);
  EXPECT_EQ(seeds({Feature::face(3), Feature::vertex(2)}), 3U);
  EXPECT_EQ(seeds({Feature::vertex(3), Feature::face(2)}), 3U);
  EXPECT_EQ(seeds({Feature::vertex(3), b}), 2U);
  const ExactHint hint = hint_of(first_proofs, second_proofs, {a, b}, {1, 0, 0});
  EXPECT_EQ(hint.seeds[0][0], a.id);
  EXPECT_EQ(hint.seeds[3][1], b.head);
}

}  // namespace
}  // namespace carpus::convex
