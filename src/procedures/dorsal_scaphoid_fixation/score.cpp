// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedures/dorsal_scaphoid_fixation/declared.hpp"
#include "procedures/scaphoid_fixation/measures.hpp"

namespace carpus::procedures::dorsal_scaphoid_fixation {

procedure::ScoreReport score(const cases::CaseData& data,
                             const procedure::OperationRecord& record) {
  return scaphoid_fixation::score(data, record,
                                  {&declared(), scaphoid_fixation::Approach::FromProximal});
}

}  // namespace carpus::procedures::dorsal_scaphoid_fixation
