// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What was answered against what is there, besides how the joints were looked round in.
#include <cstdint>
#include <string>
#include <utility>

#include "arthroscopy/pathology_table.hpp"
#include "procedure/grading.hpp"
#include "procedures/arthroscopic_examination/declared.hpp"
#include "procedures/arthroscopy/conduct.hpp"
#include "procedures/arthroscopy/hand_measures.hpp"

namespace carpus::procedures::arthroscopic_examination {
namespace {

using carpus::arthroscopy::Finding;
using carpus::arthroscopy::PathologyTable;
using carpus::arthroscopy::Scale;
using procedure::Measure;

constexpr double kNearlyRight = 0.5;  // a grade beside the true one, where grades have an order [E]

/// What was said of each finding, counted.
struct Answers {
  double there = 0;
  double found = 0;
  double graded = 0;
  double invented = 0;
  double unjudged = 0;
  std::string missed;
  std::string misgraded;
  std::string not_there;
  std::string left_out;
};

void add(std::string& list, const std::string& what) { list += (list.empty() ? "" : "; ") + what; }

std::string grade_name(const Scale& scale, std::uint8_t grade) {
  return (scale.name.empty() || grade == 0 ? "" : scale.name + " ") + scale.grades[grade].id;
}

double share_right(const Scale& scale, std::uint8_t said, std::uint8_t truth) {
  if (said == truth) return 1;
  const bool is_beside = said + 1 == truth || truth + 1 == said;
  return scale.is_ordered && is_beside ? kNearlyRight : 0;
}

void judge(Answers& sum,
           const Finding& finding,
           const Scale& scale,
           std::uint8_t said,
           std::uint8_t truth) {
  const bool is_said = said < scale.grades.size();
  if (!is_said) {
    ++sum.unjudged;
    add(sum.left_out, finding.label);
  }
  if (truth == 0) {
    if (is_said && said != 0) {
      ++sum.invented;
      add(sum.not_there, finding.label + " (" + grade_name(scale, said) + ")");
    }
    return;
  }
  ++sum.there;
  if (!is_said || said == 0) {
    add(sum.missed, finding.label + " (" + scale.grades[truth].label + ")");
    return;
  }
  ++sum.found;
  sum.graded += share_right(scale, said, truth);
  if (said != truth) {
    add(sum.misgraded,
        finding.label + ": " + grade_name(scale, said) + " instead of " + grade_name(scale, truth));
  }
}

std::string sentence(const std::string& before, const std::string& list, const std::string& none) {
  return list.empty() ? none : before + list + ".";
}

void add_answers(std::vector<Measure>& measures, const procedure::ScopeRecord& scope) {
  const PathologyTable& table = PathologyTable::generic();
  Answers sum;
  for (std::size_t f = 0; f < table.findings.size(); ++f) {
    judge(sum, table.findings[f], table.scale_of(f), scope.answers[f], scope.truth[f]);
  }
  const bool is_healthy = !(sum.there > 0);
  Measure found{"findings_found", {}, "", !is_healthy};
  Measure graded{"grades_right", {}, "", !is_healthy};
  if (!is_healthy) {
    found.value = sum.found / sum.there * 100;
    found.finding = sentence("Missed: ", sum.missed, "None was missed.");
    // Of all that is there: what was missed is not graded.
    graded.value = sum.graded / sum.there * 100;
    graded.finding = sentence("", sum.misgraded, "");
  }
  // Of a healthy wrist nothing can be missed.
  measures.push_back({"findings_missed_share", is_healthy ? 0.0 : 100 - *found.value, ""});
  measures.push_back(std::move(found));
  measures.push_back(std::move(graded));
  measures.push_back(
      {"findings_invented", sum.invented,
       sentence("Not there: ", sum.not_there, is_healthy ? "The wrist is healthy." : "")});
  measures.push_back(
      {"findings_unjudged", sum.unjudged, sentence("Nothing said of: ", sum.left_out, "")});
  measures.push_back({"lesions_seen_share", {}, "", scope.lesions > 0});
  if (scope.lesions > 0) {
    measures.back().value = static_cast<double>(scope.lesions_seen) / scope.lesions * 100;
  }
}

}  // namespace

procedure::ScoreReport score(const cases::CaseData& data,
                             const procedure::OperationRecord& record) {
  static const procedure::ScopeRecord kNone;
  std::vector<Measure> measures = arthroscopy::conduct_measures(data, declared(), record);
  add_answers(measures, record.scope ? *record.scope : kNone);
  arthroscopy::add_fluid_measures(measures, record);
  procedure::ScoreReport report;
  procedure::grade(report, declared().rules, measures);
  arthroscopy::tell_scuffs(report, data, record);
  return report;
}

}  // namespace carpus::procedures::arthroscopic_examination
