// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/units.hpp"
#include "procedure/score_items.hpp"
#include "procedures/scaphoid_fixation/score_items.hpp"
#include "procedures/volar_scaphoid_fixation/declared.hpp"

namespace carpus::procedures::volar_scaphoid_fixation {
namespace {

using instruments::Work;
using procedure::Grade;
using procedure::ScoreItem;
using scaphoid_fixation::Facts;

/// How far the drill stayed from the far cortex: 2 mm are wanted [clinical: K, B1 step 8].
ScoreItem ream_item(const Facts& facts, double points) {
  constexpr double kShortMm = 2.0;
  constexpr double kGoodWithinMm = 1.0;
  constexpr double kTooShallowMm = 10.0;
  ScoreItem item = procedure::make_item("ream_short_of_far_cortex_mm",
                                        "Drill stopped before the far cortex", "mm", points);
  item.target = "2 ± 1 mm good; through the cortex, or over 10 mm short, fail";
  item.reason =
      "The screw's thread needs a bed of its core's width, but the far cortex is what it holds in.";
  if (!facts.line || !(facts.record.reamed_mm > 0.0)) {
    item.reason += " No drill went over the wire.";
    return item;
  }
  const double left = facts.line->chord.leave_mm - facts.record.reamed_mm;
  item.value = left;
  const double off = left < kShortMm ? kShortMm - left : left - kShortMm;
  const double worst = left < kShortMm ? kShortMm : kTooShallowMm - kShortMm;
  item.points = procedure::falling_points(off, kGoodWithinMm, worst, points);
  item.grade = off <= kGoodWithinMm ? Grade::Good : (off > worst ? Grade::Fail : Grade::Acceptable);
  return item;
}

double area_of(double radius_mm) { return kPi * radius_mm * radius_mm; }

bool is_through_trapezium(const Facts& facts, const procedure::Pass& pass) {
  const auto& bones = facts.data.bones;
  for (std::size_t body = 0; body < bones.size() && body < 32; ++body) {
    const bool is_entered = (pass.bodies_entered >> body & 1U) != 0;
    if (is_entered && bones[body].bone == BoneId::Trapezium) return true;
  }
  return false;
}

/// Radius of the widest thing that followed the wire: screw or drill; 0 when none did.
double widest_follower_mm(const Facts& facts) {
  const auto all = instruments::catalogue();
  double widest = 0.0;
  if (facts.screw) widest = all[facts.screw->instrument].tail_diameter_mm / 2;
  if (!(facts.record.reamed_mm > 0.0)) return widest;
  for (const instruments::InstrumentIndex index : facts.rules.procedure->tray) {
    if (all[index].work == Work::Ream) widest = std::max(widest, all[index].cut_tail_radius_mm);
  }
  return widest;
}

/// Cartilage of the trapezium that was lost on the way: a round hole for every pass of a wire
/// through it, and the last of them as wide as what followed.
ScoreItem trapezium_item(const Facts& facts, double points) {
  constexpr double kGoodMm2 = 1.1;   // one guide wire
  constexpr double kFailMm2 = 17.0;  // two ways of a drill of 3.2 mm
  ScoreItem item = procedure::make_item("trapezium_cartilage_mm2",
                                        "Cartilage of the trapezium that was lost", "mm2", points);
  item.target = "at most 1.1 mm² good (the way of one wire), over 17 mm² fail";
  item.reason = "No wire lies in the scaphoid: there is nothing to measure.";
  if (facts.wire_passes == 0) return item;
  double lost = 0.0;
  double last_wire = 0.0;
  for (const procedure::Pass& pass : facts.record.passes) {
    if (pass.instrument >= instruments::catalogue().size()) continue;
    last_wire = 0.0;
    if (!is_through_trapezium(facts, pass)) continue;
    last_wire = instruments::catalogue()[pass.instrument].cut_tail_radius_mm;
    lost += area_of(last_wire);
  }
  const double follower = widest_follower_mm(facts);
  if (last_wire > 0.0 && follower > last_wire) lost += area_of(follower) - area_of(last_wire);
  procedure::grade_falling(item, lost, kGoodMm2, kFailMm2);
  item.reason = lost > 0 ? "Through the trapezium the line is easier to reach, but each way costs "
                           "cartilage of its "
                           "joint: a drill's takes about 11 percent."
                         : "The trapezium was left whole.";
  return item;
}

}  // namespace

procedure::ScoreReport score(const cases::CaseData& data,
                             const procedure::OperationRecord& record) {
  using namespace scaphoid_fixation;  // NOLINT(google-build-using-namespace): its items by name
  const Rules rules{&declared(), Approach::FromDistal, kDriveStep, kInsertStep};
  Facts facts = facts_of(data, record, rules);
  procedure::ScoreReport report = report_of(facts);
  report.items = {
      angle_item(facts, 13),        waist_item(facts, 11),         proximal_offset_item(facts, 7),
      distal_offset_item(facts, 7), proximal_cover_item(facts, 8), distal_cover_item(facts, 7),
      penetration_item(facts, 12),  length_item(facts, report, 9), ream_item(facts, 5),
      passes_item(facts, 4),        views_item(facts, 5),          wrong_bones_item(facts, 3),
      trapezium_item(facts, 4),
  };
  for (ScoreItem& item : thrift_items(facts, 1, 1, 2, 1)) report.items.push_back(std::move(item));
  procedure::sum_up(report);
  return report;
}

}  // namespace carpus::procedures::volar_scaphoid_fixation
