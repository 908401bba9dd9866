// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "trainee/leading_sleeve.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "procedures/built_in.hpp"
#include "simulation/operation_test_support.hpp"
#include "trainee/attempt.hpp"

namespace carpus::trainee {
namespace {

const procedure::Procedure& dorsal() {
  return *procedures::built_in().find("dorsal_scaphoid_fixation");
}

/// The synthetic wrist with a tendon across the wire's way, 8 mm before the bone.
cases::CaseData wrist_with_tendon() {
  cases::CaseData data = simulation::test::wrist();
  const simulation::World plain(data, dorsal(), 1);
  const auto body = [](BoneId bone) { return simulation::test::body_of(bone); };
  const auto& scaphoid = plain.now().patient_from_bone[body(BoneId::Scaphoid)];
  const auto& hand = plain.now().patient_from_bone[body(BoneId::Capitate)];
  const auto& axis = data.scaphoid.central_axis;
  const Vec3 outward = normalized_or(axis.proximal - axis.distal, {0, 0, 1});
  const Vec3 across = any_perpendicular(outward);
  cases::Structure tendon{"tendon", "a tendon",     anatomy::StructureKind::Tendon,
                          2.5,      BoneId::Radius, {}};
  for (const double side : {-10.0, 10.0}) {
    const Vec3 p = axis.proximal + outward * 8.0 + across * side;
    tendon.course.push_back({(hand.inverse() * (scaphoid * Point<frame::Bone>{p})).v, 1});
  }
  data.structures = {tendon};
  return data;
}

TEST(LeadingSleeve, TakesTheWirePastATendonThatABareOneStrikes) {
  const cases::CaseData data = wrist_with_tendon();
  const Attempt led = operate(data, dorsal(), Skill::Expert, 1, "test");
  ASSERT_EQ(led.record.structures.size(), 1U);
  EXPECT_FALSE(led.record.structures[0].was_struck);
  EXPECT_TRUE(led.score.is_fixation_acceptable);
  procedure::Procedure without = dorsal();
  std::erase_if(without.tray, [](auto index) { return instruments::catalogue()[index].is_sleeve; });
  EXPECT_FALSE(LeadingSleeve(without).is_offered());
  const Attempt bare = operate(data, without, Skill::Expert, 1, "test");
  EXPECT_TRUE(bare.record.structures[0].was_struck);
  EXPECT_EQ(bare.score.overall, 0.0);
}

}  // namespace
}  // namespace carpus::trainee
