// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/view_debrief.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "view_trainer/screw_test_support.hpp"

namespace carpus::server {
namespace {

using view_trainer::test::broken_wrist;
using view_trainer::test::short_screw_in_the_middle;

/// The broken scaphoid with a short screw through its gap, fixed in the first piece; the other one
/// lies by so much across the bone beside where it was scanned.
class Operated {
 public:
  explicit Operated(const cases::CaseData& data, double across_mm) {
    const view_trainer::PlacedScrew placed = short_screw_in_the_middle();
    shot.snapshot.body_count = static_cast<std::uint8_t>(data.bones.size());
    std::size_t piece = 0;
    for (std::size_t b = 0; b < data.bones.size(); ++b) {
      if (data.bones[b].bone != BoneId::Scaphoid) continue;
      if (piece++ == 0) first_ = b;
      if (piece == 2) {
        const Vec3 across = any_perpendicular(placed.shaft);
        shot.snapshot.patient_from_bone[b].translation = across * across_mm;
      }
    }
    simulation::ItemView& screw = shot.snapshot.items[0];
    screw.instrument = placed.screw;
    screw.body = static_cast<std::uint8_t>(first_);
    screw.tip_in_patient = placed.tip;
    screw.shaft_in_patient = placed.shaft;
    shot.number = 1;
  }
  TakenShot shot;

 private:
  std::size_t first_ = 0;
};

double extent(const protocol::PictureTruth& truth) {
  double low = 1e9;
  double high = -1e9;
  for (const auto& outline : truth.bone) {
    for (std::size_t i = 0; i + 1 < outline.pixels.size(); i += 2) {
      const double sum = outline.pixels[i] + outline.pixels[i + 1];
      low = std::min(low, sum);
      high = std::max(high, sum);
    }
  }
  return high - low;
}

TEST(ViewDebrief, JudgesThePiecesAsTheyLie) {
  const cases::CaseData data = broken_wrist();
  ViewDebrief debrief(data);
  const Operated as_scanned(data, 0);
  const Operated beside(data, 4);
  const auto scanned = debrief.debrief(as_scanned.shot.snapshot, {}).faults;
  ASSERT_EQ(scanned.size(), 1U);
  EXPECT_EQ(scanned[0].kind, protocol::FaultKind::Gap) << "of the fracture, as it was scanned";
  const auto shows = [](const auto& seen) { return seen.reveals; };
  EXPECT_TRUE(std::ranges::any_of(scanned[0].seen, shows));
  EXPECT_FALSE(std::ranges::all_of(scanned[0].seen, shows)) << "one piece hides it from some";
  // The piece beside it no longer covers the screw that goes into it.
  const auto faults = debrief.debrief(beside.shot.snapshot, {}).faults;
  ASSERT_FALSE(faults.empty());
  EXPECT_EQ(faults.front().kind, protocol::FaultKind::ScrewOut);
  EXPECT_GT(faults.front().depth_mm, 0.5);
}

TEST(ViewDebrief, OutlinesThePiecesAsTheyLay) {
  const cases::CaseData data = broken_wrist();
  ViewDebrief debrief(data);
  const double scanned = extent(debrief.truth_of(Operated(data, 0).shot));
  EXPECT_NE(extent(debrief.truth_of(Operated(data, 6).shot)), scanned);
  EXPECT_EQ(extent(debrief.truth_of(Operated(data, 0).shot)), scanned) << "and from what is kept";
}

TEST(ViewDebrief, TellsOnlyPicturesOnWhichThePiecesLieAsAtTheEnd) {
  const cases::CaseData data = broken_wrist();
  ViewDebrief debrief(data);
  const Operated end(data, 4);
  const Operated before(data, 3);
  const auto pictures = [&](const TakenShot& taken) {
    const auto message = debrief.debrief(end.shot.snapshot, std::span(&taken, 1));
    const auto& seen = message.faults.front().seen;
    return std::count_if(seen.begin(), seen.end(), [](const auto& each) { return each.shot != 0; });
  };
  EXPECT_EQ(pictures(end.shot), 1);
  EXPECT_EQ(pictures(before.shot), 0);
}

TEST(ViewDebrief, TellsWhichViewsShowAStep) {
  const cases::CaseData data = broken_wrist();
  ViewDebrief debrief(data);
  const auto step_of = [&](double across_mm) -> std::optional<protocol::PlacementFault> {
    for (auto& fault : debrief.debrief(Operated(data, across_mm).shot.snapshot, {}).faults) {
      if (fault.kind == protocol::FaultKind::Step) return std::move(fault);
    }
    return std::nullopt;
  };
  EXPECT_FALSE(step_of(0).has_value());
  const auto step = step_of(4);
  ASSERT_TRUE(step.has_value());
  EXPECT_NEAR(step->depth_mm, 4.0, 0.5);
  const auto by_mm = [](const auto& a, const auto& b) { return a.overhang_mm < b.overhang_mm; };
  const auto [least, most] = std::minmax_element(step->seen.begin(), step->seen.end(), by_mm);
  EXPECT_LE(most->overhang_mm, step->depth_mm + 1e-9);
  EXPECT_GT(most->overhang_mm, 0.8 * step->depth_mm) << "one view looks across it";
  EXPECT_LT(least->overhang_mm, 0.8 * most->overhang_mm) << "and another along it";
}

TEST(ViewDebrief, AScrewInTheSecondPieceIsSeenFromTheFirst) {
  const cases::CaseData data = broken_wrist();
  Operated beside(data, 4);
  auto& item = beside.shot.snapshot.items[0];
  for (std::size_t b = 0; b < data.bones.size(); ++b) {
    if (data.bones[b].bone == BoneId::Scaphoid) item.body = static_cast<std::uint8_t>(b);
  }
  const auto screw = ViewDebrief::screw_in(data, beside.shot.snapshot);
  ASSERT_TRUE(screw.has_value());
  EXPECT_LT(distance(screw->tip, item.tip_in_patient), 1e-9) << "the first lies as scanned";
}

}  // namespace
}  // namespace carpus::server
