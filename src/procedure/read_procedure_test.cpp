// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "procedure/procedure.hpp"

namespace carpus::procedure {
namespace {

using Json = nlohmann::json;

bool always(const Situation& /*now*/) noexcept { return true; }
bool never(const Situation& /*now*/) noexcept { return false; }
constexpr std::array kPredicates{NamedPredicate{"always", always}, NamedPredicate{"never", never}};

/// A file that is right, to be spoilt.
Json good() {
  return Json::parse(R"({
    "id": "lunate_wire", "title": "Wire into the lunate", "summary": "One wire. No screw.",
    "target": "lunate", "allowed": ["triquetrum"],
    "tray": ["guide_wire", "probe", "family:acutrak_2_mini"],
    "steps": [
      {"id": "look", "title": "Look", "instruction": "Look at it.", "actions": ["shot"],
       "done": "always"},
      {"id": "drill", "title": "Drill", "instruction": "Drill it.", "instrument": "guide_wire",
       "done": "never", "lost": "always", "passes_over_earlier": true}],
    "views": [{"id": "pa", "label": "PA", "rotation_deg": 0, "tilt_deg": 0}]
  })");
}

std::string problem_of(const Json& file) {
  try {
    (void)read_procedure(file.dump(), "lunate.json", kPredicates);
  } catch (const InvalidInput& problem) {
    return problem.what();
  }
  return "";
}

std::string spoilt(const char* pointer, const Json& value) {
  Json file = good();
  file[Json::json_pointer(pointer)] = value;
  return problem_of(file);
}

TEST(ReadProcedure, ReadsWhatIsDeclared) {
  const Procedure read = read_procedure(good().dump(), "lunate.json", kPredicates);
  EXPECT_EQ(read.id, "lunate_wire");
  EXPECT_EQ(read.target, BoneId::Lunate);
  EXPECT_EQ(read.allowed, std::vector{BoneId::Triquetrum});
  ASSERT_EQ(read.tray.size(), 10U) << "wire, probe and eight screws";
  EXPECT_EQ(instruments::catalogue()[read.tray[2]].id, "acutrak_2_mini_16");
  ASSERT_EQ(read.steps.size(), 2U);
  EXPECT_EQ(read.steps[0].actions, std::vector<std::string>{"shot"});
  EXPECT_EQ(read.steps[0].is_done, always);
  EXPECT_EQ(read.steps[0].is_lost, nullptr);
  EXPECT_EQ(read.steps[0].instrument, instruments::kNoInstrument);
  EXPECT_EQ(read.steps[1].is_lost, always);
  EXPECT_TRUE(read.steps[1].passes_over_earlier);
  EXPECT_EQ(instruments::catalogue()[read.steps[1].instrument].id, "guide_wire");
  EXPECT_EQ(read.views.front().label, "PA");
}

TEST(ReadProcedure, ReadsWhenNotToOperate) {
  Json file = good();
  EXPECT_TRUE(read_procedure(file.dump(), "lunate.json", kPredicates).decline.reasons.empty());
  file["decline"] = {{"reasons", {{{"id", "worn"}, {"label", "It is worn"}}}}};
  const Procedure read = read_procedure(file.dump(), "lunate.json", kPredicates);
  ASSERT_EQ(read.decline.reasons.size(), 1U);
  EXPECT_EQ(read.decline.reasons[0].label, "It is worn");
  file["decline"]["reasons"].push_back(file["decline"]["reasons"][0]);
  EXPECT_NE(problem_of(file).find("two of this id"), std::string::npos);
  file["decline"]["reasons"] = Json::array();
  EXPECT_NE(problem_of(file).find("must be 1 to 7"), std::string::npos);
}

TEST(ReadProcedure, TellsFilePlaceAndFieldOfEveryMistake) {
  EXPECT_EQ(problem_of(good()), "");
  EXPECT_EQ(spoilt("/steps/1/done", "driven"),
            "lunate.json: steps[1]: done: no predicate 'driven' among those given: always, never");
  EXPECT_EQ(spoilt("/steps/1/lost", "driven"),
            "lunate.json: steps[1]: lost: no predicate 'driven' among those given: always, never");
  EXPECT_EQ(spoilt("/steps/0/titel", "x"), "lunate.json: steps[0]: there is no field 'titel'");
  EXPECT_EQ(spoilt("/steps/0/id", "look at"),
            "lunate.json: steps[0]: id 'look at' must be of a to z, 0 to 9 and _");
  EXPECT_EQ(spoilt("/steps/1/instrument", "depth_gauge"),
            "lunate.json: steps[1]: instrument: 'depth_gauge' is not on the tray");
  EXPECT_EQ(spoilt("/steps/1/id", "look"), "lunate.json: steps: there are two 'look'");
  EXPECT_EQ(spoilt("/steps", Json::array()), "lunate.json: steps: there are 0, must be 1 to 32");
  EXPECT_EQ(spoilt("/target", "knee"), "lunate.json: target: no bone 'knee'");
  EXPECT_EQ(spoilt("/target", "scaphoid_distal"), "lunate.json: target: no bone 'scaphoid_distal'");
  EXPECT_EQ(spoilt("/allowed", Json::array({"hip"})), "lunate.json: allowed: no bone 'hip'");
  EXPECT_EQ(spoilt("/tray/0", "chisel"), "lunate.json: tray: no instrument 'chisel'");
  EXPECT_EQ(spoilt("/tray/0", "family:none"), "lunate.json: tray: no instrument 'family:none'");
  EXPECT_EQ(spoilt("/tray/0", "probe"), "lunate.json: tray: 'probe' is on it twice");
  EXPECT_EQ(spoilt("/tray", Json::array()),
            "lunate.json: tray is empty: there is nothing to operate with");
  EXPECT_EQ(spoilt("/views/0/tilt_deg", 70),
            "lunate.json: views[0]: tilt_deg is 70, must be -60 to 60");
  Json file = good();
  file.erase("title");
  EXPECT_EQ(problem_of(file), "lunate.json: title is missing");
}

Json with_drill() {
  Json file = good();
  file["drill"] = Json::parse(R"({
    "hold": [2, 7], "hold_s": 3, "middle_deg": 13, "still_mm": 2, "round_places": 5,
    "round_turn_deg": 180, "touch": [8], "touch_mm": 2.5, "line": [8, 11], "line_mm": 3,
    "mark": "[E]"})");
  return file;
}

TEST(ReadProcedure, ReadsExercisesWithAScope) {
  const Procedure read = read_procedure(with_drill().dump(), "lunate.json", kPredicates);
  ASSERT_TRUE(read.drill.has_value());
  EXPECT_EQ(read.drill->hold, (std::vector<std::uint8_t>{2, 7}));
  EXPECT_EQ(read.drill->line, (std::vector<std::uint8_t>{8, 11}));
  EXPECT_DOUBLE_EQ(read.drill->hold_s, 3);
  EXPECT_FALSE(read_procedure(good().dump(), "lunate.json", kPredicates).drill.has_value());
}

TEST(ReadProcedure, ExercisesThatGoNowhereAreRefused) {
  const auto problem = [](const char* field, const Json& value) {
    Json file = with_drill();
    file["drill"][field] = value;
    return problem_of(file);
  };
  EXPECT_NE(problem("hold", Json::array()).find("hold"), std::string::npos);
  EXPECT_NE(problem("hold", {0}).find("0 is no place"), std::string::npos);
  EXPECT_NE(problem("touch", {1, 32}).find("32 is no place"), std::string::npos);
  EXPECT_NE(problem("touch", {1.5}).find("touch"), std::string::npos);
  EXPECT_NE(problem("touch", Json::array({1, 2, 3, 4, 5, 6, 7, 8, 9})).find("1 to 8"),
            std::string::npos);
  EXPECT_NE(problem("line", {8}).find("one place"), std::string::npos);
  EXPECT_NE(problem("hold_s", -1).find("hold_s"), std::string::npos);
  EXPECT_NE(problem("holds", 1).find("holds"), std::string::npos) << "misspelt";
}

TEST(ReadProcedure, ReadsWhatIsToBeTakenOutAndRefusesWhatMakesNoSense) {
  Json file = good();
  file["removal"] = Json::parse(R"({
    "bodies": [1, 3], "radius_mm": [0.9, 1.4], "places": [8, 11, 16], "mark": "[E]"})");
  const Procedure read = read_procedure(file.dump(), "lunate.json", kPredicates);
  ASSERT_TRUE(read.removal.has_value());
  EXPECT_EQ(read.removal->bodies, (std::array<std::uint8_t, 2>{1, 3}));
  EXPECT_EQ(read.removal->places, (std::vector<std::uint8_t>{8, 11, 16}));
  const auto problem = [&](const char* field, const Json& value) {
    Json wrong = file;
    wrong["removal"][field] = value;
    return problem_of(wrong);
  };
  EXPECT_NE(problem("bodies", {3, 1}).find("least to most"), std::string::npos);
  EXPECT_NE(problem("bodies", {1, 9}).find("bodies"), std::string::npos);
  EXPECT_NE(problem("radius_mm", {0.1, 1}).find("radius_mm"), std::string::npos);
  EXPECT_NE(problem("places", {8, 11}).find("fewer than bodies"), std::string::npos);
  EXPECT_NE(problem("places", {8, 11, 40}).find("40 is no place"), std::string::npos);
  EXPECT_NE(problem("place", 1).find("place"), std::string::npos) << "misspelt";
}

TEST(ReadProcedure, ReadsWhetherFluidRunsAndRefusesWhatItDoesNotKnow) {
  Json file = good();
  EXPECT_FALSE(read_procedure(file.dump(), "lunate.json", kPredicates).fluid);
  file["fluid"] = Json::parse(R"({"tourniquet": false, "mark": "[E]"})");
  const Procedure read = read_procedure(file.dump(), "lunate.json", kPredicates);
  ASSERT_TRUE(read.fluid.has_value());
  EXPECT_FALSE(read.fluid->has_tourniquet);
  file["fluid"]["tornique"] = true;
  EXPECT_NE(problem_of(file).find("tornique"), std::string::npos);
}

TEST(ReadProcedure, AScrewIsControlledOrAWristExamined) {
  Json file = good();
  EXPECT_FALSE(read_procedure(file.dump(), "lunate.json", kPredicates).controls_screw);
  file["controls_screw"] = true;
  EXPECT_TRUE(read_procedure(file.dump(), "lunate.json", kPredicates).controls_screw);
  file["examines"] = true;
  EXPECT_NE(problem_of(file).find("controls_screw"), std::string::npos);
}

Json with_synovium() {
  Json file = good();
  file["shaving"] = Json::parse(R"({
    "synovium": {"patches": [2, 3], "tufts": [10, 16], "places": [11, 12, 16]}, "mark": "[E]"})");
  return file;
}

Json with_torn_disc() {
  Json file = good();
  file["shaving"] = Json::parse(R"({
    "disc": {"tears": ["1A", "2C"], "frayed_mm": 0.8, "rim_mm": 2}, "mark": "[E]"})");
  return file;
}

TEST(ReadProcedure, ReadsWhatIsToBeShavedAway) {
  EXPECT_FALSE(read_procedure(good().dump(), "lunate.json", kPredicates).shaving.has_value());
  const auto inflamed = read_procedure(with_synovium().dump(), "lunate.json", kPredicates).shaving;
  ASSERT_TRUE(inflamed && inflamed->synovium);
  EXPECT_FALSE(inflamed->disc);
  EXPECT_EQ(inflamed->synovium->patches, (std::array<std::uint8_t, 2>{2, 3}));
  EXPECT_EQ(inflamed->synovium->tufts, (std::array<std::uint8_t, 2>{10, 16}));
  EXPECT_EQ(inflamed->synovium->places, (std::vector<std::uint8_t>{11, 12, 16}));
  const auto torn = read_procedure(with_torn_disc().dump(), "lunate.json", kPredicates).shaving;
  ASSERT_TRUE(torn && torn->disc);
  EXPECT_FALSE(torn->synovium);
  EXPECT_EQ(torn->disc->tears, (std::vector<std::string>{"1A", "2C"}));
  EXPECT_DOUBLE_EQ(torn->disc->frayed_mm, 0.8);
  EXPECT_DOUBLE_EQ(torn->disc->rim_mm, 2);
}

TEST(ReadProcedure, EitherSynoviumOrTheDiscIsShaved) {
  Json both = with_synovium();
  both["shaving"]["disc"] = with_torn_disc()["shaving"]["disc"];
  EXPECT_NE(problem_of(both).find("either synovium or disc"), std::string::npos);
  Json neither = with_synovium();
  neither["shaving"].erase("synovium");
  EXPECT_NE(problem_of(neither).find("either synovium or disc"), std::string::npos);
  Json unsaid = with_synovium();
  unsaid["shaving"].erase("mark");
  EXPECT_NE(problem_of(unsaid).find("mark"), std::string::npos) << "says where it is from";
}

TEST(ReadProcedure, ShavingOutOfItsRangeIsRefusedByItsField) {
  const auto problem = [](Json file, const char* what, const char* field, const Json& value) {
    file["shaving"][what][field] = value;
    return problem_of(file);
  };
  const auto synovium = [&](const char* field, const Json& value) {
    return problem(with_synovium(), "synovium", field, value);
  };
  EXPECT_NE(synovium("patches", {3, 2}).find("least to most"), std::string::npos);
  EXPECT_NE(synovium("patches", {1, 5}).find("patches"), std::string::npos);
  EXPECT_NE(synovium("patches", {1.5, 2}).find("patches"), std::string::npos) << "no half ones";
  EXPECT_NE(synovium("tufts", {0, 4}).find("tufts"), std::string::npos);
  EXPECT_NE(synovium("tufts", {1, 31}).find("tufts"), std::string::npos);
  EXPECT_NE(synovium("places", {11, 12}).find("fewer than patches"), std::string::npos);
  EXPECT_NE(synovium("places", {11, 12, 40}).find("40 is no place"), std::string::npos);
  EXPECT_NE(synovium("tuft", 1).find("tuft"), std::string::npos) << "misspelt";
  const auto disc = [&](const char* field, const Json& value) {
    return problem(with_torn_disc(), "disc", field, value);
  };
  EXPECT_NE(disc("tears", Json::array()).find("at least one"), std::string::npos);
  EXPECT_NE(disc("frayed_mm", 0).find("frayed_mm"), std::string::npos);
  EXPECT_NE(disc("rim_mm", 9).find("rim_mm"), std::string::npos);
  EXPECT_NE(disc("rim", 1).find("rim"), std::string::npos) << "misspelt";
}

TEST(ReadProcedure, AStepMoreThanThereAreBitsIsRefused) {
  Json file = good();
  for (int i = 0; i < 31; ++i) {
    file["steps"].push_back(file["steps"][0]);
    file["steps"].back()["id"] = "more_" + std::to_string(i);
  }
  EXPECT_EQ(problem_of(file), "lunate.json: steps: there are 33, must be 1 to 32");
}

TEST(ReadProcedure, AnIdThatIsNotItsFoldersIsRefused) {
  const std::string json = good().dump();
  EXPECT_NO_THROW((void)read_procedure(json, "lunate_wire/procedure.json", kPredicates));
  try {
    (void)read_procedure(json, "hamate_wire/procedure.json", kPredicates);
    FAIL() << "not refused";
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("folder's name, 'hamate_wire'"), std::string::npos);
  }
}

TEST(ProcedureList, RefusesTwoOfOneId) {
  Procedure first;
  first.id = "one";
  Procedure second = first;
  EXPECT_THROW(ProcedureList({&first, &second}), InvalidInput);
  second.id = "two";
  EXPECT_EQ(ProcedureList({&first, &second}).find("two"), &second);
}

}  // namespace
}  // namespace carpus::procedure
