// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What was published of sectioned wrists beside what the bench finds.
#pragma once

#include <vector>

#include "soft_tissue/sectioning.hpp"
#include "soft_tissue/sectioning_table.hpp"

namespace carpus::soft_tissue {

struct StatementCheck {
  const PublishedStatement* statement = nullptr;
  double ours = 0;           ///< in the unit of the statement's kind
  bool is_measured = false;  ///< false where a rest that it needs was not found
  bool is_reached = false;   ///< measured, and within the statement's limits
};

/// @param result  made with the same table, to which the answer points.
[[nodiscard]] std::vector<StatementCheck> compare_with_published(const SectioningResult& result,
                                                                 const SectioningTable& table);

}  // namespace carpus::soft_tissue
