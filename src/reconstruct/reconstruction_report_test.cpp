// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/reconstruction_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace carpus::reconstruct {
namespace {

using testing::HasSubstr;

Reconstruction two_bones() {
  Reconstruction r;
  r.data.side = Side::Right;
  for (const auto& [bone, label] :
       {std::pair(BoneId::Radius, std::uint8_t{1}), std::pair(BoneId::Scaphoid, std::uint8_t{3})}) {
    cases::Bone b;
    b.bone = bone;
    b.label = label;
    b.surface.vertices.resize(6);
    b.surface.facets.resize(8);
    b.hull.vertices.resize(4);
    b.hull.facets.resize(4);
    r.data.bones.push_back(b);
    r.figures.push_back({0.5, 0.002, {0.9, false, ""}});
  }
  r.stages = {{"smooth", 1.0}, {"names", 3.0}};
  r.data.provenance.conventions = {"values are stored x 1 + -1024"};
  return r;
}

TEST(ReconstructionReport, WritesTheDocumentedJson) {
  const auto report = make_report(two_bones(), {{1, 10, 10, 0.9}, {3, 10, 10, 0.8}});
  const auto json = nlohmann::json::parse(json_of(report));
  EXPECT_EQ(json["side"], "right");
  ASSERT_EQ(json["bones"].size(), 2U);
  EXPECT_EQ(json["bones"][1]["name"], "scaphoid");
  EXPECT_EQ(json["bones"][1]["dice"], 0.8);
  EXPECT_EQ(json["bones"][1]["vertices"], 6);
  EXPECT_EQ(json["bones"][1]["facets"], 8);
  EXPECT_EQ(json["bones"][1]["hull_vertices"], 4);
  EXPECT_EQ(json["bones"][1]["hull_facets"], 4);
  EXPECT_NEAR(json["dice_mean"].get<double>(), 0.85, 1e-12);
  EXPECT_EQ(json["dice_min"], 0.8);
  EXPECT_EQ(json["stages"][1]["name"], "names");
  EXPECT_EQ(json["stages"][1]["seconds"], 3.0);
  EXPECT_EQ(json["conventions"][0], "values are stored x 1 + -1024");
  EXPECT_EQ(json.size(), 6U);
  EXPECT_NE(text_of(report).find("by convention: values are stored"), std::string::npos);
  EXPECT_NE(text_of(report).find("names                            3.00  75.0%    4.00"),
            std::string::npos)
      << text_of(report);
}

TEST(ReconstructionReport, SaysWhichBonesToCheckAndWhy) {
  Reconstruction r = two_bones();
  r.figures[1].trust = {0.2, true, "it is hollow"};
  const auto report = make_report(r, {});
  const auto json = nlohmann::json::parse(json_of(report));
  EXPECT_EQ(json["bones"][0]["flagged"], false);
  EXPECT_EQ(json["bones"][1]["flagged"], true);
  EXPECT_EQ(json["bones"][1]["confidence"], 0.2);
  EXPECT_EQ(json["bones"][1]["why"], "it is hollow");
  EXPECT_THAT(text_of(report), HasSubstr("! scaphoid: it is hollow"));
}

TEST(ReconstructionReport, SaysHowFarSimplificationMovedEachSurface) {
  Reconstruction r = two_bones();
  EXPECT_THAT(text_of(make_report(r, {})), testing::Not(HasSubstr("Simplified")));
  r.figures[1].simplification_error_mm = 0.0625;
  const auto report = make_report(r, {});
  const auto json = nlohmann::json::parse(json_of(report));
  EXPECT_TRUE(json["bones"][0]["simplification_error_mm"].is_null());
  EXPECT_EQ(json["bones"][1]["simplification_error_mm"], 0.0625);
  EXPECT_THAT(text_of(report), HasSubstr("within 0.062 mm of what they were made of (scaphoid"));
}

TEST(ReconstructionReport, SaysNothingAboutDiceWithoutATruth) {
  const auto json = nlohmann::json::parse(json_of(make_report(two_bones(), {})));
  EXPECT_TRUE(json["dice_mean"].is_null());
  EXPECT_TRUE(json["bones"][0]["dice"].is_null());
}

TEST(ReconstructionReport, CountsABoneThatWasNotFoundAsZero) {
  const auto report =
      make_report(two_bones(), {{1, 10, 10, 0.9}, {3, 10, 10, 0.9}, {16, 10, 0, 0.0}});
  EXPECT_NEAR(*report.dice_mean, 0.6, 1e-12);
  EXPECT_EQ(*report.dice_min, 0.0);
  EXPECT_THAT(text_of(report), HasSubstr("scaphoid_distal"));
  EXPECT_THAT(text_of(report), HasSubstr("NOT FOUND"));
  EXPECT_EQ(nlohmann::json::parse(json_of(report))["bones"].size(), 2U);
}

TEST(ReconstructionReport, GivesEachStageItsShare) {
  EXPECT_THAT(text_of(make_report(two_bones(), {})), HasSubstr("75.0%"));
}

}  // namespace
}  // namespace carpus::reconstruct
