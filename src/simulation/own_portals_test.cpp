// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Joints that are entered by portals that were made before: through a plate of skin into a box,
// far from the bones.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "simulation/portal_maker_test_support.hpp"

namespace carpus::simulation {
namespace {

using namespace box_joint;  // NOLINT(google-build-using-namespace)

constexpr double kAside = 1.5;  // of the portal's place
constexpr const char* kScope = "arthroscope_1_9_30";

const procedure::Procedure& from_the_skin() {
  static const procedure::Procedure kProcedure = [] {
    procedure::Procedure made = making();
    made.tray.push_back(tool(kScope));
    made.tray.push_back(tool("hook_probe"));
    return made;
  }();
  return kProcedure;
}

void make_portal(Maker& maker, double y) {
  maker.prick(y);
  maker.cut(y);
  maker.spread(y);
  maker.enter(y);
  maker.hand.go(at(15, y), 50);
}

TEST(OwnPortals, ClosedSkinHoldsAScopeWhereNothingWasMade) {
  World world(wrist_with_skin(), from_the_skin(), 1);
  Maker maker(world);
  maker.take(kScope);
  maker.hand.go(at(-8), 300);
  EXPECT_FALSE(world.now().scope.facts.is_in_joint[0]);
  EXPECT_GT(tip_out_mm(world), -2.0) << "skin gives a little";
  EXPECT_GT(world.now().hands[0].force_in_patient.x, 1.0);
  EXPECT_EQ(world.now().skin.way_count, 0);
}

TEST(OwnPortals, AScopeGoesInWhereTheSheathWentAndNotWhereThePortalShouldBe) {
  World world(wrist_with_skin(), from_the_skin(), 1);
  Maker maker(world);
  make_portal(maker, kAside);
  ASSERT_EQ(world.now().skin.facts.made, 1);
  ASSERT_EQ(world.now().skin.way_count, 1);
  const OwnWayView& way = world.now().skin.ways[0];
  EXPECT_EQ(way.portal, 0);
  EXPECT_NEAR(way.skin.y, kMiddle.y + kAside, 0.6);
  EXPECT_NEAR(way.capsule_mm, kCapsuleMm, 0.5);
  maker.take(kScope);
  maker.hand.go(at(15, way.skin.y - kMiddle.y));
  maker.hand.go(at(-9, way.skin.y - kMiddle.y), 300);
  EXPECT_TRUE(world.now().scope.facts.is_in_joint[0]);
  EXPECT_LT(tip_out_mm(world), -8.0);
}

TEST(OwnPortals, AnotherThatIsNotMadeStaysClosed) {
  World world(wrist_with_skin(), from_the_skin(), 1);
  Maker maker(world);
  make_portal(maker, 0.0);
  maker.take(kScope);
  maker.hand.go(at(15, 7));
  maker.hand.go(at(-9, 7), 300);
  EXPECT_FALSE(world.now().scope.facts.is_in_joint[0]);
  EXPECT_GT(tip_out_mm(world), -2.0);
}

TEST(OwnPortals, AWayLeadsIntoTheJointThatTheSheathCameInto) {
  cases::CaseData data = wrist_with_skin();
  cases::ArthroscopicMap map = *data.arthroscopy;
  cases::JointSpace other = map.joints.front();  // far off: nothing is there
  other.id = "midcarpal";
  GridGeometry far = other.wall.geometry();
  far.origin = far.origin + Vec3{0, 0, 300};
  const auto values = other.wall.values();
  other.wall = Grid<float>(far, {values.begin(), values.end()});
  map.joints.push_back(other);
  map.portals.front().joint = 1;
  data.arthroscopy = std::make_shared<const cases::ArthroscopicMap>(map);
  World world(data, from_the_skin(), 1);
  Maker maker(world);
  make_portal(maker, 0.0);
  ASSERT_EQ(world.now().skin.way_count, 1);
  EXPECT_EQ(world.now().skin.ways[0].joint, 0);
  maker.take(kScope);
  maker.hand.go(at(15));
  maker.hand.go(at(-9), 300);
  EXPECT_TRUE(world.now().scope.facts.is_in_joint[0]);
  EXPECT_EQ(world.now().scope.facts.joint[0], 0);
}

TEST(OwnPortals, TheWayComesBackFromItsBytes) {
  World world(wrist_with_skin(), from_the_skin(), 1);
  Maker maker(world);
  make_portal(maker, kAside);
  maker.take(kScope);
  maker.hand.go(at(15, kAside));
  World again(wrist_with_skin(), from_the_skin(), 1);
  ASSERT_TRUE(again.read_state(world.write_state()));
  EXPECT_EQ(again.now().skin.ways, world.now().skin.ways);
  Input input = maker.hand.inputs.back();
  for (int i = 0; i < 900; ++i) {
    input.hands[0].tip_in_patient.x -= 0.025;
    world.step(input);
    again.step(input);
    ASSERT_EQ(world.now().state_hash, again.now().state_hash) << i;
  }
  EXPECT_TRUE(again.now().scope.facts.is_in_joint[0]);
}

TEST(OwnPortals, WithoutToolsOfAJointNoWayIsKept) {
  World world(wrist_with_skin(), making(), 1);
  Maker maker(world);
  make_portal(maker, 0.0);
  EXPECT_EQ(world.now().skin.facts.made, 1);
  EXPECT_EQ(world.now().skin.way_count, 0);
}

}  // namespace
}  // namespace carpus::simulation
