// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/detail/carry_wall.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "core/error.hpp"

namespace carpus::arthroscopy::detail {
namespace {

constexpr std::size_t kAround = 12;
constexpr std::size_t kRings = 21;

/// A tube along x, a millimetre from ring to ring, closed at both ends.
TriangleMesh tube() {
  TriangleMesh mesh;
  for (std::size_t ring = 0; ring < kRings; ++ring) {
    for (std::size_t i = 0; i < kAround; ++i) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(i) / kAround;
      mesh.vertices.push_back({static_cast<double>(ring), std::cos(angle), std::sin(angle)});
    }
  }
  const auto at = [](std::size_t ring, std::size_t i) {
    return static_cast<std::uint32_t>(ring * kAround + i % kAround);
  };
  for (std::size_t ring = 0; ring + 1 < kRings; ++ring) {
    for (std::size_t i = 0; i < kAround; ++i) {
      mesh.facets.push_back({at(ring, i), at(ring, i + 1), at(ring + 1, i)});
      mesh.facets.push_back({at(ring, i + 1), at(ring + 1, i + 1), at(ring + 1, i)});
    }
  }
  for (std::size_t i = 1; i + 1 < kAround; ++i) {
    mesh.facets.push_back({at(0, 0), at(0, i + 1), at(0, i)});
    mesh.facets.push_back({at(kRings - 1, 0), at(kRings - 1, i), at(kRings - 1, i + 1)});
  }
  return mesh;
}

Carried on(std::uint8_t body) { return {{body}, {1.0F}}; }

float share_of(const Carried& carried, std::uint8_t body) {
  float sum = 0;
  for (std::size_t k = 0; k < Carried::kMost; ++k) {
    if (carried.body[k] == body) sum += carried.share[k];
  }
  return sum;
}

struct Tube {
  TriangleMesh mesh = tube();
  std::vector<Carried> guess;
  std::vector<float> hold;

  /// The first rings on body 3, the last on 7, what is between as if nearest to either.
  explicit Tube(float firmly) {
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      const std::size_t ring = v / kAround;
      guess.push_back(on(ring < kRings / 2 ? 3 : 7));
      hold.push_back(ring < 5 || ring >= kRings - 5 ? firmly : 0.0F);
    }
  }
};

TEST(CarryWall, GoesOverEvenlyFromBoneToBone) {
  const Tube t(1);
  const std::vector<Carried> carried = carry_wall(t.mesh, t.guess, t.hold);
  ASSERT_EQ(carried.size(), t.mesh.vertices.size());
  for (std::size_t v = 0; v < carried.size(); ++v) {
    const double ring = t.mesh.vertices[v].x;
    const double far = std::clamp((ring - 4) / 12, 0.0, 1.0);  // last held rings: 4 and 16
    EXPECT_NEAR(share_of(carried[v], 7), far, 0.003) << "ring " << ring;
    EXPECT_NEAR(share_of(carried[v], 3), 1 - far, 0.003) << "ring " << ring;
  }
}

TEST(CarryWall, ClearsUpWhatIsNearestByChanceOnABone) {
  Tube t(0.5F);
  t.guess[kAround] = on(7);  // on ring 1
  const std::vector<Carried> carried = carry_wall(t.mesh, t.guess, t.hold);
  EXPECT_LT(share_of(carried[kAround], 7), 0.6F);
  EXPECT_GT(share_of(carried[kAround], 7), 0.4F);
  EXPECT_LT(share_of(carried[kAround + 1], 7), 0.2F);
  EXPECT_LT(share_of(carried[kAround + 6], 7), 0.001F);
}

TEST(CarryWall, SharesAreOneInAllOfAtMostFourAndTheForemostFirst) {
  Tube t(1);
  for (std::size_t i = 0; i < 6; ++i) {  // six bodies about the middle
    t.guess[(kRings / 2) * kAround + 2 * i] = on(static_cast<std::uint8_t>(10 + i));
    t.hold[(kRings / 2) * kAround + 2 * i] = 1;
  }
  for (const Carried& one : carry_wall(t.mesh, t.guess, t.hold)) {
    float sum = 0;
    for (std::size_t k = 0; k < Carried::kMost; ++k) {
      EXPECT_GE(one.share[k], 0);
      EXPECT_LE(one.share[k], k > 0 ? one.share[k - 1] : 1.001F);
      sum += one.share[k];
    }
    EXPECT_NEAR(sum, 1, 1e-5);
  }
}

TEST(CarryWall, WhereNothingIsHeldSharesStayShares) {
  const Tube t(0);
  for (const Carried& one : carry_wall(t.mesh, t.guess, t.hold)) {
    EXPECT_NEAR(share_of(one, 3) + share_of(one, 7), 1, 1e-5);
  }
}

TEST(CarryWall, RefusesWhatIsNotByVertex) {
  const Tube t(1);
  EXPECT_THROW((void)carry_wall(t.mesh, t.guess, {}), InvalidInput);
}

}  // namespace
}  // namespace carpus::arthroscopy::detail
