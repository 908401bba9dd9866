// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Any bytes for a case's pathology.json: refused in words that name the file, or grades of the
// table that come back from their text.
#include <cstddef>
#include <cstdint>
#include <string>

#include "arthroscopy/pathology_table.hpp"
#include "case_io/pathology_file.hpp"
#include "refusals.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace carpus;
  fuzz::reads_or_refuses("pathology.json", [&] {
    const cases::PreparedPathology pathology =
        case_io::parse_pathology({reinterpret_cast<const char*>(data), size}, "pathology.json");
    const auto& table = arthroscopy::PathologyTable::generic();
    for (std::size_t f = 0; f < pathology.grades.size(); ++f) {
      const std::size_t grades = f < table.findings.size() ? table.scale_of(f).grades.size() : 1;
      fuzz::require(pathology.grades[f] < grades);
    }
    const std::string text = case_io::pathology_text(pathology);
    fuzz::require(case_io::parse_pathology(text, "pathology.json") == pathology);
  });
  return 0;
}
