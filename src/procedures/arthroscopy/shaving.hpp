// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What operations that take tissue away share: how they begin, and the figures of what was done
// (docs/scoring.md defines each).
#pragma once

#include <string_view>
#include <vector>

#include "procedures/arthroscopy/conduct.hpp"

namespace carpus::procedures::arthroscopy {

/// As opening(). @throws InvalidInput  also without the places or the disc that are shaved.
[[nodiscard]] procedure::Opening open_to_shave(const cases::CaseData& data,
                                               const procedure::Shaving& shaving,
                                               std::string_view name);

/// Half of what was to go came off: who hardly worked had hardly a chance of a fault, and care is
/// praised from then on.
[[nodiscard]] bool has_worked(const procedure::ShavingFacts& done) noexcept;

/// `ill_removed_share`, `sound_removed_share`, `rim_removed`, `ran_unseen_share`,
/// `ran_on_cartilage_s`, `ran_on_lining_s`, `ran_against_scope_s`, `ran_in_the_way_s`,
/// `looked_again`. Until it has worked, no measure but the first: who does not work has no
/// faults.
[[nodiscard]] std::vector<procedure::Measure> shaving_measures(const procedure::ShavingFacts& done);

/// Graded by the procedure's rules: these, those of a punch and conduct_measures.
[[nodiscard]] procedure::ScoreReport score_shaving(const cases::CaseData& data,
                                                   const procedure::Procedure& procedure,
                                                   const procedure::OperationRecord& record);

}  // namespace carpus::procedures::arthroscopy
