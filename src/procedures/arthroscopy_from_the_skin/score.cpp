// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How the portals were made and how one looked round by them: what is measured of either, and of
// what both measure (what was struck, time, steps) the portals' word.
#include <algorithm>
#include <utility>
#include <vector>

#include "core/units.hpp"
#include "procedure/grading.hpp"
#include "procedures/arthroscopic_portal_making/declared.hpp"
#include "procedures/arthroscopy/conduct.hpp"
#include "procedures/arthroscopy/hand_measures.hpp"
#include "procedures/arthroscopy_from_the_skin/declared.hpp"

namespace carpus::procedures::arthroscopy_from_the_skin {

using procedure::Measure;

namespace {

/// A needle that nobody looked for was seen for no time.
Measure needle_seen(const procedure::OperationRecord& record) {
  Measure seen{"second_needle_seen_s", {}, ""};
  const procedure::MakingFacts facts = record.making.value_or(procedure::MakingFacts{});
  if (facts.made < procedure::kPortalsMade) return seen;
  seen.value = static_cast<double>(facts.portal[1].needle_seen_ticks) * kTickSeconds;
  if (facts.portal[1].needle_seen_ticks == 0) {
    seen.finding = "Its point was never in the scope's picture, in the joint, before skin was cut.";
  }
  return seen;
}

}  // namespace

procedure::ScoreReport score(const cases::CaseData& data,
                             const procedure::OperationRecord& record) {
  std::vector<Measure> measures = arthroscopic_portal_making::measures_of(declared(), data, record);
  for (Measure& other : arthroscopy::conduct_measures(data, declared(), record)) {
    const bool is_there = std::any_of(measures.begin(), measures.end(),
                                      [&](const Measure& one) { return one.id == other.id; });
    if (!is_there) measures.push_back(std::move(other));
  }
  measures.push_back(needle_seen(record));
  procedure::ScoreReport report;
  procedure::grade(report, declared().rules, measures);
  arthroscopy::tell_scuffs(report, data, record);
  return report;
}

}  // namespace carpus::procedures::arthroscopy_from_the_skin
