// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/band_net.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "arthroscopy/generic_wrist_test_support.hpp"
#include "arthroscopy/make_lesions.hpp"
#include "arthroscopy/pathology_table.hpp"
#include "arthroscopy/yielding_figures.hpp"
#include "core/error.hpp"
#include "fields/distance_field.hpp"

namespace carpus::arthroscopy {
namespace {

using test::generic_wrist;

TEST(BandNet, BothInterosseousLigamentsAreLaidUnderTheWallBetweenTheirBones) {
  const cases::ArthroscopicMap& map = generic_wrist().map;
  ASSERT_EQ(map.bands.size(), 2U);
  for (const cases::LigamentBand& band : map.bands) {
    const auto& bones = generic_wrist().data.bones;
    const bool is_sl = band.id == "scapholunate";
    EXPECT_EQ(bones[band.first].bone, is_sl ? BoneId::Scaphoid : BoneId::Lunate);
    EXPECT_EQ(bones[band.second].bone, is_sl ? BoneId::Lunate : BoneId::Triquetrum);
    EXPECT_EQ(map.joints[band.joint].id, "radiocarpal");
    EXPECT_EQ(band.at.size(), band.rows * band.columns);
    EXPECT_LE(band.at.size(), yielding::kMaxParticles);
    for (std::size_t i = 0; i < band.at.size(); ++i) {
      EXPECT_NEAR(length(band.inwards[i]), 1, 1e-9);
      const Vec3 on_wall = band.at[i] + band.inwards[i] * (band.thickness_mm / 2);
      const auto sample = fields::sample_distance(map.joints[band.joint].wall, on_wall);
      ASSERT_TRUE(sample.is_inside_grid);
      EXPECT_NEAR(sample.distance_mm, 0, 0.35) << band.id << " " << i;
    }
  }
}

TEST(BandNet, AProbePressesEachGradeInAsFarAsItIsFittedTo) {
  for (const BandFigures& f : band_figures(generic_wrist().map)) {
    ASSERT_TRUE(f.wanted_mm);
    EXPECT_NEAR(f.press_mm, *f.wanted_mm, 0.25 * *f.wanted_mm + 0.03) << f.band << " " << f.grade;
    EXPECT_NEAR(f.along_n_per_mm, f.fibres_n_per_mm, 0.25 * f.fibres_n_per_mm) << f.band;
    EXPECT_GT(f.press_behind_mm, 0.1) << f.band << " " << f.grade;
    EXPECT_LT(f.press_behind_mm, 1.15 * f.press_mm) << f.band;
    EXPECT_TRUE(f.bulge_mm == 0 || f.press_behind_mm < f.press_mm) << "it is hollow from there";
    EXPECT_LT(f.fibres_n_per_mm, f.whole_n_per_mm) << "the scope does not see all of it";
  }
}

TEST(BandNet, AWristsGradesMakeItTautSlackOrTorn) {
  const auto& [data, tissue, map] = generic_wrist();
  const PathologyTable& table = PathologyTable::generic();
  const cases::LigamentBand& band = map.bands.front();
  const auto net_of = [&, &data = data, &map = map](std::uint8_t grade) {
    cases::Grades grades{};
    grades[0] = grade;
    const cases::JointLesions lesions = make_lesions(data, map, table, grades, 1);
    EXPECT_EQ(lesions.grades[0], grade);
    return band_net(band, &lesions);
  };
  const std::size_t middle = (band.rows / 2) * band.columns + band.columns / 2;
  const auto bulge = [&](const yielding::Net& net) {
    return distance(net.rest()[middle], net.scanned()[middle]);
  };
  const yielding::Net whole = band_net(band, nullptr);
  EXPECT_EQ(bulge(whole), 0);
  EXPECT_EQ(bulge(net_of(0)), 0);
  EXPECT_GT(bulge(net_of(1)), 0.3);
  EXPECT_GT(bulge(net_of(2)), bulge(net_of(1)));
  const yielding::Net third = net_of(3);
  const yielding::Net fourth = net_of(4);
  EXPECT_LT(third.springs().size(), whole.springs().size());
  EXPECT_LT(fourth.springs().size(), third.springs().size()) << "it is torn farther";
}

/// The built-in table with one text in place of another.
void expect_refused(const std::string& from, const std::string& to) {
  static const std::string kGood = R"({"doc": "d", "schema_version": 1, "fit_mark": "[E]",
    "bands": [{"id": "sl", "name": "sl", "joint": "radiocarpal", "behind": "midcarpal", "ligaments": ["SL_proximal"],
      "spacing_mm": {"value": 1, "mark": "[E]"}, "whole_n_per_mm": {"value": 230, "mark": "[K]"}}],
    "on_wall_mm": {"value": 2, "mark": "[E]"}, "cartilage_mm": {"value": 1.6, "mark": "[K]"},
    "aside_share": {"value": 0.3, "mark": "[E]"},
    "mass_g_per_mm2": {"value": 2, "mark": "[E]"}, "damping_per_s": {"value": 80, "mark": "[E]"},
    "grades": [{"id": "0", "tension_n_per_mm": 1, "foundation_n_per_mm2": 0.2, "along_share": 1,
      "bulge_mm": 0}]})";
  EXPECT_EQ(BandTable::parse(kGood).bands.size(), 1U);
  std::string text = kGood;
  const std::size_t at = text.find(from);
  ASSERT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  EXPECT_THROW((void)BandTable::parse(text), InvalidInput) << to;
}

TEST(BandTable, WhatIsWrongInItIsRefused) {
  expect_refused(R"("value": 230, "mark": "[K]")", R"("value": 230)");
  expect_refused(R"("value": 230)", R"("value": -1)");
  expect_refused(R"(["SL_proximal"])", "[]");
  expect_refused(R"("behind": "midcarpal", )", "");
  expect_refused(R"("value": 1.6)", R"("value": 0)");
  expect_refused(R"("id": "0")", R"("id": "I")");
  expect_refused(R"("along_share": 1)", R"("along_share": 2)");
  expect_refused(R"("foundation_n_per_mm2": 0.2)", R"("foundation_n_per_mm2": 0)");
  expect_refused(R"("bulge_mm": 0)", R"("bulge_mm": 0, "unknown": 1)");
}

}  // namespace
}  // namespace carpus::arthroscopy
