// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Which cases a station offers, from what was said on the command line.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "server/case_shelf.hpp"

namespace carpus::cli {

struct FoundCases {
  server::CaseShelf shelf;  ///< easiest first; open is the easiest of the first place
  std::map<std::string, std::filesystem::path> folders;  ///< by id
};

/// More a page does not show.
inline constexpr std::size_t kMostCases = 200;

/// What a list shows of the case in this folder.
[[nodiscard]] server::ShelvedCase shelved_case(const std::filesystem::path& folder);

/// Each of `places` is a case folder or a folder of them. Reads lessons and pictures, not cases.
/// @throws IoError  for a place without a case;
/// @throws InvalidInput  for two of the same name, more than a page shows, or a lesson that is
///     wrong.
[[nodiscard]] FoundCases find_cases(const std::vector<std::string>& places);

}  // namespace carpus::cli
