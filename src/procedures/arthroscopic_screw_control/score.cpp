// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What was answered against how the screw lies, and what was known when it was answered.
#include <bit>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "arthroscopy/screw_table.hpp"
#include "procedure/grading.hpp"
#include "procedures/arthroscopic_screw_control/declared.hpp"
#include "procedures/arthroscopy/conduct.hpp"
#include "procedures/arthroscopy/hand_measures.hpp"

namespace carpus::procedures::arthroscopic_screw_control {
namespace {

using carpus::arthroscopy::kScrewDecision;
using carpus::arthroscopy::PathologyTable;
using carpus::arthroscopy::ScrewTable;
using cases::kScrewSites;
using procedure::Measure;

constexpr double kUnfelt = 0.5;  // of an end judged by the eye alone [E]

bool has(std::uint8_t bits, std::size_t at) { return (bits >> at & 1U) != 0; }

void add(std::string& list, const std::string& what) { list += (list.empty() ? "" : "; ") + what; }

std::string label_of(std::size_t asked, std::uint8_t grade) {
  const PathologyTable& table = ScrewTable::generic().questions;
  const auto& grades = table.scale_of(asked).grades;
  return grade < grades.size() ? grades[grade].label : "not answered";
}

/// What was said of the sites.
struct Sites {
  double right = 0;
  double there = 0;  ///< that stand out
  double missed = 0;
  double invented = 0;
  double unseen = 0;  ///< answers
  std::string wrong;
};

void judge(Sites& sum, std::size_t site, const procedure::ScopeRecord& scope) {
  using carpus::arthroscopy::says_proud;
  const std::uint8_t said = scope.answers[site];
  const std::uint8_t truth = scope.truth[site];
  const procedure::ScrewFacts& known = scope.facts.screw;
  const bool is_said = said != cases::kNotJudged;
  const bool is_seen = is_said && has(known.answered_seen, site);
  const bool is_proud = says_proud(site, truth);
  if (is_said && !is_seen) ++sum.unseen;
  if (is_proud) ++sum.there;
  // Said without having looked, it was not found.
  if (is_proud && !(is_seen && says_proud(site, said))) ++sum.missed;
  if (!is_proud && says_proud(site, said)) ++sum.invented;
  const bool needs_probe = site == static_cast<std::size_t>(cases::ScrewSite::Proximal);
  if (said == truth && is_seen) {
    sum.right += needs_probe && !has(known.answered_probed, site) ? kUnfelt : 1.0;
    return;
  }
  const std::string name = ScrewTable::generic().questions.findings[site].label;
  if (said == truth) return add(sum.wrong, name + ": not looked at before");
  add(sum.wrong, name + ": " + label_of(site, said) + " instead of " + label_of(site, truth));
}

Measure decision(const procedure::ScopeRecord& scope) {
  const std::uint8_t said = scope.answers[kScrewDecision];
  const std::uint8_t truth = scope.truth[kScrewDecision];
  const int seen = std::popcount(scope.facts.screw.sites_at_decision);
  Measure measure{"decision_right", 0.0, ""};
  if (said == truth) {
    measure.value = 100.0 * seen / static_cast<double>(kScrewSites);
    if (seen < static_cast<int>(kScrewSites)) {
      measure.finding = "Right, after " + std::to_string(seen) + " of 3 places had been in view.";
    }
  } else {
    measure.finding =
        label_of(kScrewDecision, said) + " instead of " + label_of(kScrewDecision, truth) + ".";
  }
  return measure;
}

void add_answers(std::vector<Measure>& measures, const procedure::ScopeRecord& scope) {
  Sites sum;
  for (std::size_t site = 0; site < kScrewSites; ++site) judge(sum, site, scope);
  const bool is_any_out = sum.there > 0;
  measures.push_back({"sites_right", sum.right / static_cast<double>(kScrewSites) * 100,
                      sum.wrong.empty() ? "All of them." : sum.wrong + "."});
  measures.push_back({"proud_missed", {}, "", is_any_out});
  if (is_any_out) measures.back().value = sum.missed;
  measures.push_back({"proud_invented", {}, ""});
  // Who said nothing invented nothing, and earns nothing by it.
  if (scope.facts.unanswered == 0) measures.back().value = sum.invented;
  measures.push_back(decision(scope));
  const int probed = std::popcount(scope.facts.screw.probed);
  measures.push_back({"screw_probed", static_cast<double>(probed), ""});
  measures.push_back({"answers_unseen", sum.unseen, ""});
}

}  // namespace

procedure::ScoreReport score(const cases::CaseData& data,
                             const procedure::OperationRecord& record) {
  static const procedure::ScopeRecord kNone;
  std::vector<Measure> measures = arthroscopy::conduct_measures(data, declared(), record);
  add_answers(measures, record.scope ? *record.scope : kNone);
  procedure::ScoreReport report;
  procedure::grade(report, declared().rules, measures);
  arthroscopy::tell_scuffs(report, data, record);
  return report;
}

}  // namespace carpus::procedures::arthroscopic_screw_control
