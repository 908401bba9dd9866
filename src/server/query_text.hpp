// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace carpus::server {

/// The text that a target's query gives for a name, decoded once: empty where it gives none,
/// nothing where it is malformed or given twice.
[[nodiscard]] std::optional<std::string> text_in_query(std::string_view target,
                                                       std::string_view name);

}  // namespace carpus::server
