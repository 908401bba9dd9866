// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/fluid_table.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "core/error.hpp"

namespace carpus::data {
std::string_view joint_fluid();
}

namespace carpus::arthroscopy {
namespace {

using Json = nlohmann::json;

std::string problem_after(const std::function<void(Json&)>& change) {
  Json json = Json::parse(data::joint_fluid());
  change(json);
  try {
    (void)FluidTable::parse(json.dump());
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(FluidTable, ATourniquetLowersWhatStopsTheBleedingAndNoFigureIsBesideTheOthers) {
  const FluidTable& table = FluidTable::generic();
  EXPECT_LT(table.bleeding.tourniquet_mmhg, table.bleeding.pressure_mmhg);
  EXPECT_LT(table.joint.tissue_from_mmhg, table.joint.most_mmhg);
  EXPECT_LE(table.source.inflow_mmhg, table.joint.tissue_from_mmhg) << "harmless as it is at first";
}

TEST(FluidTable, WrongFiguresAreRefusedByName) {
  EXPECT_EQ(problem_after([](Json&) {}), "");
  const auto says = [](const std::string& problem, const char* what) {
    EXPECT_NE(problem.find(what), std::string::npos) << problem;
  };
  says(problem_after([](Json& j) { j["joint"].erase("rest_ml"); }), "joint.rest_ml is missing");
  says(problem_after([](Json& j) { j["joint"]["rest_ml"]["value"] = 0; }), "joint.rest_ml");
  says(problem_after([](Json& j) { j["air"]["shown_ml"]["mark"] = ""; }), "air.shown_ml");
  says(problem_after([](Json& j) {
         j["lens"]["wipes_s"] = {{"value", 1}, {"mark", "[E]"}};
       }),
       "lens has a figure that nothing reads");
  says(problem_after([](Json& j) { j["source"]["step_mmhg"]["value"] = 1; }), "63 steps");
  says(problem_after([](Json& j) { j.erase("view"); }), "view");
}

}  // namespace
}  // namespace carpus::arthroscopy
