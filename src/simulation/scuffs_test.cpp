// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Cartilage that a probe presses on too hard, in a box of a joint with a bone for its ceiling.
#include "simulation/detail/scuffs.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "simulation/box_joint_test_support.hpp"
#include "simulation/world.hpp"

namespace carpus::simulation {
namespace {

using namespace box_joint;  // NOLINT(google-build-using-namespace)
using procedure::CartilageScuff;
using procedure::Scuffing;

const Vec3 kLowest = kMiddle + Vec3{0, 0, 1.0};  // of the bone

/// With the lunate hanging into the joint. @param has_cartilage  there
cases::CaseData with_lunate(bool has_cartilage) {
  cases::CaseData data = box_wrist();
  const std::uint8_t body = test::body_of(BoneId::Lunate);
  cases::Bone& lunate = data.bones[body];
  Vec3 lowest = lunate.surface.vertices.front();
  for (const Vec3& v : lunate.surface.vertices) lowest = v.z < lowest.z ? v : lowest;
  const Vec3 by = kLowest - lowest;
  for (Vec3& v : lunate.surface.vertices) v += by;
  GridGeometry geometry = lunate.distance_field.geometry();
  geometry.origin = geometry.origin + by;
  lunate.distance_field = {geometry, std::vector<float>(lunate.distance_field.values().begin(),
                                                        lunate.distance_field.values().end())};
  if (!has_cartilage) return data;
  auto map = std::make_shared<cases::ArthroscopicMap>(*data.arthroscopy);
  for (const Vec3& v : lunate.surface.vertices) {
    if (v.z < kLowest.z + 4) map->cartilage.push_back({v, {0, 0, -1}, 1.0, body, 0});
  }
  data.arthroscopy = map;
  return data;
}

/// Goes up against the bone from below it, so that it is pressed with about so much.
void press(Hand& hand, double n) {
  constexpr double kNPerMm = 2.0;  // of the coupling
  hand.go(kMiddle + Vec3{0, 0, -1.5});
  hand.go(kLowest + Vec3{0, 0, n / kNPerMm - 1.0}, 300);
}

std::vector<CartilageScuff> scuffs(const World& world) {
  return world.operation_record().scope->scuff_places;
}

TEST(Scuffs, CartilageIsScuffedWhereItIsPressedOver8N) {
  const cases::CaseData data = with_lunate(true);  // outlives its world
  World world(data, probe_alone(), 1);
  Hand hand(world);
  enter(hand);
  press(hand, 6);
  EXPECT_TRUE(scuffs(world).empty()) << "that it bears";
  const Tick before = world.now().tick;
  press(hand, 16);
  ASSERT_EQ(scuffs(world).size(), 1U);
  const CartilageScuff scuff = scuffs(world).front();
  EXPECT_EQ(scuff.body, test::body_of(BoneId::Lunate));
  EXPECT_LT(distance(scuff.at, kLowest), 2.0)
      << scuff.at.x << ' ' << scuff.at.y << ' ' << scuff.at.z;
  EXPECT_GT(scuff.force_n, 8.0);
  EXPECT_GT(scuff.tick, before);
  EXPECT_EQ(scuff.how, Scuffing::Pressed);
  EXPECT_EQ(scuff.by, *instruments::instrument_of("hook_probe"));
  press(hand, 16);
  EXPECT_EQ(scuffs(world).size(), 2U) << "let go and pressed anew";
  EXPECT_EQ(world.operation_record().scope->scuffs, 2U);
}

TEST(Scuffs, WhatBearsNoCartilageIsNotScuffed) {
  const cases::CaseData data = with_lunate(false);
  World world(data, probe_alone(), 1);
  Hand hand(world);
  enter(hand);
  press(hand, 16);
  ASSERT_GT(world.operation_record().scope->injury_ticks, 0U);
  EXPECT_TRUE(scuffs(world).empty());
}

TEST(Scuffs, TheReplayHasTheSameAndAKeyframeGoesOnWithThem) {
  const cases::CaseData data = with_lunate(true);
  World world(data, probe_alone(), 1);
  Hand hand(world);
  enter(hand);
  press(hand, 16);
  World again(data, probe_alone(), 1);
  for (const Input& input : hand.inputs) again.step(input);
  EXPECT_EQ(scuffs(again), scuffs(world));
  ASSERT_EQ(scuffs(again).size(), 1U);
  World later(data, probe_alone(), 1);
  ASSERT_TRUE(later.read_state(world.write_state()).has_value());
  EXPECT_EQ(later.write_state(), world.write_state());
  const Input held = hand.inputs.back();
  for (int i = 0; i < 300; ++i) {
    later.step(held);
    world.step(held);
  }
  EXPECT_EQ(scuffs(later), scuffs(world));
  EXPECT_EQ(scuffs(later).size(), 1U) << "it is one press all the time";
  EXPECT_EQ(later.operation_record().scope->smoothness, world.operation_record().scope->smoothness);
  EXPECT_GE(world.operation_record().scope->smoothness[1].stretches, 2U);
}

TEST(Scuffs, ASlidingTipScuffsOnAndOnButOnePlaceIsOne) {
  detail::HardPress press;
  EXPECT_FALSE(detail::presses_anew(press, {}, 8.0));
  EXPECT_TRUE(detail::presses_anew(press, {}, 8.1));
  EXPECT_FALSE(detail::presses_anew(press, {1.9, 0, 0}, 9.0));
  EXPECT_TRUE(detail::presses_anew(press, {2.1, 0, 0}, 9.0));
  EXPECT_FALSE(detail::presses_anew(press, {2.1, 0, 0}, 3.5)) << "not yet let go";
  EXPECT_FALSE(detail::presses_anew(press, {2.1, 0, 0}, 9.0));
  EXPECT_FALSE(detail::presses_anew(press, {2.1, 0, 0}, 3.0));
  EXPECT_TRUE(detail::presses_anew(press, {2.1, 0, 0}, 9.0));
}

TEST(Scuffs, AllAreCountedAndTheFirstAreKept) {
  detail::ScopeConduct conduct;
  for (std::uint32_t i = 0; i < detail::kMaxScuffPlaces + 3; ++i) {
    add_scuff(conduct, {i, 1, {1.0 * i, 0, 0}, 9, 2, Scuffing::Shaved});
  }
  EXPECT_EQ(conduct.scuffs, detail::kMaxScuffPlaces + 3);
  EXPECT_EQ(conduct.places.back().tick, detail::kMaxScuffPlaces - 1);
  EXPECT_TRUE(is_possible(conduct, 2, 3));
  EXPECT_FALSE(is_possible(conduct, 1, 3)) << "of a bone that is not there";
  EXPECT_FALSE(is_possible(conduct, 2, 2)) << "by what is not there";
  detail::ScopeConduct wrong = conduct;
  wrong.scuffs = 5;
  EXPECT_FALSE(is_possible(wrong, 2, 3)) << "a place of none";
  wrong = conduct;
  wrong.places[3].how = static_cast<Scuffing>(3);
  EXPECT_FALSE(is_possible(wrong, 2, 3));
  wrong = {};
  wrong.presses[0].is_told = true;
  EXPECT_FALSE(is_possible(wrong, 2, 3)) << "pressed at no place";
}

}  // namespace
}  // namespace carpus::simulation
