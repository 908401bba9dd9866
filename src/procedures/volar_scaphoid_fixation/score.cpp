// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedures/scaphoid_fixation/measures.hpp"
#include "procedures/volar_scaphoid_fixation/declared.hpp"

namespace carpus::procedures::volar_scaphoid_fixation {

procedure::ScoreReport score(const cases::CaseData& data,
                             const procedure::OperationRecord& record) {
  return scaphoid_fixation::score(data, record,
                                  {&declared(), scaphoid_fixation::Approach::FromDistal});
}

}  // namespace carpus::procedures::volar_scaphoid_fixation
