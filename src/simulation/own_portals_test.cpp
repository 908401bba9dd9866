// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Joints that are entered by portals that were made before: through a plate of skin into a box,
// far from the bones.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/state_hash.hpp"
#include "simulation/portal_maker_test_support.hpp"

namespace carpus::simulation {
namespace {

using namespace box_joint;  // NOLINT(google-build-using-namespace)

constexpr double kAside = 1.5;  // of the portal's place
constexpr double kSecondY = 7;  // 4-5
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

/// 3-4 is made and the scope in by it, its sight to the side on which the second one comes in or to
/// the other; the other hand works from here on.
void look_in(Maker& maker, bool looks_there) {
  make_portal(maker, 0.0);
  maker.take(kScope);
  maker.hand.go(at(15));
  maker.hand.go(at(-7.5), 300);
  Command turn;
  turn.kind = CommandKind::TurnScope;
  turn.rotation_deg = looks_there ? -90 : 90;
  maker.hand.command(turn);
  maker.hand.led = 1;
}

/// With the needle at 4-5 into the joint, where it stays for so long.
void needle_in(Maker& maker, int ticks) {
  maker.take("needle_22g");
  maker.hand.go(at(15, kSecondY));
  maker.hand.go(at(-13, kSecondY), ticks);
}

std::uint32_t seen_ticks(const World& world) {
  return world.now().skin.facts.portal[1].needle_seen_ticks;
}

bool tells_needle(const World& world) {
  const Snapshot& now = world.now();
  return std::any_of(now.events.begin(), now.events.begin() + now.event_count,
                     [](const Event& event) { return event.kind == EventKind::NeedleSeen; });
}

TEST(OwnPortals, TheNeedleOfTheSecondIsSeenByTheScopeThatLooksThere) {
  World world(wrist_with_skin(), from_the_skin(), 1);
  Maker maker(world);
  look_in(maker, true);
  ASSERT_TRUE(world.now().scope.facts.is_in_joint[0]);
  EXPECT_EQ(seen_ticks(world), 0U);
  needle_in(maker, 0);
  EXPECT_TRUE(world.now().skin.facts.portal[1].needle.is_in);
  int told = 0;
  for (int i = 0; i < 2000; ++i) {
    maker.hand.step();
    told += tells_needle(world) ? 1 : 0;
  }
  EXPECT_GE(seen_ticks(world), 2000U);
  EXPECT_EQ(told, 1);
  EXPECT_TRUE(world.now().scope.facts.is_in_joint[0]) << "it stays in meanwhile";
}

TEST(OwnPortals, ANeedleThatComesInElsewhereThanTheScopeLooksIsNotSeen) {
  World world(wrist_with_skin(), from_the_skin(), 1);
  Maker maker(world);
  look_in(maker, false);
  needle_in(maker, 2000);
  EXPECT_TRUE(world.now().skin.facts.portal[1].needle.is_in);
  EXPECT_EQ(seen_ticks(world), 0U);
}

TEST(OwnPortals, ANeedleIsNotSeenBeforeItIsThroughTheCapsule) {
  World world(wrist_with_skin(), from_the_skin(), 1);
  Maker maker(world);
  look_in(maker, true);
  maker.take("needle_22g");
  maker.hand.go(at(15, kSecondY));
  maker.hand.go(at(-5, kSecondY), 2000);
  EXPECT_EQ(seen_ticks(world), 0U);
}

TEST(OwnPortals, WhatIsSeenOnceTheSkinIsCutComesTooLate) {
  World world(wrist_with_skin(), from_the_skin(), 1);
  Maker maker(world);
  look_in(maker, false);
  maker.prick(kSecondY, 0.0, 13.0);
  maker.cut(kSecondY);
  Command turn;
  turn.kind = CommandKind::TurnScope;
  turn.rotation_deg = -90;
  maker.hand.command(turn);
  needle_in(maker, 2000);
  EXPECT_EQ(seen_ticks(world), 0U);
}

TEST(OwnPortals, WhatIsSeenIsOfTheNeedleThatCameInLast) {
  World world(wrist_with_skin(), from_the_skin(), 1);
  Maker maker(world);
  look_in(maker, true);
  needle_in(maker, 2000);
  maker.hand.go(at(15, kSecondY), 50);
  EXPECT_GE(seen_ticks(world), 1000U);
  Command turn;
  turn.kind = CommandKind::TurnScope;
  turn.rotation_deg = 90;
  maker.hand.command(turn);
  needle_in(maker, 1000);
  EXPECT_EQ(seen_ticks(world), 0U) << "this one nobody saw";
}

TEST(OwnPortals, WhatWasSeenComesBackFromItsBytes) {
  World world(wrist_with_skin(), from_the_skin(), 1);
  Maker maker(world);
  look_in(maker, true);
  needle_in(maker, 700);
  ASSERT_GT(seen_ticks(world), 0U);
  World again(wrist_with_skin(), from_the_skin(), 1);
  ASSERT_TRUE(again.read_state(world.write_state()));
  const Input input = maker.hand.inputs.back();
  for (int i = 0; i < 600; ++i) {
    world.step(input);
    again.step(input);
    ASSERT_EQ(world.now().state_hash, again.now().state_hash) << i;
  }
  EXPECT_EQ(seen_ticks(again), seen_ticks(world));
}

/// The same bytes with another number at a place, and the checksum that goes with it.
std::vector<std::byte> forged(std::vector<std::byte> bytes, std::size_t at, std::uint32_t value) {
  constexpr std::size_t kChecksum = 8;
  for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<std::byte>(value >> (8 * i));
  const std::span all(bytes);
  StateHash hash;
  hash.add_bytes(all.first(all.size() - kChecksum));
  const std::span checksum = all.last(kChecksum);
  for (std::size_t i = 0; i < kChecksum; ++i) {
    checksum[i] = static_cast<std::byte>(hash.value() >> (8 * i));
  }
  return bytes;
}

TEST(OwnPortals, NothingWasSeenForLongerThanThereWasTime) {
  World world(wrist_with_skin(), from_the_skin(), 1);
  Maker maker(world);
  look_in(maker, true);
  needle_in(maker, 700);
  const std::uint32_t seen = seen_ticks(world);
  ASSERT_GT(seen, 255U);
  const std::vector<std::byte> good = world.write_state();
  // The last that is written of it: what was seen by portal, then by hand.
  std::array<std::byte, 4> written{static_cast<std::byte>(seen),
                                   static_cast<std::byte>(seen >> 8U)};
  const auto last = std::find_end(good.begin(), good.end(), written.begin(), written.end());
  ASSERT_NE(last, good.end());
  const auto by_hand = static_cast<std::size_t>(last - good.begin());
  const std::size_t by_portal = by_hand - 2 * sizeof(std::uint32_t);
  ASSERT_TRUE(std::equal(written.begin(), written.end(), good.begin() + by_portal));
  const auto now = static_cast<std::uint32_t>(world.now().tick);
  for (const std::size_t at : {by_hand, by_portal}) {
    EXPECT_TRUE(world.read_state(forged(good, at, now)));
    EXPECT_FALSE(world.read_state(forged(good, at, now + 1))) << at;
  }
}

void undo(Maker& maker) {
  Command back;
  back.kind = CommandKind::Undo;
  maker.hand.command(back);
}

/// Each undo goes back to before something was taken, as far as there is anything to go back to.
TEST(OwnPortals, APortalThatWasMadeStaysThroughUndoWithItsCut) {
  World world(wrist_with_skin(), from_the_skin(), 1);
  Maker maker(world);
  make_portal(maker, 0.0);
  const OwnWayView way = world.now().skin.ways[0];
  maker.take(kScope);
  maker.hand.go(at(15));
  maker.hand.go(at(-7.5), 300);
  ASSERT_TRUE(world.now().scope.facts.is_in_joint[0]);
  int undone = 0;
  for (; world.now().can_undo; ++undone) {
    undo(maker);
    EXPECT_FALSE(world.now().scope.facts.is_in_joint[0]) << "the scope is on the tray again";
    ASSERT_EQ(world.now().skin.way_count, 1);
    EXPECT_EQ(world.now().skin.ways[0], way);
    ASSERT_EQ(world.now().skin.cut_count, 1) << "it was made by that";
    EXPECT_TRUE(world.now().skin.cuts[0].is_spread);
  }
  EXPECT_EQ(undone, 5) << "needle, blade, clamp, sheath, scope";
  maker.take(kScope);
  maker.hand.go(at(15));
  maker.hand.go(at(-7.5), 300);
  EXPECT_TRUE(world.now().scope.facts.is_in_joint[0]);
  maker.hand.led = 1;
  make_portal(maker, kSecondY);
  EXPECT_EQ(world.now().skin.facts.made, 2);
  EXPECT_TRUE(world.now().skin.facts.portal[1].is_spread);
}

TEST(OwnPortals, ACutOfThePortalThatIsNotMadeYetIsUndone) {
  World world(wrist_with_skin(), from_the_skin(), 1);
  Maker maker(world);
  look_in(maker, true);
  maker.prick(kSecondY, 0.0, 13.0);
  maker.cut(kSecondY);
  maker.take("mosquito_clamp");
  ASSERT_EQ(world.now().skin.cut_count, 2);
  undo(maker);
  EXPECT_EQ(world.now().skin.cut_count, 2) << "to the clamp's taking";
  undo(maker);
  EXPECT_EQ(world.now().skin.cut_count, 1) << "to the blade's";
  EXPECT_FALSE(world.now().skin.facts.portal[1].is_cut);
  EXPECT_TRUE(world.now().scope.facts.is_in_joint[0]) << "it stays in";
  maker.cut(kSecondY);
  maker.spread(kSecondY);
  maker.enter(kSecondY);
  EXPECT_EQ(world.now().skin.facts.made, 2);
}

/// The scope had been in as the needle was taken and was put away since: back in the hand it is in
/// the joint, by its portal.
TEST(OwnPortals, AScopeThatComesBackIntoTheJointIsInItsPortal) {
  World world(wrist_with_skin(), from_the_skin(), 1);
  Maker maker(world);
  look_in(maker, true);
  maker.take("needle_22g");
  maker.hand.led = 0;
  maker.hand.go(at(15));
  ASSERT_FALSE(world.now().scope.facts.is_in_joint[0]);
  undo(maker);
  EXPECT_TRUE(world.now().scope.facts.is_in_joint[0]);
  EXPECT_EQ(world.now().scope.pull_outs, 0U) << "it did not fall out";
  maker.hand.go(at(-7.5), 300);
  EXPECT_TRUE(world.now().scope.facts.is_in_joint[0]);
  EXPECT_LT(length(world.now().hands[0].force_in_patient), 3.0) << "nothing holds it there";
  maker.hand.go(at(15), 300);
  EXPECT_FALSE(world.now().scope.facts.is_in_joint[0]) << "it comes out";
  EXPECT_GT(tip_out_mm(world), 14.0);
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
