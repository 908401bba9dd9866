// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How far each exercise was done and how often it was lost, besides how both hands went.
#include <string>
#include <vector>

#include "procedure/grading.hpp"
#include "procedure/thrift_measures.hpp"
#include "procedures/arthroscopic_basics/declared.hpp"
#include "procedures/arthroscopy/conduct.hpp"
#include "procedures/arthroscopy/hand_measures.hpp"

namespace carpus::procedures::arthroscopic_basics {
namespace {

using procedure::Measure;

std::string of_so_many(std::size_t done, std::size_t all) {
  return std::to_string(done) + " of " + std::to_string(all) + ".";
}

/// What was not done has no faults either: no measure, no points.
Measure faults(const char* id, std::uint32_t count, bool is_done) {
  Measure measure{id, {}, ""};
  if (is_done) measure.value = count;
  return measure;
}

std::vector<Measure> drill_measures(const procedure::ScopeDrill& drill,
                                    const procedure::DrillFacts& done) {
  const auto share = [](std::size_t part, std::size_t all) {
    return 100.0 * static_cast<double>(part) / static_cast<double>(all);
  };
  std::vector<Measure> measures;
  const bool has_held = done.held >= drill.hold.size();
  const bool has_touched = done.touched >= drill.touch.size();
  measures.push_back({"held_share", share(done.held, drill.hold.size()),
                      of_so_many(done.held, drill.hold.size())});
  measures.push_back(faults("hold_breaks", done.hold_breaks, has_held));
  measures.push_back({"seen_from_one_place", static_cast<double>(done.round_most), ""});
  measures.push_back({"touched_share", share(done.touched, drill.touch.size()),
                      of_so_many(done.touched, drill.touch.size())});
  measures.push_back(faults("wrong_touches", done.wrong_touches, has_touched));
  measures.push_back({"line_share", done.line_share * 100.0, ""});
  measures.push_back(faults("line_breaks", done.line_breaks, done.is_line_done));
  Measure unseen{"probe_unseen_share", {}, ""};
  const double path = done.seen_path_mm + done.unseen_path_mm;
  if (has_touched && path > 0) {
    unseen.value = 100.0 * done.unseen_path_mm / path;
    unseen.finding = procedure::text_of(done.unseen_path_mm) + " of " + procedure::text_of(path) +
                     " mm in the joint.";
  }
  measures.push_back(std::move(unseen));
  return measures;
}

}  // namespace

procedure::ScoreReport scored(const procedure::Procedure& graded,
                              const cases::CaseData& data,
                              const procedure::OperationRecord& record) {
  std::vector<Measure> measures = arthroscopy::conduct_measures(data, graded, record);
  const procedure::DrillFacts done =
      record.scope ? record.scope->facts.drill : procedure::DrillFacts{};
  for (Measure& each : drill_measures(*graded.drill, done)) {
    measures.push_back(std::move(each));
  }
  procedure::ScoreReport report;
  procedure::grade(report, graded.rules, measures);
  arthroscopy::tell_scuffs(report, data, record);
  return report;
}

procedure::ScoreReport score(const cases::CaseData& data,
                             const procedure::OperationRecord& record) {
  return scored(declared(), data, record);
}

}  // namespace carpus::procedures::arthroscopic_basics
