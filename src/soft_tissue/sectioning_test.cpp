// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "soft_tissue/sectioning.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <set>

#include "core/error.hpp"
#include "fields/distance_field.hpp"
#include "soft_tissue/make_soft_tissue.hpp"
#include "soft_tissue/model_case_test_support.hpp"
#include "soft_tissue/sectioning_check.hpp"

namespace carpus::soft_tissue {
namespace {

struct Wrist {
  cases::CaseData data;
  SoftTissue tissue;
};

Wrist wrist_of(Side side) {
  Wrist w{test::model_case(side, 1, Mat3::identity()), {}};
  for (cases::Bone& b : w.data.bones) b.distance_field = fields::build_distance_field(b.surface);
  TissueTable table = TissueTable::generic();
  table.spaces.clear();
  w.tissue = make_soft_tissue(w.data, table);
  return w;
}

const Wrist& left_wrist() {
  static const Wrist wrist = wrist_of(Side::Left);
  return wrist;
}

/// The built-in table, but for what a test does not ask; the moment in few steps.
SectioningTable part_of_table(const std::set<std::string>& cuts,
                              const std::set<std::string>& directions,
                              const std::set<std::string>& positions) {
  SectioningTable t = SectioningTable::generic();
  t.steps = 6;
  std::erase_if(t.cuts, [&](const BenchCut& c) { return !cuts.contains(c.id); });
  std::erase_if(t.directions, [&](const BenchDirection& d) { return !directions.contains(d.id); });
  std::erase_if(t.positions, [&](const BenchPosition& p) { return !positions.contains(p.id); });
  std::erase_if(t.published, [&](const PublishedStatement& s) {
    const auto has = [&](const std::string& place) {
      return s.kind == PublishedStatement::Kind::BoneChange ||
                     s.kind == PublishedStatement::Kind::BoneFlexion ||
                     s.kind == PublishedStatement::Kind::SlAngleChange
                 ? positions.contains(place)
                 : directions.contains(place);
    };
    return !cuts.contains(s.cut) || !has(s.place) ||
           (!s.other_place.empty() && !has(s.other_place));
  });
  return t;
}

// One run, many questions: it takes seconds.
TEST(Sectioning, TurnsTheWristAsPublishedWhereItSaysSo) {
  const SectioningTable table =
      part_of_table({"intact", "sl", "sl_dic_lrl"},
                    {"flexion", "extension", "radial_deviation", "ulnar_deviation", "ulnar_flexion",
                     "radial_flexion", "radial_extension"},
                    {"flexion", "radial_deviation"});
  const SectioningResult result = section(left_wrist().data, left_wrist().tissue, table);
  EXPECT_EQ(result.unsettled, 0u);
  EXPECT_LT(result.worst_left_n, 1);
  EXPECT_LT(result.worst_left_nmm, 10);  // of 2000
  std::set<std::string> reached;
  std::set<std::string> unexplained;
  for (const StatementCheck& c : compare_with_published(result, table)) {
    std::printf("%-36s %7.2f in %.2f to %.2f\n", c.statement->id.c_str(), c.ours,
                c.statement->limits.low, c.statement->limits.high);
    if (c.is_reached) {
      reached.insert(c.statement->id);
    } else {
      if (c.statement->why_not.empty()) unexplained.insert(c.statement->id);
    }
  }
  // Reached on the demo, of which this is the wrist before a CT was made of it; here +8 deg, 0.095.
  EXPECT_EQ(unexplained,
            (std::set<std::string>{"sl_range_ulnar_flexion", "stiffness_ulnar_flexion"}));
  for (const char* id :
       {// [S60]: shares of the capitate's turn, within 10 points. Those in flexion rest on the
        // capsule's slack, which was fitted to the range and not to them.
        "flexion_scaphoid_share", "flexion_lunate_share", "extension_scaphoid_share",
        "extension_lunate_share",
        // [S65]: SL alone leaves the range, within 5 deg.
        "sl_range_flexion", "sl_range_extension", "sl_range_radial_deviation",
        "sl_range_ulnar_deviation", "sl_range_radial_flexion", "sl_range_radial_extension",
        // Together with DIC and LRL it does not.
        "sl_dic_lrl_range_radial_extension", "sl_dic_lrl_range_ulnar_flexion",
        // [S107]: SL cut, the bones lie otherwise in flexion and not in deviation.
        "sl_scaphoid_flexion", "sl_lunate_flexion", "sl_scaphoid_radial_deviation",
        "sl_lunate_radial_deviation"}) {
    EXPECT_TRUE(reached.contains(id)) << id;
  }
  // [S65]: SL, DIC and LRL together do more than SL alone, which is the order of cutting.
  for (std::size_t d = 0; d < 2; ++d) {
    const double intact = result.wrists[0].curves[d].range_deg;
    const double sl = result.wrists[1].curves[d].range_deg;
    const double all = result.wrists[2].curves[d].range_deg;
    EXPECT_GT(all - intact, 1.5 * (sl - intact));
    EXPECT_GT(all - intact, 5);
  }
  // Stiffest where it is published to go least far.
  EXPECT_LT(result.wrists[0].curves[2].range_deg, result.wrists[0].curves[1].range_deg);
  for (const SectionedWrist& w : result.wrists) {
    for (const MomentCurve& c : w.curves) {
      const BenchDirection& d =
          *std::find_if(table.directions.begin(), table.directions.end(),
                        [&](const BenchDirection& one) { return one.id == c.direction; });
      ASSERT_EQ(c.steps.size(), table.steps);
      for (std::size_t i = 1; i < c.steps.size(); ++i) {  // more moment, more turn
        EXPECT_GT(c.steps[i].hand.along(d), c.steps[i - 1].hand.along(d) - 0.1);
      }
    }
  }
  // A jig holds the hand to a tenth of a degree.
  EXPECT_NEAR(result.wrists[1].held[0].wrist.hand.flexion_deg, 50, 0.1);
  EXPECT_NEAR(result.wrists[1].held[0].wrist.hand.radial_deviation_deg, 0, 0.1);
  EXPECT_GT(result.wrists[2].held[0].wrist.sl_angle_deg(),
            result.wrists[0].held[0].wrist.sl_angle_deg() + 5);
}

TEST(Sectioning, GivesTheSameBitsAgainAndARightWristIsTheMirror) {
  SectioningTable table = part_of_table({"intact"}, {"extension", "radial_deviation"}, {});
  table.steps = 4;
  const SectioningResult left = section(left_wrist().data, left_wrist().tissue, table);
  const SectioningResult again = section(left_wrist().data, left_wrist().tissue, table);
  const Wrist mirrored = wrist_of(Side::Right);
  const SectioningResult right = section(mirrored.data, mirrored.tissue, table);
  for (std::size_t d = 0; d < 2; ++d) {
    const MomentCurve& a = left.wrists[0].curves[d];
    EXPECT_EQ(a.range_deg, again.wrists[0].curves[d].range_deg);
    EXPECT_EQ(a.steps.back().gap_mm, again.wrists[0].curves[d].steps.back().gap_mm);
    EXPECT_NEAR(a.range_deg, right.wrists[0].curves[d].range_deg, 2);
    EXPECT_NEAR(a.steps.back().lunate.radial_deviation_deg,
                right.wrists[0].curves[d].steps.back().lunate.radial_deviation_deg, 2);
  }
}

TEST(Sectioning, CapsuleIsAsLongAsTheWholeWristAsksForAndGoesWithItsLigament) {
  SectioningTable table = part_of_table({"intact", "sl", "dic"}, {"flexion"}, {});
  table.cuts[2].without = {"SL_", "DIC"};
  std::erase_if(table.capsule, [](const CapsuleLine& l) {
    return !l.slack_mm &&
           l.goes_with != "DIC";  // of what holds the scaphoid, the dorsal line alone
  });
  const auto range = [](const SectioningResult& r, std::size_t wrist) {
    return r.wrists[wrist].curves[0].range_deg;
  };
  const SectioningResult with = section(left_wrist().data, left_wrist().tissue, table);
  ASSERT_EQ(with.capsule_slack_mm.size(), table.capsule.size());
  for (std::size_t i = 0; i < table.capsule.size(); ++i) {
    if (table.capsule[i].slack_mm) {
      EXPECT_NEAR(with.capsule_slack_mm[i], *table.capsule[i].slack_mm * left_wrist().tissue.size,
                  1e-9);
    }
  }
  SectioningTable without_lines = table;
  std::erase_if(without_lines.capsule, [](const CapsuleLine& l) { return !l.slack_mm; });
  ASSERT_EQ(without_lines.capsule.size() + 1, table.capsule.size());
  const SectioningResult without = section(left_wrist().data, left_wrist().tissue, without_lines);
  EXPECT_NEAR(range(with, 0), range(without, 0), 2);     // whole: little beyond what it asks for
  EXPECT_LT(range(with, 1), range(without, 1) - 3);      // SL alone is cut: it holds
  EXPECT_NEAR(range(with, 2), range(without, 2), 1e-9);  // DIC, too: its line is gone
  // By a smaller moment less is asked for.
  table.capsule_length_at_nm = 0.5;
  const SectioningResult shorter = section(left_wrist().data, left_wrist().tissue, table);
  EXPECT_LT(shorter.capsule_slack_mm[5], with.capsule_slack_mm[5]);
  EXPECT_GT(shorter.capsule_slack_mm[5], 1);
}

TEST(Sectioning, SaysSoWhereNothingHoldsTheHand) {
  SectioningTable table = part_of_table({"intact", "sl"}, {"extension"}, {});
  table.steps = 4;
  table.cuts[1].without = {""};  // every ligament
  table.capsule.clear();
  const SectioningResult result = section(left_wrist().data, left_wrist().tissue, table);
  EXPECT_FALSE(result.wrists[1].curves[0].steps.back().is_settled);
  EXPECT_GT(result.unsettled, 0u);
  for (const StatementCheck& c : compare_with_published(result, table)) {
    if (c.statement->cut != "sl") continue;
    EXPECT_FALSE(c.is_measured) << c.statement->id;
  }
}

TEST(Sectioning, RefusesAWristWithoutWhatItNeeds) {
  const SectioningTable table = part_of_table({"intact"}, {"extension"}, {});
  cases::CaseData without_field = left_wrist().data;
  without_field.bones.back().distance_field = {};
  EXPECT_THROW(static_cast<void>(section(without_field, left_wrist().tissue, table)), InvalidInput);
  SoftTissue without_dic = left_wrist().tissue;
  std::erase_if(without_dic.ligaments, [](const Ligament& l) { return l.id == "DIC"; });
  EXPECT_THROW(static_cast<void>(section(left_wrist().data, without_dic, table)), InvalidInput);
}

}  // namespace
}  // namespace carpus::soft_tissue
