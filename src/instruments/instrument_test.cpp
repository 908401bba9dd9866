// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "instruments/instrument.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "core/error.hpp"
#include "instruments/drilling_resistance.hpp"

namespace carpus::instruments {
namespace {

using Json = nlohmann::json;

const Instrument& one(const char* id) {
  const auto index = instrument_of(id);
  EXPECT_TRUE(index.has_value()) << id;
  return catalogue()[index.value_or(0)];
}

TEST(Catalogue, HoldsWhatTheProceduresNeedUnderIdsOfItsOwn) {
  std::set<std::string> ids;
  for (const Instrument& instrument : catalogue()) {
    EXPECT_TRUE(ids.insert(instrument.id).second) << instrument.id;
    EXPECT_FALSE(instrument.name.empty() || instrument.use.empty() || instrument.mark.empty());
    EXPECT_FALSE(instrument.parts.empty()) << instrument.id << " is drawn";
    // A fingertip and a pen of plastic are no metal; all else shows in the beam.
    const bool is_metal = !instrument.skin || (instrument.skin->work != SkinWork::Palpate &&
                                               instrument.skin->work != SkinWork::Mark);
    EXPECT_NE(instrument.rods.empty(), is_metal) << instrument.id;
    EXPECT_FALSE(instrument.is_confirmed) << "no maker's guide was checked yet";
  }
  for (const char* id :
       {"guide_wire", "second_wire", "joystick_wire", "needle_sleeve_14g", "depth_gauge",
        "cannulated_drill", "probe", "acutrak_2_mini_24", "acutrak_standard_1994_12_5"}) {
    EXPECT_TRUE(ids.contains(id)) << id;
  }
  EXPECT_FALSE(instrument_of("scalpel").has_value());
}

TEST(Catalogue, TheGuideWireIsThatOfBefore) {
  const Instrument& wire = one("guide_wire");
  EXPECT_EQ(wire.shape.kind(), ShapeKind::ConeTip);
  EXPECT_EQ(wire.shape.greatest_radius_mm(), 0.57);
  EXPECT_NEAR(wire.shape.back_z_mm(), 80.0, 0.57);
  EXPECT_EQ(wire.length_mm, 150.0);
  EXPECT_EQ(wire.cut_tip_radius_mm, 0.57);
  EXPECT_TRUE(wire.stays);
}

TEST(Catalogue, FeedsAreThoseOfBeforeToTheBit) {
  const Feed& wire = one("guide_wire").feed;
  const Feed& screw = one("acutrak_2_mini_24").feed;
  for (double hu = -1000; hu < 2000; hu += 37) {
    const double bone = wire_resistance_n(hu);
    EXPECT_EQ(resistance_n(wire, bone), bone);
    EXPECT_EQ(resistance_n(screw, bone), 2.0 + 0.5 * bone);
    for (double thrust = 0; thrust <= 60; thrust += 7.5) {
      EXPECT_EQ(speed_mm_per_s(wire, thrust, bone), std::clamp(0.4 * (thrust - bone), 0.0, 8.0));
      EXPECT_EQ(speed_mm_per_s(screw, thrust, bone), std::clamp(0.25 * (thrust - bone), 0.0, 2.0));
    }
  }
  EXPECT_EQ(wire.back_mm_per_s, 6.0);
  EXPECT_EQ(screw.back_mm_per_s, 2.0);
}

RC_GTEST_PROP(Feed, SpeedGrowsWithThrustAndIsNoneBelowTheResistance, ()) {
  const Instrument& any = catalogue()[*rc::gen::inRange<std::size_t>(0, catalogue().size())];
  const double thrust = *rc::gen::inRange(0, 60);
  const double bone = wire_resistance_n(*rc::gen::inRange(-1000, 3000));
  const double needed = resistance_n(any.feed, bone);
  RC_ASSERT(speed_mm_per_s(any.feed, thrust + 1, needed) >=
            speed_mm_per_s(any.feed, thrust, needed));
  RC_ASSERT(speed_mm_per_s(any.feed, needed, needed) == 0.0);
}

TEST(Catalogue, WhatRunsOnTheWireTakesIt) {
  const double wire = one("guide_wire").cut_tip_radius_mm;
  for (const Instrument& instrument : catalogue()) {
    if (instrument.bore_radius_mm == 0) continue;
    EXPECT_GE(instrument.bore_radius_mm, wire) << instrument.id;
    EXPECT_LT(instrument.bore_radius_mm, instrument.shape.greatest_radius_mm()) << instrument.id;
  }
  EXPECT_LT(one("acutrak_2_mini_24").bore_radius_mm, one("joystick_wire").cut_tip_radius_mm);
}

TEST(Catalogue, ScrewsComeByFamilyAndLengthAsTrueSizesSayThenArthroscopyThenSkinThenPunches) {
  const auto all = catalogue();
  std::size_t first = 0;
  while (all[first].family.empty()) ++first;
  std::size_t end = first;
  while (end < all.size() && all[end].work == Work::Thread) ++end;
  EXPECT_EQ(end - first, 16U);
  std::size_t skin = end;
  while (skin < all.size() && !all[skin].skin) ++skin;
  EXPECT_LT(end, skin);
  for (std::size_t i = end; i < skin; ++i) EXPECT_TRUE(all[i].enters_joints) << all[i].id;
  std::size_t bites = skin;
  while (bites < all.size() && !all[bites].bite) ++bites;
  EXPECT_LT(bites, all.size());
  for (std::size_t i = skin; i < bites; ++i) EXPECT_TRUE(all[i].skin) << all[i].id;
  for (std::size_t i = bites; i < all.size(); ++i) EXPECT_TRUE(all[i].bite) << all[i].id;
  for (std::size_t i = first; i < end; ++i) {
    const Instrument& screw = all[i];
    EXPECT_EQ(screw.rods.front().to_mm, screw.length_mm);
    EXPECT_EQ(screw.rods.front().material, Material::Titanium);
    EXPECT_LT(screw.cut_tip_radius_mm, screw.tip_diameter_mm / 2);
    if (i > first && all[i - 1].family == screw.family) {
      EXPECT_GT(screw.length_mm, all[i - 1].length_mm);
    }
  }
  EXPECT_EQ(all[first].name, "Acutrak Standard (1994 type) 12.5 mm");
}

TEST(Catalogue, AHolderIsDrawnBehindWhatItHoldsAndGoesWithTheHand) {
  const Instrument& screw = one("acutrak_2_mini_24");
  std::size_t of_the_driver = 0;
  for (const DrawnPart& part : screw.parts) {
    if (!part.only_in_hand) continue;
    ++of_the_driver;
    EXPECT_GE(part.from_mm, 24.0 - 0.8) << "its blade is in the screw's tail";
  }
  EXPECT_GT(of_the_driver, 5U);
  EXPECT_EQ(screw.rods.size(), 2U);
  EXPECT_TRUE(screw.rods[1].only_in_hand);
  EXPECT_EQ(screw.rods[1].from_mm, 24.0);
  bool has_grip = false;
  for (const DrawnPart& part : one("guide_wire").parts) {
    has_grip = has_grip || (part.axis == Vec3{0, 1, 0} && part.origin_mm == Vec3{0, -44, 138});
  }
  EXPECT_TRUE(has_grip) << "the pistol's grip, 66 mm behind the chuck at 72 mm";
}

/// A file with one instrument that is right, to be spoilt.
Json good() {
  return Json::parse(R"({"schema_version": 1, "holders": [], "instruments": [{
    "id": "awl", "name": "Awl", "use": "Makes holes.", "mark": "[E]",
    "shape": {"kind": "cone_tip", "radius_mm": 1, "cone_mm": 3, "length_mm": 80},
    "length_mm": 90, "work": "drill", "drive": "by_hand",
    "feed": {"bite_n": 1, "resistance_share": 1, "mm_per_s_per_n": 1, "fastest_mm_per_s": 1,
             "back_mm_per_s": 1},
    "cut": {"tip_radius_mm": 1, "tail_radius_mm": 1, "length_mm": 90},
    "parts": [{"profile": [[0, 0], [1, 3], [1, 90]], "material": "steel"}],
    "rods": [{"from_mm": 0, "to_mm": 90, "radius_mm": 1, "end_radius_mm": 1, "material": "steel"}]
  }]})");
}

std::string problem_of(const Json& file) {
  try {
    (void)read_instruments(file.dump(), "tools.json");
  } catch (const InvalidInput& problem) {
    return problem.what();
  }
  return "";
}

std::string spoilt(const char* pointer, const Json& value) {
  Json file = good();
  const Json::json_pointer place("/instruments/0" + std::string(pointer));
  if (value.is_discarded()) {
    file[place.parent_pointer()].erase(place.back());
  } else {
    file[place] = value;
  }
  return problem_of(file);
}
const Json kGone(Json::value_t::discarded);

TEST(ReadInstruments, TellFileInstrumentAndField) {
  EXPECT_EQ(problem_of(good()), "");
  EXPECT_EQ(spoilt("/shape/radius_mm", kGone), "tools.json: awl: shape: radius_mm is missing");
  EXPECT_EQ(spoilt("/name", kGone), "tools.json: awl: name is missing");
  EXPECT_EQ(spoilt("/lenght_mm", 3), "tools.json: awl: there is no field 'lenght_mm'");
  EXPECT_EQ(spoilt("/shape/colour", "red"), "tools.json: awl: shape: there is no field 'colour'");
  EXPECT_EQ(spoilt("/length_mm", 1000), "tools.json: awl: length_mm is 1000, must be 1 to 400");
  EXPECT_EQ(spoilt("/feed/bite_n", -1), "tools.json: awl: feed: bite_n is -1, must be 0 to 100");
  EXPECT_EQ(spoilt("/work", "saw"),
            "tools.json: awl: work is 'saw', must be one of none, drill, ream, thread");
  EXPECT_EQ(
      spoilt("/parts/0/material", "wood"),
      "tools.json: awl: parts[0]: material is 'wood', must be one of steel, titanium, handle, "
      "black, glove");
  EXPECT_EQ(spoilt("/parts/0/profile/1", Json::array({1})),
            "tools.json: awl: parts[0]: profile[1] is no [radius, z] in mm");
  EXPECT_EQ(spoilt("/id", kGone), "tools.json: instruments[0]: id is missing");
  EXPECT_EQ(spoilt("/holder", Json{{"id", "fist"}, {"at_mm", 1}}),
            "tools.json: awl: holder: there is no holder 'fist'");
  EXPECT_EQ(spoilt("/drive", "none"),
            "tools.json: awl: work and drive must both be none, or neither");
  EXPECT_EQ(spoilt("/work", "ream"),
            "tools.json: awl: bore_radius_mm is missing: it runs on a wire");
  EXPECT_EQ(spoilt("/is_sleeve", true),
            "tools.json: awl: bore_radius_mm is missing: a wire runs in it");
}

TEST(ReadInstruments, WhatTheShapeItselfRefusesIsToldWithItsPlace) {
  const std::string problem = spoilt("/shape/length_mm", 1.5);
  EXPECT_EQ(problem.rfind("tools.json: awl: shape: ", 0), 0U) << problem;
}

TEST(ReadInstruments, ANumberThatIsNotFiniteIsRefused) {
  std::string text = good().dump();
  text.replace(text.find("\"length_mm\":90"), 14, "\"length_mm\":1e999");
  EXPECT_THROW((void)read_instruments(text, "tools.json"), InvalidInput);
}

}  // namespace
}  // namespace carpus::instruments
