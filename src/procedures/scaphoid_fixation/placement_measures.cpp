// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <string>

#include "procedure/thrift_measures.hpp"
#include "procedures/scaphoid_fixation/measures.hpp"
#include "procedures/scaphoid_fixation/screws.hpp"

namespace carpus::procedures::scaphoid_fixation {
namespace {

using procedure::Measure;
using procedure::text_of;

constexpr const char* kNoLine = "Neither wire nor screw lies in the scaphoid.";
constexpr const char* kNoScrew = "No screw lies in the scaphoid.";

Measure offset(const Facts& facts, const char* id, const Offset LinePlacement::*which) {
  Measure measure{id, std::nullopt, kNoLine};
  if (!facts.line) return measure;
  const Offset& at = (*facts.line).*which;
  measure.value = at.percent_of_width();
  measure.finding = text_of(at.distance_mm) + " mm " + at.towards +
                    " of the middle, where the bone is " + text_of(at.local_width_mm) + " mm wide.";
  return measure;
}

Measure of_screw(const Facts& facts,
                 const char* id,
                 const double ScrewPlacement::*which,
                 const std::string& finding = {}) {
  Measure measure{id, std::nullopt, kNoScrew};
  if (!facts.placed) return measure;
  measure.value = (*facts.placed).*which;
  measure.finding = finding;
  return measure;
}

Measure cover(const Facts& facts, const char* id, Approach whose_tail) {
  const bool is_tail = facts.fixation.approach == whose_tail;
  const auto which = is_tail ? &ScrewPlacement::tail_cover_mm : &ScrewPlacement::tip_cover_mm;
  Measure measure = of_screw(facts, id, which,
                             is_tail ? "The screw's tail is here." : "The screw's tip is here.");
  if (measure.value && *measure.value < 0.0) {
    measure.finding += " It stands out by " + text_of(-*measure.value) + " mm.";
  }
  return measure;
}

Measure penetration(const Facts& facts) {
  Measure measure = of_screw(facts, "penetration_mm", &ScrewPlacement::penetration_mm);
  if (!measure.value) return measure;
  measure.finding = *measure.value > 0.0
                        ? "The screw stands out: " + facts.placed->penetration_at + "."
                        : "No part of the screw stands out of the scaphoid.";
  if (facts.placed->penetration_at.find("towards") != std::string::npos) {
    measure.finding += " That joint was entered.";
  }
  return measure;
}

Measure usable_length(const Facts& facts) {
  Measure measure{"usable_length_percent", std::nullopt, kNoLine};
  const auto& longest = facts.marks.longest_line;
  const double longest_mm = distance(longest.proximal, longest.distal);
  if (!facts.line || !(longest_mm > 0.0)) return measure;
  measure.value = 100.0 * facts.line->length_mm() / longest_mm;
  measure.finding = "This line is " + text_of(facts.line->length_mm()) +
                    " mm long in the bone, the longest " + text_of(longest_mm) + " mm.";
  return measure;
}

Measure angle(const Facts& facts) {
  Measure measure{"angle_to_central_axis_deg", std::nullopt, kNoLine};
  if (!facts.line) return measure;
  measure.value = facts.line->angle_deg;
  measure.finding.clear();
  return measure;
}

Measure in_smaller_fragment(const Facts& facts) {
  Measure measure =
      of_screw(facts, "screw_in_smaller_fragment_mm", &ScrewPlacement::in_smaller_part_mm);
  measure.applies = cases::scaphoid_parts(facts.data).size() > 1;
  return measure;
}

Measure length_against_ideal(const Facts& facts) {
  Measure measure{"screw_length_minus_ideal_mm", std::nullopt, kNoScrew};
  if (!facts.placed || !facts.line) return measure;
  const int ideal = ideal_screw_of(facts);
  if (ideal < 0) {
    measure.finding = "On this line the bone is too short for any screw on the tray.";
    return measure;
  }
  const auto catalogue = instruments::catalogue();
  const double ideal_mm = catalogue[facts.screws[static_cast<std::size_t>(ideal)]].length_mm;
  measure.value = catalogue[facts.screw->instrument].length_mm - ideal_mm;
  measure.finding = "The line is " + text_of(facts.line->length_mm()) +
                    " mm long between the cortices; " + text_of(kMeasuredMinusScrewMm) +
                    " mm less, for 2 mm of bone at each end, allows " + text_of(ideal_mm) + " mm.";
  return measure;
}

/// The gauge reads the wire, not the bone: what it was off by becomes the screw's fault.
Measure gauge_against_line(const Facts& facts) {
  Measure measure{"gauge_minus_line_mm", std::nullopt, "The length was not measured."};
  const double reading_mm = facts.record.gauge_reading_mm;
  if (reading_mm < 0.0) return measure;
  measure.finding = kNoLine;
  if (!facts.line) return measure;
  const double line_mm = facts.line->length_mm();
  measure.value = reading_mm - line_mm;
  measure.finding = "The gauge read " + text_of(reading_mm) + " mm, the bone is " +
                    text_of(line_mm) + " mm long on this line.";
  constexpr double kTellMm = 0.75;  // the gauge's steps are 0.5 mm
  if (std::abs(*measure.value) > kTellMm) {
    measure.finding += std::string(" The wire's tip stood ") + text_of(std::abs(*measure.value)) +
                       " mm " + (*measure.value > 0.0 ? "beyond" : "before") + " the far cortex.";
  }
  return measure;
}

Measure hold(const Facts& facts) {
  Measure measure{"hold_percent", std::nullopt, kNoScrew};
  if (!facts.placed) return measure;
  measure.value = 100.0 * facts.record.holding_share;
  measure.finding.clear();
  return measure;
}

Measure compression(const Facts& facts) {
  Measure measure{"compression_n", std::nullopt, kNoScrew};
  if (!facts.placed) return measure;
  measure.value = facts.record.compression_n;
  measure.finding =
      facts.record.stripped_screws > 0 ? "A thread gave way: it was turned on too far." : "";
  return measure;
}

Measure stripped(const Facts& facts) {
  Measure measure{"screws_stripped", std::nullopt, kNoScrew};
  // Stripped once counts, wherever that screw is now; a thread that never held proved nothing.
  if (!facts.placed && facts.record.stripped_screws == 0) return measure;
  measure.value = static_cast<double>(facts.record.stripped_screws);
  measure.finding.clear();
  return measure;
}

}  // namespace

std::vector<Measure> placement_measures(const Facts& facts) {
  return {{"screw_placed", facts.placed ? 1.0 : 0.0, ""},
          offset(facts, "waist_offset_percent", &LinePlacement::at_waist),
          offset(facts, "proximal_offset_percent", &LinePlacement::at_proximal),
          offset(facts, "distal_offset_percent", &LinePlacement::at_distal),
          of_screw(facts, "bone_beside_screw_mm", &ScrewPlacement::beside_mm),
          usable_length(facts),
          angle(facts),
          cover(facts, "proximal_cover_mm", Approach::FromProximal),
          cover(facts, "distal_cover_mm", Approach::FromDistal),
          penetration(facts),
          in_smaller_fragment(facts),
          length_against_ideal(facts),
          gauge_against_line(facts),
          hold(facts),
          compression(facts),
          stripped(facts)};
}

}  // namespace carpus::procedures::scaphoid_fixation
