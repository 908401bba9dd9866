// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a list shows of a case folder that nobody has opened yet, whose files are not believed
// either.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace carpus::case_io {

/// As the case calls itself; nothing where case.json cannot be read or has no such name: whoever
/// opens the case says why.
[[nodiscard]] std::optional<std::string> read_pseudonym(const std::filesystem::path& folder);

/// The bytes of preview.png; nothing where there is none, or a link, which may lead to any file of
/// this machine, or more than such a picture has.
[[nodiscard]] std::optional<std::string> read_preview(const std::filesystem::path& folder);

}  // namespace carpus::case_io
