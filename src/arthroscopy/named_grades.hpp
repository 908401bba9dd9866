// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Grades by the ids of data/pathology.json, as files, recordings and people name them: they stay
// right where the table has grown.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "arthroscopy/pathology_table.hpp"
#include "cases/prepared_pathology.hpp"
#include "core/result.hpp"

namespace carpus::arthroscopy {

struct NamedGrade {
  std::string finding;
  std::string grade;
  bool operator==(const NamedGrade&) const = default;
};

/// Of what is not well, in the table's order.
[[nodiscard]] std::vector<NamedGrade> named_grades(const cases::Grades& grades,
                                                   const PathologyTable& table);

/// Sets that finding's grade, or says which findings and grades there are. Untrusted names.
[[nodiscard]] Result<bool> set_grade(cases::Grades& grades,
                                     const PathologyTable& table,
                                     std::string_view finding,
                                     std::string_view grade);

/// "Scapholunate ligament: III: step in both joints, a probe passes", each in a line of its own; of
/// a healthy wrist none.
[[nodiscard]] std::vector<std::string> grades_in_words(const cases::Grades& grades,
                                                       const PathologyTable& table);

/// What that seed leaves to chance, settled once.
[[nodiscard]] cases::PreparedPathology drawn_pathology(std::uint64_t seed,
                                                       const PathologyTable& table);

}  // namespace carpus::arthroscopy
