// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The form of the ASSET: what is published of it holds, what it comes to, and wrong tables and
// answers are refused by the entry's name.
#include "arthroscopy/asset_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>

#include "core/error.hpp"

namespace carpus::data {
std::string_view asset();
}

namespace carpus::arthroscopy {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

/// The same points in every domain, but no more than it has.
std::vector<AssetChoice> all(int points) {
  const AssetTable& table = AssetTable::built_in();
  std::vector<AssetChoice> answers{{table.complexity.id, 1}};
  for (const AssetDomain& domain : table.domains) {
    answers.push_back({domain.id, std::min(points, domain.highest)});
  }
  return answers;
}

TEST(AssetTable, IsThePublishedToolsInRowsStepsAndSum) {
  const AssetTable& table = AssetTable::built_in();
  ASSERT_EQ(table.domains.size(), 8U);
  EXPECT_EQ(table.passes_at, 3);
  EXPECT_EQ(table.result_of(all(5))->total, 38);
  for (const AssetDomain& domain : table.domains) {
    std::vector<int> steps;
    for (const AssetStep& step : domain.steps) steps.push_back(step.points);
    const bool is_autonomy = domain.id == "autonomy";
    EXPECT_EQ(steps, is_autonomy ? (std::vector{1, 2, 3}) : (std::vector{1, 3, 5})) << domain.id;
  }
  EXPECT_EQ(table.complexity.steps.size(), 3U);
}

TEST(AssetTable, PassesWhereEveryDomainHasThreeAndNotByTheSum) {
  const AssetTable& table = AssetTable::built_in();
  EXPECT_EQ(table.result_of(all(3)), (AssetResult{24, true}));
  for (const AssetDomain& domain : table.domains) {
    auto answers = all(5);
    for (AssetChoice& each : answers) {
      if (each.domain == domain.id) each.points = 2;
    }
    const auto result = table.result_of(answers);
    EXPECT_FALSE(result->passes) << domain.id;
    EXPECT_GT(result->total, 24) << domain.id;
  }
}

TEST(AssetTable, ComplexityIsAskedAndNotCounted) {
  const AssetTable& table = AssetTable::built_in();
  auto answers = all(4);
  const auto easy = table.result_of(answers);
  answers.front().points = 3;
  EXPECT_EQ(table.result_of(answers), easy);
  answers.erase(answers.begin());
  EXPECT_FALSE(table.result_of(answers));
}

TEST(AssetTable, ComesToNothingWhileARowIsMissing) {
  const AssetTable& table = AssetTable::built_in();
  auto answers = all(5);
  while (!answers.empty()) {
    answers.pop_back();
    EXPECT_FALSE(table.problem_of(answers));
    EXPECT_FALSE(table.result_of(answers));
  }
}

TEST(AssetTable, RefusesAnswersThatAreNone) {
  const AssetTable& table = AssetTable::built_in();
  const auto problem = [&](std::vector<AssetChoice> answers) {
    return table.problem_of(answers).value_or("none");
  };
  EXPECT_EQ(problem(all(5)), "none");
  EXPECT_THAT(problem({{"style", 3}}), HasSubstr("no row 'style'"));
  EXPECT_THAT(problem({{"safety", 3}, {"safety", 4}}), HasSubstr("Safety is answered twice"));
  EXPECT_THAT(problem({{"safety", 6}}), HasSubstr("1 to 5"));
  EXPECT_THAT(problem({{"safety", 0}}), HasSubstr("1 to 5"));
  EXPECT_THAT(problem({{"autonomy", 4}}), HasSubstr("Autonomy has 1 to 3 points, not 4"));
  EXPECT_THAT(problem({{"complexity", 4}}), HasSubstr("1 to 3"));
}

TEST(AssetTable, WrongTablesAreRefusedByTheEntrysName) {
  const auto refusal = [](const std::function<void(Json&)>& change) -> std::string {
    Json json = Json::parse(data::asset());
    change(json);
    try {
      (void)AssetTable::parse(json.dump());
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(refusal([](Json&) {}), "accepted");
  EXPECT_THAT(refusal([](Json& j) { j["domains"][1].erase("title"); }),
              HasSubstr("asset.json: field_of_view: "));
  EXPECT_THAT(refusal([](Json& j) { j["domains"][2].erase("id"); }), HasSubstr("domain 3: "));
  EXPECT_THAT(refusal([](Json& j) { j["domains"][0]["highest"] = 9; }),
              HasSubstr("safety: its highest"));
  EXPECT_THAT(refusal([](Json& j) { j["domains"][0]["mark"] = ""; }),
              HasSubstr("safety: says where it is from"));
  EXPECT_THAT(refusal([](Json& j) { j["domains"][0]["steps"][1]["points"] = 1; }),
              HasSubstr("safety: steps go up"));
  EXPECT_THAT(refusal([](Json& j) { j["domains"][0]["steps"].erase(2); }),
              HasSubstr("safety: its lowest and its highest"));
  EXPECT_THAT(refusal([](Json& j) { j["domains"][7]["steps"][0]["text"] = ""; }),
              HasSubstr("autonomy: a step says"));
  EXPECT_THAT(refusal([](Json& j) { j["domains"][3]["id"] = "safety"; }),
              HasSubstr("safety: is there twice"));
  EXPECT_THAT(refusal([](Json& j) { j["passes_at"]["value"] = 4; }),
              HasSubstr("autonomy: has no step of passes_at"));
  EXPECT_THAT(refusal([](Json& j) { j["highest_total"]["value"] = 40; }),
              HasSubstr("the domains' highest make 38"));
  EXPECT_THAT(refusal([](Json& j) { j.erase("complexity"); }), HasSubstr("asset.json: "));
  EXPECT_THAT(refusal([](Json& j) { j = Json::array(); }), HasSubstr("asset.json: "));
}

}  // namespace
}  // namespace carpus::arthroscopy
