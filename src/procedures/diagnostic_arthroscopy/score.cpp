// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedure/grading.hpp"
#include "procedures/arthroscopy/conduct.hpp"
#include "procedures/arthroscopy/hand_measures.hpp"
#include "procedures/diagnostic_arthroscopy/declared.hpp"

namespace carpus::procedures::diagnostic_arthroscopy {

procedure::ScoreReport score(const cases::CaseData& data,
                             const procedure::OperationRecord& record) {
  procedure::ScoreReport report;
  procedure::grade(report, declared().rules,
                   arthroscopy::conduct_measures(data, declared(), record));
  arthroscopy::tell_scuffs(report, data, record);
  return report;
}

}  // namespace carpus::procedures::diagnostic_arthroscopy
