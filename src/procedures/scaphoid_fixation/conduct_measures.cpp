// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <utility>

#include "anatomy/bone_words.hpp"
#include "core/units.hpp"
#include "procedure/thrift_measures.hpp"
#include "procedures/scaphoid_fixation/measures.hpp"
#include "procedures/scaphoid_fixation/predicates.hpp"
#include "procedures/scaphoid_fixation/views.hpp"

namespace carpus::procedures::scaphoid_fixation {
namespace {

using instruments::Work;
using procedure::Measure;
using procedure::text_of;

constexpr const char* kNoWire = "No wire went into bone.";

Measure wire_passes(const Facts& facts) {
  Measure measure{"wire_passes", std::nullopt, kNoWire};
  if (facts.wire_passes > 0) {
    measure.value = facts.wire_passes;
    measure.finding.clear();
  }
  return measure;
}

/// The joint that something came into where the line ends; empty where no bone lies before it.
std::string joint_entered(const Facts& facts) {
  if (!facts.line || facts.line->leaves_towards.empty()) return "";
  return " Before the line's far end lies the " + facts.line->leaves_towards +
         ": that joint was entered.";
}

std::string ways_out_in_words(const Facts& facts, std::uint32_t times) {
  if (times == 0) return "Nothing came out at the far side.";
  return "Something came out at the far side " + std::to_string(times) +
         (times == 1 ? " time." : " times.") + joint_entered(facts);
}

/// By wires and what ran over them; where a wire is meant to be drawn through, once is right.
Measure far_exits(const Facts& facts) {
  Measure measure{"far_exits", std::nullopt, kNoWire};
  if (facts.record.passes.empty()) return measure;
  std::uint32_t times = 0;
  for (const procedure::Pass& pass : facts.record.passes) times += pass.far_exits;
  measure.value = times;
  measure.finding = ways_out_in_words(facts, times);
  return measure;
}

/// Wires that came out beside the far pole: whose way in the bone was much shorter than the
/// longest.
Measure side_exits(const Facts& facts) {
  constexpr double kPoleShare = 0.7;  // of the longest line [E]
  Measure measure{"side_exits", std::nullopt, kNoWire};
  if (facts.record.passes.empty()) return measure;
  const cases::AxisSegment& longest = facts.marks.longest_line;
  const double least_mm = kPoleShare * distance(longest.proximal, longest.distal);
  measure.value = 0.0;
  for (const procedure::Pass& pass : facts.record.passes) {
    if (pass.shortest_exit_mm > 0.0 && pass.shortest_exit_mm < least_mm) *measure.value += 1.0;
  }
  measure.finding = *measure.value > 0.0 ? "The bone's side was gone through, not its far pole."
                                         : "Whatever came out did so at the far pole.";
  return measure;
}

/// 1 where the drill ran only over a wire that stood out of the skin at both ends.
Measure wire_held(const Facts& facts) {
  constexpr double kScratchMm = 0.5;
  Measure measure{"wire_held_while_reaming", std::nullopt, "No drill went over the wire."};
  if (!(facts.record.reamed_mm > 0.0)) return measure;
  const bool is_held = facts.record.unheld_ream_mm < kScratchMm;
  measure.value = is_held ? 1.0 : 0.0;
  measure.finding = is_held ? "It stood out at both ends." : "It was out at one end alone.";
  return measure;
}

/// 1 where what was said before drilling is how the pieces lay.
Measure judgement_right(const Facts& facts) {
  using procedure::Judgement;
  Measure measure{"judgement_right", 0.0, "It was not said whether the fracture was displaced."};
  if (facts.record.judgement == Judgement::None) return measure;
  const bool is_displaced = lies_apart(facts.record.fracture_at_first);
  const bool said_so = facts.record.judgement == Judgement::Displaced;
  measure.value = said_so == is_displaced ? 1.0 : 0.0;
  measure.finding = std::string("Said: ") + (said_so ? "displaced" : "aligned") + "; it was " +
                    (is_displaced ? "displaced." : "aligned.");
  return measure;
}

/// Flexion through which the wrist was moved under live pictures with the screw seated.
Measure seen_in_motion(const Facts& facts) {
  Measure measure{"seen_in_motion_deg", 0.0, "The screw was not looked at live."};
  std::optional<anatomy::Interval> range;
  for (const procedure::Shot& shot : facts.record.shots) {
    if (shot.look == procedure::Look::Single || !shot.shows_screw) continue;
    const double flexion = shot.wrist.flexion_rad;
    range = range ? anatomy::Interval{std::min(range->low, flexion), std::max(range->high, flexion)}
                  : anatomy::Interval{flexion, flexion};
  }
  if (!range) return measure;
  measure.value = degrees_from_radians(range->high - range->low);
  measure.finding = "Live pictures with the screw in, the wrist moved so far.";
  return measure;
}

/// Wires, and what ran over them.
Measure beyond_far_cortex(const Facts& facts) {
  Measure measure{"beyond_far_cortex_mm", std::nullopt, kNoWire};
  if (facts.record.passes.empty()) return measure;
  double deepest = 0.0;
  std::uint32_t times = 0;
  for (const procedure::Pass& pass : facts.record.passes) {
    deepest = std::max({deepest, pass.far_exit_mm, pass.follower_exit_mm});
    times += pass.far_exits;
  }
  measure.value = deepest;
  measure.finding = ways_out_in_words(facts, times);
  return measure;
}

/// What ran over the wire alone: a wire may be meant to go through.
Measure follower_beyond_far_cortex(const Facts& facts) {
  Measure measure{"follower_beyond_far_cortex_mm", std::nullopt, kNoWire};
  if (facts.record.passes.empty()) return measure;
  measure.value = 0.0;
  for (const procedure::Pass& pass : facts.record.passes) {
    measure.value = std::max(*measure.value, pass.follower_exit_mm);
  }
  measure.finding = *measure.value > 0.0
                        ? "Drill or screw came out at the far side." + joint_entered(facts)
                        : "Neither came out.";
  return measure;
}

Measure wire_bend(const Facts& facts) {
  Measure measure{"wire_bend_deg", std::nullopt, kNoWire};
  if (facts.wire_passes == 0) return measure;
  measure.value = degrees_from_radians(facts.record.most_bend_rad);
  measure.finding = *measure.value > 0.0
                        ? "The wrist was moved while the wire stood out over the radius."
                        : "The wire stayed straight.";
  return measure;
}

/// How the fragments lie at the end, of a bone in two pieces.
Measure of_fracture(const Facts& facts, const char* id, double value) {
  Measure measure{id, value, ""};
  measure.applies = facts.record.fracture.is_apart;
  return measure;
}

double angle_deg(const procedure::FractureFacts& fracture) {
  return degrees_from_radians(std::acos(std::clamp(fracture.cosine_angle, -1.0, 1.0)));
}

Measure wires_broken(const Facts& facts) {
  return {"wires_broken", static_cast<double>(facts.record.broken_wires), ""};
}

Measure wrong_bones(const Facts& facts) {
  Measure measure{"wrong_bones_entered", std::nullopt, kNoWire};
  if (facts.record.passes.empty()) return measure;
  const auto& allowed = facts.fixation.procedure->allowed;
  measure.value = 0.0;
  measure.finding.clear();
  for (const BoneId bone : facts.entered) {
    if (std::find(allowed.begin(), allowed.end(), bone) != allowed.end()) continue;
    *measure.value += 1.0;
    measure.finding += (measure.finding.empty() ? "Entered: the " : ", the ");
    measure.finding += words_of(bone);
  }
  measure.finding += measure.finding.empty() ? "None was." : ".";
  return measure;
}

/// Far end of the line less the drill's greatest depth.
Measure ream_short(const Facts& facts) {
  Measure measure{"ream_short_of_far_cortex_mm", std::nullopt, "No drill went over the wire."};
  if (!facts.line || !(facts.record.reamed_mm > 0.0)) return measure;
  measure.value = facts.line->chord.leave_mm - facts.record.reamed_mm;
  measure.finding.clear();
  return measure;
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
  for (const instruments::InstrumentIndex index : facts.fixation.procedure->tray) {
    if (all[index].work == Work::Ream) widest = std::max(widest, all[index].cut_tail_radius_mm);
  }
  return widest;
}

/// Cartilage of the trapezium that was lost on the way: a round hole for every pass of a wire
/// through it, and the last of them as wide as what followed.
Measure trapezium_cartilage(const Facts& facts) {
  Measure measure{"trapezium_cartilage_mm2", std::nullopt, kNoWire};
  const auto& allowed = facts.fixation.procedure->allowed;
  measure.applies = std::find(allowed.begin(), allowed.end(), BoneId::Trapezium) != allowed.end();
  if (facts.wire_passes == 0) return measure;
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
  measure.value = lost;
  measure.finding = lost > 0 ? "It was gone through." : "The trapezium was left whole.";
  return measure;
}

/// How many of `wanted` (bits of View) were taken while wire, or screw, lay in place.
Measure views(const Facts& facts, const char* id, bool of_screw, unsigned wanted) {
  const unsigned seen = views_of(facts.record.shots, of_screw) & wanted;
  Measure measure{id, static_cast<double>(std::popcount(seen)), ""};
  for (int i = 0; i < kViewCount; ++i) {
    if ((wanted >> i & 1U) == 0 || (seen >> i & 1U) != 0) continue;
    measure.finding += (measure.finding.empty() ? "Not taken: " : ", ");
    measure.finding += in_words(static_cast<View>(i));
  }
  measure.finding += measure.finding.empty() ? "All were taken." : ".";
  return measure;
}

std::optional<procedure::CaseAnswer> answer_of(const cases::CaseData& data) {
  if (!data.lesson) return std::nullopt;
  return procedure::CaseAnswer{data.lesson->title, data.lesson->right_answer, data.lesson->reason};
}

/// Nothing was placed: what is told of the case is its lesson.
procedure::ScoreReport score_of_declining(const cases::CaseData& data,
                                          const procedure::OperationRecord& record,
                                          const procedure::Procedure& procedure) {
  procedure::ScoreReport report;
  report.answer = answer_of(data);
  for (std::size_t i = 0; i < procedure.decline.reasons.size(); ++i) {
    if ((record.declined_for >> i & 1U) == 0) continue;
    report.declined_for.push_back(procedure.decline.reasons[i].label);
  }
  procedure::grade(report, procedure.decline.rules, decline_measures(data, record, procedure));
  return report;
}

Measure wires_left_in(const Facts& facts) {
  Measure measure{"wires_left_in", 0.0, ""};
  for (const procedure::LineFacts& line : facts.record.lines) {
    if (line.instrument >= instruments::catalogue().size()) continue;
    if (instruments::catalogue()[line.instrument].work == Work::Drill) *measure.value += 1.0;
  }
  return measure;
}

}  // namespace

std::vector<Measure> conduct_measures(const Facts& facts) {
  std::vector<Measure> all{
      wire_passes(facts),
      far_exits(facts),
      side_exits(facts),
      wire_held(facts),
      judgement_right(facts),
      seen_in_motion(facts),
      beyond_far_cortex(facts),
      follower_beyond_far_cortex(facts),
      wire_bend(facts),
      wires_broken(facts),
      of_fracture(facts, "fracture_gap_mm", std::max(0.0, facts.record.fracture.gap_mm)),
      of_fracture(facts, "fracture_step_mm", facts.record.fracture.step_mm),
      of_fracture(facts, "fracture_angle_deg", angle_deg(facts.record.fracture)),
      wrong_bones(facts),
      ream_short(facts),
      trapezium_cartilage(facts),
      views(facts, "views_with_wire", false, kViewsOfWire),
      views(facts, "views_with_screw", true, kViewsOfScrew),
      wires_left_in(facts),
  };
  for (Measure& measure :
       procedure::thrift_measures(*facts.fixation.procedure, facts.record,
                                  views_taken(facts.record), doses_by_view(facts.record))) {
    all.push_back(std::move(measure));
  }
  return all;
}

procedure::ScoreReport score(const cases::CaseData& data,
                             const procedure::OperationRecord& record,
                             const Fixation& fixation) {
  if (record.declined_for != 0) return score_of_declining(data, record, *fixation.procedure);
  const Facts facts = facts_of(data, record, fixation);
  procedure::ScoreReport report = references_of(facts);
  report.answer = answer_of(data);
  std::vector<Measure> measures = placement_measures(facts);
  for (Measure& measure : conduct_measures(facts)) measures.push_back(std::move(measure));
  measures.push_back(fixing_is_right(data));
  for (Measure& measure : structure_measures(facts)) measures.push_back(std::move(measure));
  procedure::grade(report, fixation.procedure->rules, measures);
  return report;
}

}  // namespace carpus::procedures::scaphoid_fixation
