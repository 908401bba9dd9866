// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/case_pathology.hpp"

#include "arthroscopy/make_lesions.hpp"
#include "case_io/pathology_file.hpp"
#include "core/error.hpp"
#include "records/atomic_file.hpp"

namespace carpus::cli {

namespace fs = std::filesystem;

void write_pathology(const fs::path& folder,
                     const std::optional<cases::PreparedPathology>& pathology) {
  const fs::path file = folder / case_io::kPathologyFile;
  if (pathology) return records::write_file_atomically(file, case_io::pathology_text(*pathology));
  std::error_code error;
  fs::remove(file, error);
  if (error) {
    throw IoError(file.string() + ": cannot be removed: " + error.message() +
                  "; check the folder's permissions");
  }
}

std::vector<std::string> findings_without_place(const cases::CaseData& data,
                                                const cases::PreparedPathology& pathology) {
  const auto& table = arthroscopy::PathologyTable::generic();
  cases::Grades shown{};
  if (data.arthroscopy != nullptr) {
    shown =
        arthroscopy::make_lesions(data, *data.arthroscopy, table, pathology.grades, pathology.seed)
            .grades;
  }
  std::vector<std::string> labels;
  for (std::size_t f = 0; f < table.findings.size(); ++f) {
    // Another grade than the one that was chosen is one that another finding brought along.
    if (shown[f] == 0 && pathology.grades[f] != 0) labels.push_back(table.findings[f].label);
  }
  return labels;
}

}  // namespace carpus::cli
