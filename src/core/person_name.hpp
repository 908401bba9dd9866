// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Names that people type, and that others read in lists: any alphabet, but nothing that makes the
// rest of a line read as something else.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace carpus {

/// Why this cannot be a name, in a sentence that says which character it is; nothing where it can.
/// Refused are control characters, line breaks among them, and those that embed, override or
/// isolate the direction of writing. How long it may be is its reader's to say.
[[nodiscard]] std::optional<std::string> problem_of_name(std::string_view utf8);

}  // namespace carpus
