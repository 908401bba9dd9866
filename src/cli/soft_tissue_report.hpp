// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What was made of a case's soft tissue, as a table for people.
#pragma once

#include <string>

#include "cases/arthroscopic_map.hpp"
#include "cases/case_data.hpp"
#include "soft_tissue/soft_tissue.hpp"

namespace carpus::cli {

/// Every ligament's length and thickness beside its range, cartilage, disc, spaces, problems.
[[nodiscard]] std::string soft_tissue_table(const soft_tissue::SoftTissue& tissue,
                                            const cases::CaseData& data);

/// Every portal: its room, and the tendon, artery and nerve beside it; what is missing of the map.
[[nodiscard]] std::string portal_table(const cases::ArthroscopicMap& map,
                                       const cases::CaseData& data);

/// What yields to a probe's 1 N, beside what it is fitted to or published.
[[nodiscard]] std::string yielding_table(const cases::CaseData& data,
                                         const cases::ArthroscopicMap& map);

/// One line: how many of each, volumes, deepest place in bone, problems.
[[nodiscard]] std::string soft_tissue_line(const soft_tissue::SoftTissue& tissue);

}  // namespace carpus::cli
