// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/detail/bone_contact.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <limits>

#include "core/error.hpp"
#include "core/rng.hpp"
#include "instruments/guide_wire.hpp"
#include "simulation/operation_test_support.hpp"

namespace carpus::simulation::detail {
namespace {

NearBones all_bones() {
  NearBones all;
  for (std::size_t i = 0; i < test::posed_wrist().bones.size(); ++i) {
    all.index[all.count++] = static_cast<std::uint8_t>(i);
  }
  return all;
}

bool holds(const NearBones& bones, std::size_t index) {
  for (std::size_t i = 0; i < bones.count; ++i) {
    if (bones.index[i] == index) return true;
  }
  return false;
}

TEST(BoneContact, KeepsEveryBoneThatTheThickWireMeets) {
  BoneContact contact(test::posed_wrist());
  Rng rng(3);
  const Vec3 centre = test::posed_wrist().scaphoid.waist;
  int kept = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 shaft = normalized_or({rng.normal(), rng.normal(), rng.normal()}, {0, 0, 1});
    const WirePose wire{
        centre + Vec3{rng.uniform(-30, 30), rng.uniform(-30, 30), rng.uniform(-30, 30)}, shaft};
    const NearBones met = contact.hulls_met(all_bones(), wire);
    for (std::size_t b = 0; b < test::posed_wrist().bones.size(); ++b) {
      const cases::Bone& bone = test::posed_wrist().bones[b];
      // The axis of the wire and the corners of the hull, less what the prism holds for certain.
      bool is_near = false;
      for (const Vec3& v : bone.hull.vertices) {
        const Vec3 from_tip = (bone.patient_from_bone * Point<frame::Bone>{v}).v - wire.tip;
        const double along = dot(from_tip, shaft);
        const double beside = length(from_tip - shaft * along);
        is_near = is_near || (along >= -kHullMarginMm && along <= instruments::kWireLengthMm &&
                              beside <= instruments::kWireRadiusMm + kHullMarginMm);
      }
      if (is_near) {
        EXPECT_TRUE(holds(met, b)) << "pose " << i << " bone " << b;
      }
    }
    kept += met.count;
  }
  EXPECT_GT(kept, 400);
  EXPECT_LT(kept, 6000) << "and the filter leaves bones out";
}

TEST(BoneContact, KeepsBonesThatItDoesNotKnowAbout) {
  BoneContact contact(test::posed_wrist());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(contact.hulls_met(all_bones(), {{nan, 0, 0}, {0, 0, 1}}).count, all_bones().count);
}

TEST(BoneContact, NeedsHullsWithFacets) {
  cases::CaseData data = test::posed_wrist();
  data.bones.front().hull = {};
  EXPECT_THROW(BoneContact{data}, InvalidInput);
}

}  // namespace
}  // namespace carpus::simulation::detail
