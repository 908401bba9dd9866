// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "session/skin_message.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "instruments/instrument.hpp"
#include "session/descriptions.hpp"
#include "session/scope_message.hpp"

namespace carpus::session {
namespace {

/// Two portals into one joint and one into another, a place of the tour in each.
cases::CaseData with_portals() {
  cases::CaseData data;
  data.bones.emplace_back();
  data.bones.back().bone = BoneId::Radius;
  cases::ArthroscopicMap map;
  map.joints.push_back({"radiocarpal", "radiocarpal joint", {}, 0, 0});
  map.joints.push_back({"midcarpal", "midcarpal joint", {}, 0, 0});
  for (const char* id : {"3-4", "4-5", "MCR"}) {
    cases::Portal portal;
    portal.id = id;
    portal.name = std::string(id) + " portal";
    portal.joint = map.portals.size() == 2 ? 1 : 0;
    portal.skin = {static_cast<double>(map.portals.size()), 0, 0};
    map.portals.push_back(portal);
  }
  for (const int number : {2, 21}) {
    cases::TourPoint place;
    place.number = number;
    place.joint = number == 21 ? 1 : 0;
    map.points.push_back(place);
  }
  data.arthroscopy = std::make_shared<const cases::ArthroscopicMap>(map);
  return data;
}

procedure::Procedure looking_by_own() {
  procedure::Procedure made;
  made.tray = {instruments::instrument_of("arthroscope_1_9_30").value()};
  made.making.emplace();
  made.making->first = "3-4";
  made.making->second = {"4-5"};
  return made;
}

TEST(SkinMessage, TellsPortalsWhereTheyWereMadeAndIntoWhichJoint) {
  const cases::CaseData data = with_portals();
  simulation::Snapshot now;
  EXPECT_FALSE(skin_message(data, BodyNames(data), now)) << "no skin is worked on";
  now.skin.is_there = true;
  EXPECT_TRUE(skin_message(data, BodyNames(data), now)->ways.empty());
  now.skin.ways[0] = {1, 1, {5, 6, 7}, {0, 0, -1}, 9.5};
  now.skin.way_count = 1;
  const auto message = skin_message(data, BodyNames(data), now);
  ASSERT_EQ(message->ways.size(), 1U);
  EXPECT_EQ(message->ways[0].id, "4-5");
  EXPECT_EQ(message->ways[0].joint, "midcarpal") << "missed, and come into the other one";
  EXPECT_EQ(message->ways[0].skin_mm, (Vec3{5, 6, 7}));
  EXPECT_DOUBLE_EQ(message->ways[0].capsule_mm, 9.5);
}

/// An assessed page tells no step, and this alone.
TEST(SkinMessage, TheTaskNamesTheSecondPortalAndNoLandmark) {
  cases::CaseData data = with_portals();
  cases::ArthroscopicMap map = *data.arthroscopy;
  map.portals[1].name = "4-5 portal";
  map.portals[1].landmarks = "between the tendons";
  data.arthroscopy = std::make_shared<const cases::ArthroscopicMap>(map);
  procedure::Procedure made = looking_by_own();
  made.making->task = "Make the {second}.";
  simulation::Snapshot opening;
  opening.mode = procedure::Mode::Assessed;
  EXPECT_EQ(exercise_message(data, made, {}, opening).task, "Make the 4-5 portal.");
  made.making.reset();
  EXPECT_FALSE(exercise_message(data, made, {}, opening).task);
}

TEST(SkinMessage, TheNeedlesStepSaysWhatGoesBeforeItWhereTheWayIsOpenedFirst) {
  const cases::CaseData data = with_portals();
  procedure::Procedure made = looking_by_own();
  made.making->landmarks = {{"4-5", "3-4"}};
  const std::string said = "{second_before_needle}Prick it.";
  EXPECT_EQ(with_second_portal(said, data, made, 1), "Prick it.");
  made.making->landmarks[0].before_needle = "First cut. ";
  EXPECT_EQ(with_second_portal(said, data, made, 1), "First cut. Prick it.");
}

TEST(SkinMessage, WherePortalsThatAreToBeMadeLieIsNotTold) {
  const cases::CaseData data = with_portals();
  const auto message = arthroscopy_of(data, looking_by_own(), 1, {});
  ASSERT_TRUE(message);
  EXPECT_TRUE(message->portals.empty());
  ASSERT_EQ(message->points.size(), 1U) << "the other joint is not looked into";
  EXPECT_EQ(message->points[0].number, 2);
}

}  // namespace
}  // namespace carpus::session
