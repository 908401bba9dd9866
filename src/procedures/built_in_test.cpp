// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedures/built_in.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <regex>
#include <string>
#include <vector>

#include "arthroscopy/portal_table.hpp"
#include "cases/make_hand_motion.hpp"
#include "cases/synthetic_case_test_support.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "procedure/second_portals.hpp"
#include "procedures/dorsal_scaphoid_fixation/declared.hpp"
#include "procedures/volar_scaphoid_fixation/declared.hpp"

namespace carpus::procedures {
namespace {

/// Two portals dorsal of the radius into a joint without walls, places to go to and a disc.
cases::ArthroscopicMap portals_of(const cases::CaseData& data) {
  cases::ArthroscopicMap map;
  for (std::size_t b = 0; b < data.bones.size(); ++b) {
    if (data.bones[b].bone != BoneId::Radius) continue;
    const auto body = static_cast<std::uint8_t>(b);
    const Vec3 dorsal = (data.wrist_from_patient.inverse() * Direction<frame::Wrist>{{0, 0, -1}}).v;
    const Vec3 skin = data.bones[b].surface.vertices.front() + dorsal * 30.0;
    map.joints.push_back({"radiocarpal", "radiocarpal joint", {}, body, body});
    map.portals.push_back({"3-4", "3-4 portal", "", 0, true, 0, skin, -dorsal, 12, 1, body, {}});
    map.portals.push_back({"4-5", "4-5 portal", "", 1, true, 0, skin, -dorsal, 12, 1, body, {}});
    for (const int number : {2, 7, 8, 11, 12, 15, 16, 17}) {
      cases::TourPoint place;
      place.number = number;
      place.body = body;
      map.points.push_back(place);
    }
    map.disc_sheet = data.bones[b].surface;  // any surface will do
  }
  return map;
}

/// With the motion of its hand, made as for any case.
const cases::CaseData& wrist() {
  static const cases::CaseData data = [] {
    cases::CaseData made = cases::test::synthetic_case();
    cases::ensure_hand_motion(made);
    made.skin.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};  // any will do
    made.skin.facets = {{0, 1, 2}};
    made.arthroscopy = std::make_shared<const cases::ArthroscopicMap>(portals_of(made));
    return made;
  }();
  return data;
}

TEST(BuiltIn, WithoutANameTheDorsalFixationIsOperated) {
  EXPECT_EQ(built_in().all().front()->id, "dorsal_scaphoid_fixation");
}

TEST(BuiltIn, FixationsStandTogetherAndArthroscopyGoesFromTheBasicsToTheExamination) {
  const auto all = built_in().all();
  const auto place = [&](std::string_view id) {
    return std::ranges::find(all, id, [](const auto* one) { return std::string_view(one->id); }) -
           all.begin();
  };
  EXPECT_EQ(place("volar_scaphoid_fixation"), 1);
  EXPECT_EQ(place("arthroscopic_basics"), 2);
  EXPECT_EQ(place("arthroscopic_basics_harder"), 3);
  EXPECT_LT(place("diagnostic_arthroscopy"), place("arthroscopy_from_the_skin"));
  EXPECT_LT(place("arthroscopic_portal_making"), place("arthroscopy_from_the_skin"));
  EXPECT_EQ(all.back()->id, "arthroscopic_examination");
}

TEST(BuiltIn, OffersEveryFolder) {
  ASSERT_EQ(built_in().all().size(), 13U);
  EXPECT_NE(built_in().find("arthroscopy_from_the_skin"), nullptr);
  EXPECT_NE(built_in().find("arthroscopic_portal_making"), nullptr);
  EXPECT_NE(built_in().find("arthroscopic_portal_making_harder"), nullptr);
  EXPECT_NE(built_in().find("arthroscopic_basics"), nullptr);
  EXPECT_NE(built_in().find("arthroscopic_basics_harder"), nullptr);
  EXPECT_NE(built_in().find("arthroscopic_disc_debridement"), nullptr);
  EXPECT_NE(built_in().find("arthroscopic_examination"), nullptr);
  EXPECT_NE(built_in().find("arthroscopic_loose_body_removal"), nullptr);
  EXPECT_NE(built_in().find("arthroscopic_screw_control"), nullptr);
  EXPECT_NE(built_in().find("arthroscopic_synovectomy"), nullptr);
  EXPECT_NE(built_in().find("diagnostic_arthroscopy"), nullptr);
  EXPECT_NE(built_in().find("dorsal_scaphoid_fixation"), nullptr);
  EXPECT_NE(built_in().find("volar_scaphoid_fixation"), nullptr);
  EXPECT_EQ(built_in().find("four_corner_fusion"), nullptr);
}

TEST(BuiltIn, HarderBasicSkillsDifferInWhatTheyDemandAlone) {
  const auto& basics = *built_in().find("arthroscopic_basics");
  const auto& harder = *built_in().find("arthroscopic_basics_harder");
  EXPECT_GT(harder.drill->hold_s, basics.drill->hold_s);
  EXPECT_LT(harder.drill->middle_deg, basics.drill->middle_deg);
  EXPECT_LT(harder.drill->still_mm, basics.drill->still_mm);
  EXPECT_LT(harder.drill->touch_mm, basics.drill->touch_mm);
  EXPECT_LT(harder.drill->line_mm, basics.drill->line_mm);
  EXPECT_EQ(harder.drill->hold, basics.drill->hold);
  EXPECT_EQ(harder.steps.size(), basics.steps.size());
  EXPECT_EQ(harder.rules.items.size(), basics.rules.items.size());
}

TEST(BuiltIn, StepsNameNothingThatNobodyFillsIn) {
  // The second portal by session/skin_message, the others by the page,
  // web/src/scope/portal_words_model.
  const std::regex known(
      R"(\{(second|second_landmarks|second_before_needle|(scope|tool):(radiocarpal|midcarpal))\})");
  for (const procedure::Procedure* each : built_in().all()) {
    for (const procedure::Step& step : each->steps) {
      const std::string left = std::regex_replace(step.instruction, known, "");
      EXPECT_EQ(left.find_first_of("{}"), std::string::npos) << each->id << ": " << left;
      EXPECT_EQ(step.title.find_first_of("{}"), std::string::npos)
          << each->id << ": " << step.title;
    }
  }
}

TEST(BuiltIn, EachCanBeDoneAndScored) {
  const cases::CaseData& data = wrist();
  for (const procedure::Procedure* each : built_in().all()) {
    ASSERT_NE(each->opening, nullptr) << each->id;
    ASSERT_NE(each->score, nullptr) << each->id;
    if (each->making && each->making->needs_structures) {
      EXPECT_THROW((void)each->opening(data), InvalidInput) << "nothing lies beside a portal";
      continue;
    }
    // A screw is laid between the walls of joints, which this wrist lacks.
    if (each->controls_screw) {
      EXPECT_THROW((void)each->opening(data), InvalidInput);
    }
    const procedure::Opening opening =
        each->controls_screw ? procedure::Opening{} : each->opening(data);
    EXPECT_NEAR(length(opening.shaft_in_target), 1.0, 1e-9);
    for (const cases::Bone& bone : data.bones) {
      if (bone.bone != each->target || each->controls_screw) continue;
      for (const Vec3& v : bone.surface.vertices) {
        ASSERT_GT(distance(opening.tip_in_target, v), 50.0) << each->id << ": outside all tissue";
      }
    }
    double possible = 0;
    for (const procedure::ScoreItem& item : each->score(data, {}).items) {
      possible += item.points_possible;
    }
    EXPECT_DOUBLE_EQ(possible, 100.0) << each->id;
    for (const procedure::ScoreRule& rule : each->rules.items) {
      EXPECT_EQ(rule.mark.front(), '[') << each->id << " " << rule.id << ": says where it is from";
    }
    for (const procedure::Step& step : each->steps) {
      EXPECT_EQ(step.instruction.back(), '.') << each->id << " " << step.id;
    }
  }
}

/// Every portal of the table is asked for in one of both grades.
TEST(BuiltIn, NoPortalIsPassedOverInSilence) {
  std::vector<std::string> known;
  for (const char* id : {"arthroscopic_portal_making", "arthroscopic_portal_making_harder"}) {
    const procedure::PortalMaking& making = *built_in().find(id)->making;
    known.insert(known.end(), making.second.begin(), making.second.end());
    for (const procedure::PortalLandmark& each : making.landmarks) {
      EXPECT_FALSE(each.endangers.empty()) << each.portal;
    }
    EXPECT_EQ(making.first, "3-4");
    EXPECT_NE(making.task.find("{second}"), std::string::npos) << "of an assessed one nothing else";
    EXPECT_EQ(making.task.find("{second_landmarks}"), std::string::npos)
        << "but not how it is found";
  }
  known.emplace_back("3-4");
  std::sort(known.begin(), known.end());
  std::vector<std::string> all;
  for (const auto& portal : arthroscopy::PortalTable::generic().portals) all.push_back(portal.id);
  std::sort(all.begin(), all.end());
  EXPECT_EQ(known, all);
}

TEST(BuiltIn, APortalWhoseDangersAreNotThereIsNotAskedFor) {
  const auto* harder = built_in().find("arthroscopic_portal_making_harder");
  cases::CaseData data = wrist();
  cases::ArthroscopicMap map = *data.arthroscopy;
  map.portals.push_back(map.portals[1]);
  map.portals.back().id = "6U";
  data.arthroscopy = std::make_shared<const cases::ArthroscopicMap>(map);
  data.structures.clear();
  EXPECT_TRUE(procedure::second_portals(data, *harder->making).empty());
  EXPECT_THROW((void)harder->opening(data), InvalidInput);
  for (const char* id : {"dsbun", "ecu"}) {
    data.structures.emplace_back();
    data.structures.back().id = id;
  }
  EXPECT_EQ(procedure::second_portals(data, *harder->making), std::vector<std::uint8_t>{2});
  EXPECT_NO_THROW((void)harder->opening(data));
}

TEST(BuiltIn, PortalsAreMadeThroughSkinAndTwo) {
  const auto* making = built_in().find("arthroscopic_portal_making");
  cases::CaseData data = wrist();
  data.skin = {};
  EXPECT_THROW((void)making->opening(data), InvalidInput);
  data.skin = wrist().skin;
  cases::ArthroscopicMap map = *data.arthroscopy;
  map.portals[1].id = "1-2";
  data.arthroscopy = std::make_shared<const cases::ArthroscopicMap>(map);
  EXPECT_THROW((void)making->opening(data), InvalidInput);
}

TEST(BuiltIn, LooseBodiesNeedPlacesToLieBy) {
  cases::CaseData data = wrist();
  cases::ArthroscopicMap map = *data.arthroscopy;
  map.points.resize(2);
  data.arthroscopy = std::make_shared<const cases::ArthroscopicMap>(map);
  const auto* removal = built_in().find("arthroscopic_loose_body_removal");
  EXPECT_THROW((void)removal->opening(data), InvalidInput);
}

TEST(BuiltIn, WhatIsShavedMustBeThere) {
  const auto problem_of = [](const char* id, auto change) -> std::string {
    cases::CaseData data = wrist();
    cases::ArthroscopicMap map = *data.arthroscopy;
    change(map);
    data.arthroscopy = std::make_shared<const cases::ArthroscopicMap>(map);
    try {
      (void)built_in().find(id)->opening(data);
    } catch (const InvalidInput& problem) {
      return problem.what();
    }
    return "";
  };
  const auto without_disc = [](cases::ArthroscopicMap& map) { map.disc_sheet = {}; };
  const auto without_places = [](cases::ArthroscopicMap& map) { map.points.resize(4); };
  EXPECT_EQ(problem_of("arthroscopic_disc_debridement", without_disc),
            "debridement of the disc: this wrist has no disc; choose another case");
  EXPECT_EQ(problem_of("arthroscopic_synovectomy", without_disc), "") << "is not about the disc";
  EXPECT_NE(problem_of("arthroscopic_synovectomy", without_places)
                .find("too few of the places at which synovium may be inflamed"),
            std::string::npos);
  EXPECT_EQ(problem_of("arthroscopic_disc_debridement", without_places), "");
}

TEST(BuiltIn, FixationsBeginWithAWireInTheHand) {
  for (const procedure::Procedure* each :
       {&dorsal_scaphoid_fixation::declared(), &volar_scaphoid_fixation::declared()}) {
    EXPECT_EQ(instruments::catalogue()[each->tray.front()].work, instruments::Work::Drill)
        << each->id;
  }
}

TEST(BuiltIn, TheHandWaitsWhereTheBoneIsReached) {
  const cases::CaseData& data = wrist();
  const auto& axis = data.scaphoid.central_axis;
  const procedure::Opening dorsal = dorsal_scaphoid_fixation::declared().opening(data);
  EXPECT_LT(distance(dorsal.tip_in_target, axis.proximal),
            distance(dorsal.tip_in_target, axis.distal));
  EXPECT_GT(dorsal.wrist.flexion_rad, 0.0) << "flexed, out of the radius' way";
  ASSERT_TRUE(dorsal.at_first.has_value());
  EXPECT_EQ(dorsal.at_first->flexion_rad, 0.0) << "straight: to pose it is a step";
  const procedure::Opening volar = volar_scaphoid_fixation::declared().opening(data);
  EXPECT_LT(distance(volar.tip_in_target, axis.distal),
            distance(volar.tip_in_target, axis.proximal));
  EXPECT_LT(volar.wrist.flexion_rad, 0.0) << "extended over a roll";
  EXPECT_LT(volar.wrist.radial_deviation_rad, 0.0) << "in ulnar deviation";
}

/// Whoever only advances and drives has neither found the entry nor aimed.
TEST(BuiltIn, TheDorsalHandWaitsNeitherAtTheEntryNorOnTheLine) {
  for (const Side side : {Side::Left, Side::Right}) {
    cases::CaseData data = wrist();
    data.side = side;
    const auto opening = dorsal_scaphoid_fixation::declared().opening(data);
    const Vec3& shaft = opening.shaft_in_target;
    const double cosine = std::clamp(-dot(shaft, opening.aim.direction), -1.0, 1.0);
    EXPECT_GT(degrees_from_radians(std::acos(cosine)), 15.0);
    const Vec3 to_entry = opening.aim.entry - opening.tip_in_target;
    EXPECT_GT(length(to_entry - shaft * dot(to_entry, shaft)), 4.0);
  }
}

/// The wire that starts blind goes 45 degrees dorsal and 45 degrees ulnar, on either side.
TEST(BuiltIn, TheVolarHandWaitsAtTheBlindAim) {
  for (const Side side : {Side::Left, Side::Right}) {
    cases::CaseData data = wrist();
    data.side = side;
    const Vec3 into = -(data.wrist_from_patient *
                        Direction<frame::Patient>{
                            volar_scaphoid_fixation::declared().opening(data).shaft_in_target})
                           .v;
    const double ulnar = side == Side::Left ? into.y : -into.y;
    EXPECT_NEAR(ulnar / into.x, 1.0, 1e-9);
    EXPECT_NEAR(-into.z / into.x, 1.0, 1e-9) << "dorsal";
    EXPECT_GT(into.x, 0.0) << "proximal";
  }
}

TEST(BuiltIn, ACaseWithoutTheTargetIsRefusedWithTheReason) {
  for (const procedure::Procedure* each : built_in().all()) {
    cases::CaseData data = wrist();
    std::erase_if(data.bones, [&](const cases::Bone& bone) { return bone.bone == each->target; });
    EXPECT_THROW((void)each->opening(data), InvalidInput) << each->id;
  }
}

}  // namespace
}  // namespace carpus::procedures
