// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/limb_beyond_scan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "fields/triangle_tree.hpp"

namespace carpus::reconstruct {
namespace {

constexpr int kSides = 48;

/// A straight sleeve of skin along x, oval, open at both ends: forearm at +x, hand at -x, and in it
/// the metacarpals 2 to 5 as far as the scan sees them. Wrist and Patient are one frame.
cases::CaseData sleeve(double wide) {
  cases::CaseData data;
  data.side = Side::Right;
  for (int i = 0; i <= 40; ++i) {
    for (int k = 0; k < kSides; ++k) {
      const double a = 2 * kPi * k / kSides;
      data.skin.vertices.push_back({80.0 - 3 * i, wide * std::cos(a), 16 * std::sin(a)});
    }
  }
  const auto at = [](int i, int k) { return static_cast<std::uint32_t>(i * kSides + k % kSides); };
  for (int i = 0; i < 40; ++i) {
    for (int k = 0; k < kSides; ++k) {
      data.skin.facets.push_back({at(i, k), at(i, k + 1), at(i + 1, k)});
      data.skin.facets.push_back({at(i, k + 1), at(i + 1, k + 1), at(i + 1, k)});
    }
  }
  const std::array ids{BoneId::Metacarpal2, BoneId::Metacarpal3, BoneId::Metacarpal4,
                       BoneId::Metacarpal5};
  for (std::size_t m = 0; m < ids.size(); ++m) {
    cases::Bone bone;
    bone.bone = ids[m];
    const double y = wide * (0.66 - 0.44 * static_cast<double>(m));
    for (int i = 0; i <= 30; ++i) {
      for (int k = 0; k < 12; ++k) {
        const double a = 2 * kPi * k / 12;
        bone.surface.vertices.push_back({-8.0 - i, y + 4 * std::cos(a), 4 * std::sin(a)});
      }
    }
    data.bones.push_back(bone);
  }
  return data;
}

std::pair<Vec3, Vec3> box_of(const TriangleMesh& mesh) {
  Vec3 low{1e9, 1e9, 1e9};
  Vec3 high{-1e9, -1e9, -1e9};
  for (const Vec3& v : mesh.vertices) {
    for (std::size_t a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], v[a]);
      high[a] = std::max(high[a], v[a]);
    }
  }
  return {low, high};
}

TEST(LimbBeyondScan, GoesOnFromBothEndsWhereTheSkinEnds) {
  const cases::CaseData data = sleeve(40);
  const LimbBeyondScan limb = limb_beyond_scan(data);
  const auto [hand_low, hand_high] = box_of(limb.hand);
  // From base at -8: a metacarpal of 64.6 and a middle finger of 88.3 mm, a little bent.
  EXPECT_NEAR(hand_low.x, -8 - 64.6 - 88.3, 12);
  EXPECT_NEAR(hand_high.x, -40, 2.5) << "begins at the rim";
  EXPECT_GT(hand_high.z, 20) << "fingers bend to the palm, +z";
  const auto [arm_low, arm_high] = box_of(limb.forearm);
  EXPECT_NEAR(arm_low.x, 80, 2.5);
  EXPECT_NEAR(arm_high.x, 80 + 146, 1);
  EXPECT_NEAR(arm_high.y, 40 * (1 + 0.002 * 146), 2);
}

TEST(LimbBeyondScan, TakesTheSkinsOutlineAtTheRim) {
  const cases::CaseData data = sleeve(40);
  const LimbBeyondScan limb = limb_beyond_scan(data);
  const fields::TriangleTree skin(data.skin);
  int count = 0;
  for (const TriangleMesh* mesh : {&limb.hand, &limb.forearm}) {
    for (const Vec3& v : mesh->vertices) {
      if (v.x < -40.5 || v.x > 80.5) continue;
      ++count;
      EXPECT_LT(std::sqrt(skin.nearest(v)->squared_distance), 0.6)
          << v.x << " " << v.y << " " << v.z;
    }
  }
  EXPECT_GT(count, 100);
}

TEST(LimbBeyondScan, ASmallPalmHasShortFingers) {
  const auto length = [](double wide) {
    return box_of(limb_beyond_scan(sleeve(wide)).hand).first.x;
  };
  EXPECT_GT(length(34), length(40) + 10);
}

TEST(LimbBeyondScan, MakesNothingWhereNothingWasCutOff) {
  cases::CaseData data = sleeve(40);
  data.bones.clear();
  EXPECT_TRUE(limb_beyond_scan(data).hand.facets.empty());
  data.skin = {};
  const LimbBeyondScan limb = limb_beyond_scan(data);
  EXPECT_TRUE(limb.hand.facets.empty());
  EXPECT_TRUE(limb.forearm.facets.empty());
}

TEST(LimbBeyondScan, ACaseOfNoLimbsSizeGetsNone) {
  cases::CaseData data = sleeve(40);
  for (Vec3& v : data.skin.vertices) v = v * 1e5;
  const LimbBeyondScan limb = limb_beyond_scan(data);
  EXPECT_TRUE(limb.hand.facets.empty());
  EXPECT_TRUE(limb.forearm.facets.empty());
}

TEST(LimbBeyondScan, StaysDrapedAboutACornerOfTheField) {
  cases::CaseData data = sleeve(40);
  // The rim of the hand slants and bends: no plane cut it.
  for (Vec3& v : data.skin.vertices) {
    if (v.x < -30) v.x -= 0.3 * std::abs(v.y);
  }
  const LimbBeyondScan limb = limb_beyond_scan(data);
  EXPECT_TRUE(limb.hand.facets.empty());
  EXPECT_FALSE(limb.forearm.facets.empty());
}

}  // namespace
}  // namespace carpus::reconstruct
