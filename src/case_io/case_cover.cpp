// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/case_cover.hpp"

#include <cstdint>

#include "case_io/detail/case_json.hpp"
#include "case_io/detail/regular_file.hpp"
#include "case_io/lesson_file.hpp"
#include "core/error.hpp"

namespace carpus::case_io {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kLargestPreview = std::uint64_t{1} << 20U;

}  // namespace

std::optional<std::string> read_pseudonym(const fs::path& folder) {
  const fs::path file = folder / "case.json";
  try {
    return parse_pseudonym(read_whole_file(file, kLargestCaseJson), file);
  } catch (const Error&) {
    return std::nullopt;
  }
}

std::optional<std::string> read_preview(const fs::path& folder) {
  try {
    return read_whole_file(folder / kPreviewFile, kLargestPreview, Links::Refuse);
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace carpus::case_io
