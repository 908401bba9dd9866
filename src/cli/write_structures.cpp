// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/write_structures.hpp"

#include "case_io/case_folder.hpp"
#include "records/atomic_file.hpp"

namespace carpus::cli {

void write_structures(const cases::CaseData& data, const std::filesystem::path& folder) {
  for (const auto& [name, content] : case_io::structure_files(data)) {
    records::write_file_atomically(folder / name, content);
  }
}

}  // namespace carpus::cli
