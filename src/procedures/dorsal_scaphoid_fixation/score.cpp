// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "procedure/score_items.hpp"
#include "procedures/dorsal_scaphoid_fixation/declared.hpp"
#include "procedures/scaphoid_fixation/score_items.hpp"

namespace carpus::procedures::dorsal_scaphoid_fixation {

procedure::ScoreReport score(const cases::CaseData& data,
                             const procedure::OperationRecord& record) {
  using namespace scaphoid_fixation;  // NOLINT(google-build-using-namespace): its items by name
  const Rules rules{&declared(), Approach::FromProximal, kDriveStep, kInsertStep};
  Facts facts = facts_of(data, record, rules);
  procedure::ScoreReport report = report_of(facts);
  report.items = {
      angle_item(facts, 15),        waist_item(facts, 12),          proximal_offset_item(facts, 8),
      distal_offset_item(facts, 8), proximal_cover_item(facts, 8),  distal_cover_item(facts, 8),
      penetration_item(facts, 12),  length_item(facts, report, 10), passes_item(facts, 5),
      views_item(facts, 5),         wrong_bones_item(facts, 4),
  };
  for (procedure::ScoreItem& item : thrift_items(facts, 1, 1, 2, 1)) {
    report.items.push_back(std::move(item));
  }
  procedure::sum_up(report);
  return report;
}

}  // namespace carpus::procedures::dorsal_scaphoid_fixation
