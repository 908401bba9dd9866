// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "session/event_text.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "session/refusal_text.hpp"
#include "simulation/operation_test_support.hpp"

namespace carpus::session {
namespace {

using simulation::Event;
using simulation::EventKind;
using simulation::test::exercise;
using simulation::test::wrist;

protocol::LoggedEvent described(Event event) {
  return describe(event, exercise(), BodyNames(wrist()));
}

TEST(EventText, EveryKindHasItsOwnNameAndASentence) {
  std::set<std::string> kinds;
  constexpr int kLast = static_cast<int>(EventKind::ViewClouded);
  std::size_t count = 0;
  for (int i = 1; i <= kLast; ++i) {
    // Kinds come in groups; between them numbers are free.
    if (name_of(static_cast<EventKind>(i)) == "none") continue;
    ++count;
    Event event;
    event.kind = static_cast<EventKind>(i);
    event.instrument = 0;
    event.detail = 1;
    event.value = 2.0;
    const protocol::LoggedEvent told = described(event);
    EXPECT_FALSE(told.text.empty()) << told.kind;
    EXPECT_NE(told.kind, "none") << i;
    kinds.insert(told.kind);
  }
  EXPECT_EQ(kinds.size(), count);
  EXPECT_EQ(count, 39U);
}

TEST(EventText, OfAScrewSaysWhereItWasFelt) {
  Event event;
  event.kind = EventKind::ScrewProbed;
  event.detail = 1;
  EXPECT_EQ(described(event).kind, "screw_probed");
  EXPECT_NE(described(event).text.find("scaphocapitate"), std::string::npos);
}

TEST(EventText, NamesInstrumentsAndBonesAsPeopleDo) {
  Event event;
  event.kind = EventKind::WrongBone;
  event.instrument = *instruments::instrument_of("guide_wire");
  event.detail = simulation::test::body_of(BoneId::Radius);
  EXPECT_EQ(described(event).text, instruments::catalogue()[event.instrument].name +
                                       " entered the radius, which is not to be entered");
}

TEST(EventText, CartilageThatWasPressedTooHardIsToldWithItsBoneWhereBonesMayBeNamed) {
  Event event;
  event.kind = EventKind::CartilagePressed;
  event.instrument = *instruments::instrument_of("hook_probe");
  event.detail = 0;
  const std::string text = described(event).text;
  EXPECT_NE(text.find("pressed on the cartilage of the "), std::string::npos) << text;
  EXPECT_EQ(described(event).kind, "cartilage_pressed");
}

TEST(EventText, AShaverThatHarmsIsToldAgainstWhat) {
  Event event;
  event.kind = EventKind::ShaverHarmed;
  event.instrument = *instruments::instrument_of("shaver_2_0");
  const auto text = [&](std::uint8_t detail) {
    event.detail = detail;
    return described(event).text;
  };
  EXPECT_NE(text(0).find("what lines the joint"), std::string::npos) << text(0);
  EXPECT_NE(text(1).find("cartilage"), std::string::npos) << text(1);
  EXPECT_NE(text(2).find("the scope"), std::string::npos) << text(2);
  EXPECT_EQ(text(0).find("Shaver"), 0U) << text(0);
  event.kind = EventKind::SoundTissueShaved;
  EXPECT_NE(text(1).find("rim"), std::string::npos) << text(1);
  EXPECT_EQ(text(0).find("rim"), std::string::npos) << text(0);
}

TEST(EventText, APunchThatBitCartilageIsToldSo) {
  Event event;
  event.kind = EventKind::TissueBitten;
  event.instrument = *instruments::instrument_of("punch_2_0");
  event.detail = 0;
  EXPECT_NE(described(event).text.find("lines the joint"), std::string::npos);
  event.detail = 1;
  EXPECT_NE(described(event).text.find("cartilage"), std::string::npos);
  EXPECT_EQ(described(event).text.find("Basket punch"), 0U) << described(event).text;
}

TEST(EventText, AnAssessedOperationIsToldWhatAHandFeelsAlone) {
  const auto told = [](EventKind kind) {
    Event event;
    event.kind = kind;
    event.instrument = 0;
    event.detail = simulation::test::body_of(BoneId::Scaphoid);
    return describe_blind(event, exercise(), BodyNames(wrist()));
  };
  for (const EventKind kind : {EventKind::LeftFarSide, EventKind::WrongBone, EventKind::Seated,
                               EventKind::StepCompleted}) {
    EXPECT_FALSE(told(kind).has_value()) << name_of(kind);
  }
  for (const EventKind kind :
       {EventKind::TouchedBone, EventKind::EnteredBone, EventKind::Slipped}) {
    ASSERT_TRUE(told(kind).has_value());
    EXPECT_EQ(told(kind)->text.find("scaphoid"), std::string::npos) << told(kind)->text;
    EXPECT_FALSE(told(kind)->text.empty());
  }
}

TEST(EventText, NamesStepsByTheirTitles) {
  Event event;
  event.kind = EventKind::StepCompleted;
  event.detail = 1;
  EXPECT_EQ(described(event).text, "Step done: Drive");
  event.kind = EventKind::Undone;
  event.detail = 2;
  EXPECT_EQ(described(event).text, "Back to step: Drive");
  event.detail = 0;
  EXPECT_EQ(described(event).text, "Back to the last checkpoint");
}

TEST(RefusalText, EveryRefusalHasItsOwnReason) {
  std::set<std::string> reasons;
  constexpr int kLast = static_cast<int>(simulation::Refusal::NoWayBackToStep);
  for (int i = 1; i <= kLast; ++i) {
    reasons.insert(std::string(text_of(static_cast<simulation::Refusal>(i))));
  }
  EXPECT_EQ(reasons.size(), static_cast<std::size_t>(kLast));
  EXPECT_TRUE(text_of(simulation::Refusal::None).empty());
}

}  // namespace
}  // namespace carpus::session
