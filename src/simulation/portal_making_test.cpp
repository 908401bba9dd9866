// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Portals made through a plate of skin over a box of a joint, far from the bones.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "simulation/asked_portals.hpp"
#include "simulation/detail/skin_surface.hpp"
#include "simulation/portal_maker_test_support.hpp"

namespace carpus::test {
// Defined once in this program, where allocation_guard_test.cpp includes it.
void start_counting_allocations() noexcept;
int stop_counting_allocations() noexcept;
}  // namespace carpus::test

namespace carpus::simulation {
namespace {

using namespace box_joint;  // NOLINT(google-build-using-namespace)

TEST(SkinSurface, TellsDepthAndWayOutOfAPlate) {
  const detail::SkinSurface skin(plate(), at(0), 200);
  const detail::SkinPlace under = skin.at(at(-3, 5, 7));
  EXPECT_NEAR(under.depth_mm, 3.0, 1e-12);
  EXPECT_NEAR(distance(under.point, at(0, 5, 7)), 0.0, 1e-12);
  EXPECT_NEAR(under.normal.x, 1.0, 1e-12);
  EXPECT_NEAR(skin.at(at(2)).depth_mm, -2.0, 1e-12);
  EXPECT_TRUE(detail::SkinSurface({}, {}, 10).is_empty());
}

TEST(AskedPortals, TheSeedDrawsTheSecondAmongThoseThatTheCaseHas) {
  cases::CaseData more = wrist_with_skin();
  procedure::PortalMaking wanted = figures();
  EXPECT_EQ((*asked_portals(more, wanted, 5))[1], 1);
  wanted.second = {"6R"};
  EXPECT_FALSE(asked_portals(more, wanted, 5).has_value());
  cases::ArthroscopicMap map = *more.arthroscopy;
  map.portals.push_back(map.portals[1]);
  map.portals.back().id = "6R";
  more.arthroscopy = std::make_shared<const cases::ArthroscopicMap>(map);
  wanted.second = {"4-5", "6R"};
  bool has_both[2] = {false, false};
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    has_both[(*asked_portals(more, wanted, seed))[1] - 1] = true;
  }
  EXPECT_TRUE(has_both[0] && has_both[1]);
}

TEST(PortalMaking, AFingerIsHeldBackBySkinAndFeelsACordWhereATendonRuns) {
  World world(wrist_with_skin(), making(), 1);
  Maker maker(world);
  maker.hand.go(at(-2), 300);
  EXPECT_LT(tip_out_mm(world), -0.5) << "skin gives";
  EXPECT_GT(tip_out_mm(world), -1.9) << "and holds";
  EXPECT_EQ(world.now().skin.feels[0].felt, Felt::Soft);
  maker.hand.go(at(-2, -8), 300);
  EXPECT_EQ(world.now().skin.feels[0].felt, Felt::Cord);
  EXPECT_GT(world.now().hands[0].force_in_patient.x, 0.5);
  maker.hand.go(at(3, -8), 50);
  EXPECT_EQ(world.now().skin.feels[0].felt, Felt::Nothing);
}

TEST(PortalMaking, AFingerThatIsPressedOnDoesNotComeOutAtTheLimbsOtherSide) {
  cases::CaseData limb = wrist_with_skin();
  TriangleMesh& skin = static_cast<TriangleMesh&>(limb.skin);
  const TriangleMesh near = skin;
  constexpr double kThickMm = 36;
  for (Vec3 corner : near.vertices)
    skin.vertices.push_back({corner.x - kThickMm, corner.y / 2, corner.z / 2});
  for (const auto& [a, b, c] : near.facets) skin.facets.push_back({a + 4, c + 4, b + 4});
  World world(limb, making(), 1);
  Maker maker(world);
  for (double deep = 0; deep < kThickMm + 10; deep += 0.5) {
    maker.hand.go(at(-deep), 30);
    ASSERT_GT(tip_out_mm(world), -10) << "pressed " << deep << " mm deep";
  }
  maker.hand.go(at(5), 100);
  EXPECT_GT(tip_out_mm(world), 0) << "it comes away as it came";
}

TEST(PortalMaking, SkinOfABentWristIsFoundWhereItLies) {
  cases::CaseData bent = wrist_with_skin();
  cases::ArthroscopicMap map = *bent.arthroscopy;
  map.joints.back().distal = test::body_of(BoneId::Capitate);
  bent.arthroscopy = std::make_shared<const cases::ArthroscopicMap>(map);
  for (const double angle : {0.6, -0.6}) {
    World world(bent, making(), 1);
    Maker maker(world);
    maker.hand.bend(angle);
    for (int i = 0; i < 5000; ++i) maker.hand.step();
    // Beside the hinge it folds, or is drawn out to twice its length.
    for (const double aside : {-14.0, 0.0, 14.0}) {
      for (double distal = -6; distal <= 14; distal += 1) {
        maker.hand.lead(at(1, aside, distal));
        for (int i = 0; i < 40; ++i) maker.hand.step();
        const Vec3& tip = world.now().items[world.now().hands[0].item].tip_in_patient;
        const Vec3 off = world.now().skin.on_skin[0] - tip;
        EXPECT_LT(std::hypot(off.y, off.z), 0.05) << aside << ", " << distal << " at " << angle;
      }
    }
  }
}

TEST(PortalMaking, OneTouchIsNotAPlaceFeltAndNothingCountsAfterThePrick) {
  World world(wrist_with_skin(), making(), 1);
  Maker maker(world);
  maker.hand.go(at(-2), 3000);
  EXPECT_EQ(std::popcount(maker.made().place_felt), 1);
  maker.hand.go(at(15), 20);
  maker.feel(0, 0);
  EXPECT_GE(std::popcount(maker.made().place_felt), 5);
  EXPECT_EQ(maker.made().landmark_felt, 0) << "the tubercle lies elsewhere";
  maker.prick();
  maker.take("fingertip");
  maker.feel(0, -10);
  EXPECT_EQ(maker.made().landmark_felt, 0) << "too late";
}

TEST(PortalMaking, AMarkerLeavesInkThatUndoTakesBack) {
  World world(wrist_with_skin(), making(), 1);
  Maker maker(world);
  maker.take("skin_marker");
  maker.hand.go(at(-1), 100);
  maker.hand.go(at(-1, 0, 6), 100);
  const std::uint8_t drawn = world.now().skin.ink_count;
  EXPECT_GE(drawn, 6);
  EXPECT_NEAR(world.now().skin.ink[0].x, kSkinX, 1e-6);
  maker.hand.go(at(15), 20);
  maker.take("needle_22g");
  EXPECT_EQ(world.now().skin.ink_count, drawn);
  Command undo;
  undo.kind = CommandKind::Undo;
  maker.hand.command(undo);
  EXPECT_EQ(world.now().skin.ink_count, drawn) << "to the needle's taking";
  maker.hand.command(undo);
  EXPECT_EQ(world.now().skin.ink_count, 0) << "to the marker's";
}

TEST(PortalMaking, WhatIsTakenWhileAHandPressesDoesNotPrickBeforeItWasPlaced) {
  World world(wrist_with_skin(), making(), 1);
  Maker maker(world);
  maker.hand.go(at(-6), 100);
  Command take;
  take.kind = CommandKind::Take;
  take.index = tool("needle_22g");
  maker.hand.command(take);
  for (int i = 0; i < 500; ++i) maker.hand.step();
  EXPECT_FALSE(world.now().skin.under_mm[0] > 0);
  EXPECT_GT(tip_out_mm(world), 1.0);
  maker.hand.go(at(5), 50);
  maker.hand.go(at(-6), 100);
  EXPECT_GT(world.now().skin.under_mm[0], 4.0);
}

TEST(PortalMaking, ANeedleLosesResistanceInTheJointAndFluidComesBack) {
  World world(wrist_with_skin(), making(), 1);
  Maker maker(world);
  maker.take("needle_22g");
  maker.hand.go(at(-0.4), 50);
  EXPECT_FALSE(world.now().skin.under_mm[0] > 0) << "skin holds a light touch";
  maker.hand.go(at(-4), 50);
  const double in_tissue = world.now().hands[0].force_in_patient.x;
  EXPECT_GT(in_tissue, 0.4);
  EXPECT_FALSE(world.now().skin.is_wet[0]);
  maker.hand.go(at(-9), 500);
  EXPECT_TRUE(world.now().skin.is_wet[0]);
  EXPECT_LT(world.now().hands[0].force_in_patient.x, 0.5 * in_tissue);
  EXPECT_TRUE(maker.made().needle.is_in);
  EXPECT_NEAR(maker.made().needle.skin_off_mm, 0.0, 0.05);
  EXPECT_NEAR(maker.made().needle.tilt_cosine, 1.0, 1e-6);
  EXPECT_EQ(maker.made().passes, 1);
  // It goes straight: a hand that wanders aside does not take it along.
  maker.hand.go(at(-9, 4), 200);
  EXPECT_NEAR(world.now().items[world.now().hands[0].item].tip_in_patient.y, kMiddle.y, 0.05);
}

TEST(PortalMaking, ANeedleGoesInAsFarAsItsHubAndIsDryBeyondTheJoint) {
  World world(wrist_with_skin(), making(), 1);
  Maker maker(world);
  maker.take("needle_22g");
  maker.hand.go(at(-9), 500);
  ASSERT_TRUE(world.now().skin.is_wet[0]);
  maker.hand.go(at(-45), 500);
  const ItemView& needle = world.now().items[world.now().hands[0].item];
  EXPECT_NEAR(world.now().skin.under_mm[0], needle.length_mm, 0.05);
  EXPECT_GT(world.now().hands[0].force_in_patient.x, 5.0) << "the hand is told so";
  EXPECT_FALSE(world.now().skin.is_wet[0]) << "out at the other side";
  maker.hand.go(at(-9), 500);
  EXPECT_TRUE(world.now().skin.is_wet[0]);
}

TEST(PortalMaking, AnotherPassCountsAndAPlaceFarOffIsTold) {
  World world(wrist_with_skin(), making(), 1);
  Maker maker(world);
  maker.prick(5, 0);
  maker.prick(5, 0);
  EXPECT_EQ(maker.made().passes, 2);
  EXPECT_TRUE(maker.made().needle.is_in) << "luck";
  EXPECT_NEAR(maker.made().needle.inner_off_mm, 5.0, 0.1);
}

TEST(PortalMaking, WhatIsBluntIsHeldBySkinThatWasNotCut) {
  World world(wrist_with_skin(), making(), 1);
  Maker maker(world);
  maker.enter();
  EXPECT_FALSE(world.now().skin.under_mm[0] > 0);
  EXPECT_EQ(world.now().skin.facts.made, 0);
}

TEST(PortalMaking, WhatIsBluntIsToldOncePerTry) {
  World world(wrist_with_skin(), making(), 1);
  Maker maker(world);
  maker.take("mosquito_clamp");
  int told = 0;
  for (const double to : {-6.0, 15.0, -6.0}) {
    maker.hand.lead(at(to));
    for (int i = 0; i < 300; ++i) {
      maker.hand.step();
      const Snapshot& now = world.now();
      for (std::size_t e = 0; e < now.event_count; ++e) {
        told += now.events[e].kind == EventKind::HeldBySkin ? 1 : 0;
      }
    }
  }
  EXPECT_EQ(told, 2);
}

TEST(PortalMaking, ACutIsAsLongAndDeepAsTheBladeWasLed) {
  World world(wrist_with_skin(), making(), 1);
  Maker maker(world);
  maker.prick();
  maker.cut(0, 1.7, 2.5);
  maker.spread();
  maker.enter();
  EXPECT_EQ(world.now().skin.facts.made, 1);
  const procedure::CutMade& cut = maker.made().cut;
  EXPECT_NEAR(cut.length_mm, 5.0, 0.4);
  EXPECT_NEAR(cut.deepest_mm, 1.5, 0.3);
  EXPECT_NEAR(cut.along_cosine, 1.0, 0.02);
  EXPECT_LT(cut.off_mm, 0.2);
  EXPECT_EQ(maker.made().cuts, 1);
  EXPECT_EQ(maker.made().out_of_order, 0);
}

TEST(PortalMaking, WhatWasNotSpreadResistsAndIsOutOfOrder) {
  World with(wrist_with_skin(), making(), 1);
  Maker spread(with);
  spread.prick();
  spread.cut();
  spread.spread();
  EXPECT_TRUE(spread.made().is_spread);
  spread.enter(0, 8.5);
  World without(wrist_with_skin(), making(), 1);
  Maker forced(without);
  forced.cut();
  forced.enter(0, 8.5);
  EXPECT_EQ(with.now().skin.facts.made, 1);
  EXPECT_EQ(without.now().skin.facts.made, 0) << "the same push does not go in";
  forced.enter(0, 14);
  EXPECT_EQ(without.now().skin.facts.made, 1);
  EXPECT_EQ(forced.made().out_of_order,
            procedure::kCutBeforeNeedle | procedure::kSheathBeforeSpread);
  EXPECT_GT(forced.made().overrun_mm, spread.made().overrun_mm)
      << "what gives at last under force goes on";
}

TEST(PortalMaking, ABladeTooDeepReachesTheTendon) {
  World world(wrist_with_skin(), making(), 1);
  Maker maker(world);
  maker.cut(-8, 1.7);
  const auto struck = [&world] {
    const auto record = world.operation_record();
    return std::count_if(record.structures.begin(), record.structures.end(),
                         [](const auto& near) { return near.was_struck; });
  };
  EXPECT_EQ(struck(), 0);
  maker.cut(-8, 4.0);
  EXPECT_EQ(struck(), 1);
}

TEST(PortalMaking, InTheFatABladeHarmsANerveAndNotYetATendonAndTheStrikerIsNamed) {
  cases::CaseData data = wrist_with_skin();
  data.structures = {tube("tendon", anatomy::StructureKind::Tendon, 0, 3),
                     tube("nerve", anatomy::StructureKind::Nerve, 8, 3)};
  World world(data, making(), 1);
  Maker maker(world);
  const auto near = [&world](std::size_t i) { return world.operation_record().structures[i]; };
  maker.cut(0, 2.5);
  maker.cut(8, 2.5);
  EXPECT_FALSE(near(0).was_struck) << "below the fascia";
  EXPECT_TRUE(near(1).was_struck);
  EXPECT_EQ(near(1).by, tool("blade_15"));
  maker.enter(8);
  EXPECT_EQ(near(1).by, tool("blade_15")) << "though the sheath came nearer afterwards";
}

TEST(PortalMaking, ANeedleHarmsWhatItIsLedThroughThoughItFindsNoJoint) {
  World world(wrist_with_skin(), making(), 1);
  Maker maker(world);
  maker.prick(11, 0, 5.8);
  EXPECT_FALSE(maker.made().needle.is_in);
  EXPECT_EQ(maker.made().passes, 1);
  const auto nerve = world.operation_record().structures[1];
  EXPECT_TRUE(nerve.was_struck);
  EXPECT_EQ(nerve.by, tool("needle_22g"));
}

TEST(PortalMaking, HowFarOffAnythingWentInIsKeptAndFromTheOtherSideDoesNotCount) {
  World world(wrist_with_skin(), making(), 1);
  Maker maker(world);
  maker.prick(0, 0, 9);
  EXPECT_LT(maker.made().strayed_mm, 0.1);
  maker.prick(6, 0, 3);
  EXPECT_LT(maker.made().strayed_mm, 0.1) << "no pass";
  maker.prick(6, 0, 5.8);
  EXPECT_NEAR(maker.made().strayed_mm, 6.0, 0.2);
  maker.cut(-9, 2.5);
  EXPECT_NEAR(maker.made().strayed_mm, std::hypot(9.0, 2.5), 0.4);
}

/// A tendon straight in the way.
const cases::CaseData& wrist_with_tendon_in_the_way() {
  static const cases::CaseData data = [] {
    cases::CaseData made = wrist_with_skin();
    made.structures = {tube("fcr", anatomy::StructureKind::Tendon, 2.0, 4)};
    return made;
  }();
  return data;
}

TEST(PortalMaking, ATendonThatIsDrawnAsideIsNotHarmedOnceTheWayIsSpread) {
  procedure::Procedure opened = making();
  opened.making->landmarks[0].draws_aside = {"fcr"};
  opened.making->landmarks[0].is_opened_first = true;
  const auto struck = [](const procedure::Procedure& how) {
    World world(wrist_with_tendon_in_the_way(), how, 1);
    Maker maker(world);
    maker.cut(2.0, 1.7);
    maker.spread(2.0);
    maker.prick(2.0);
    maker.enter(2.0);
    EXPECT_EQ(world.now().skin.facts.made, 1);
    return std::pair(world.operation_record().structures[0].was_struck, maker.made().out_of_order);
  };
  EXPECT_EQ(struck(opened), std::pair(false, std::uint8_t{0}));
  EXPECT_EQ(struck(making()), std::pair(true, procedure::kCutBeforeNeedle));
}

TEST(PortalMaking, WhatIsBluntSlipsIntoTheCutFromItsRim) {
  World world(wrist_with_skin(), making(), 1);
  Maker maker(world);
  maker.prick();
  maker.cut();
  maker.spread(1.2);
  maker.take("scope_sheath_1_9");
  maker.hand.go(at(15, 1.2));
  Vec3 before = world.now().items[world.now().hands[0].item].tip_in_patient;
  maker.hand.listener = [&](const Snapshot& now) {
    const Vec3& tip = now.items[now.hands[0].item].tip_in_patient;
    EXPECT_LT(std::abs(tip.y - before.y), 0.021) << "it slips, it does not jump";
    before = tip;
  };
  maker.hand.go(at(-11, 1.2), 500);
  EXPECT_EQ(world.now().skin.facts.made, 1);
  EXPECT_LT(maker.made().sheath.skin_off_mm, 0.05);
}

TEST(PortalMaking, WhatComesFromTheLimbsOtherSideIsToldSo) {
  cases::CaseData turned = wrist_with_skin();
  cases::ArthroscopicMap map = *turned.arthroscopy;
  for (cases::Portal& portal : map.portals) portal.inwards = portal.inwards * -1.0;
  turned.arthroscopy = std::make_shared<const cases::ArthroscopicMap>(map);
  World world(turned, making(), 1);
  Maker maker(world);
  std::vector<std::pair<EventKind, int>> told;
  maker.hand.listener = [&](const Snapshot& now) {
    for (std::uint32_t i = 0; i < now.event_count; ++i) {
      told.emplace_back(now.events[i].kind, now.events[i].detail);
    }
  };
  maker.prick();
  maker.cut();
  maker.spread();
  maker.enter();
  for (const EventKind kind : {EventKind::FluidBack, EventKind::SkinCut, EventKind::SheathIn}) {
    EXPECT_EQ(std::count(told.begin(), told.end(), std::pair(kind, 1)), 1) << int(kind);
  }
}

TEST(PortalMaking, TheStateComesBackFromItsBytesAndGoesOnAlike) {
  World world(wrist_with_skin(), making(), 1);
  Maker maker(world);
  maker.feel(0, 0);
  maker.take("skin_marker");
  maker.hand.go(at(-1), 100);
  maker.hand.go(at(15), 20);
  maker.prick();
  maker.cut();
  maker.spread();
  maker.take("scope_sheath_1_9");
  maker.hand.go(at(15));
  maker.hand.go(at(-3), 100);
  World again(wrist_with_skin(), making(), 1);
  const std::vector<std::byte> bytes = world.write_state();
  ASSERT_TRUE(again.read_state(bytes));
  Input input = maker.hand.inputs.back();
  for (int i = 0; i < 900; ++i) {
    input.hands[0].tip_in_patient.x -= 0.01;
    world.step(input);
    again.step(input);
    ASSERT_EQ(world.now().state_hash, again.now().state_hash) << i;
  }
  EXPECT_EQ(again.now().skin.facts.made, 1);
  EXPECT_EQ(again.now().skin.ink_count, 1);
}

TEST(PortalMaking, NoTickAllocates) {
  World world(wrist_with_skin(), making(), 1);
  Maker maker(world);
  Input input = maker.hand.inputs.back();
  for (const char* id : {"fingertip", "skin_marker", "needle_22g", "blade_15"}) {
    input.command.kind = CommandKind::Take;
    input.command.index = tool(id);
    carpus::test::start_counting_allocations();
    for (int i = 0; i < 400; ++i) {
      input.hands[0].tip_in_patient = at(i < 200 ? 10 - 0.1 * i : -10 + 0.1 * (i - 200));
      world.step(input);
      input.command = {};
    }
    EXPECT_EQ(carpus::test::stop_counting_allocations(), 0) << id;
  }
}

}  // namespace
}  // namespace carpus::simulation
