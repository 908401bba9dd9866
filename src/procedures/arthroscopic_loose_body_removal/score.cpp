// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What came out, how it was taken hold of, and whether it was looked for again.
#include <bit>
#include <string>
#include <vector>

#include "procedure/grading.hpp"
#include "procedures/arthroscopic_loose_body_removal/declared.hpp"
#include "procedures/arthroscopy/conduct.hpp"
#include "procedures/arthroscopy/hand_measures.hpp"

namespace carpus::procedures::arthroscopic_loose_body_removal {
namespace {

using procedure::Measure;

/// Who never closed the jaws had no fault with them either: no measure, no points.
Measure faults(const char* id, std::uint32_t count, const procedure::LooseFacts& done) {
  Measure measure{id, {}, ""};
  if (done.out > 0) measure.value = count;
  return measure;
}

std::vector<Measure> removal_measures(const procedure::LooseFacts& done) {
  std::vector<Measure> measures;
  Measure share{"brought_out_share", {}, ""};
  if (done.there > 0) {
    share.value = 100.0 * done.out / done.there;
    share.finding = std::to_string(done.out) + " of " + std::to_string(done.there) + ".";
  }
  measures.push_back(std::move(share));
  measures.push_back(faults("lost_from_jaws", done.slips, done));
  measures.push_back(faults("tissue_bitten", done.bites, done));
  measures.push_back(faults("closed_unseen", done.unseen_closings, done));
  Measure again{"looked_again", {}, ""};
  if (done.out > 0) again.value = std::popcount(done.seen_since);
  measures.push_back(std::move(again));
  return measures;
}

}  // namespace

procedure::ScoreReport score(const cases::CaseData& data,
                             const procedure::OperationRecord& record) {
  std::vector<Measure> measures = arthroscopy::conduct_measures(data, declared(), record);
  const procedure::LooseFacts done =
      record.scope ? record.scope->facts.loose : procedure::LooseFacts{};
  for (Measure& each : removal_measures(done)) measures.push_back(std::move(each));
  procedure::ScoreReport report;
  procedure::grade(report, declared().rules, measures);
  arthroscopy::tell_scuffs(report, data, record);
  return report;
}

}  // namespace carpus::procedures::arthroscopic_loose_body_removal
