// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// case.json: everything of a case that is not a volume or a surface.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "cases/case_data.hpp"

namespace carpus::case_io {

inline constexpr std::uint64_t kLargestCaseJson = std::uint64_t{64} << 20U;

/// The text of case.json, numbers in full precision.
[[nodiscard]] std::string case_json_text(const cases::CaseData& data);

/// What case.json says: a case whose volumes and surfaces are still empty, and the grids they must
/// have, by file name within the folder.
struct CaseHeader {
  cases::CaseData data;
  std::map<std::string, GridGeometry> grids;
  bool has_structures = false;  ///< named here, so that their file's absence is noticed
};

/// @throws SchemaError, IoError; messages name `file`.
[[nodiscard]] CaseHeader parse_case_json(const std::string& text,
                                         const std::filesystem::path& file);

/// As the case calls itself, whatever else stands there.
/// @throws IoError naming `file`
[[nodiscard]] std::string parse_pseudonym(const std::string& text,
                                          const std::filesystem::path& file);

/// Name of a bone's distance field in the folder, e.g. "fields/lunate.nrrd".
[[nodiscard]] std::string field_file(const cases::Bone& bone);

}  // namespace carpus::case_io
