// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How deep a JSON text nests, before anybody builds it: copying or comparing a value that nests a
// hundred thousand deep ends the program.
#pragma once

#include <string_view>

namespace carpus {

/// Whether arrays and objects nest deeper than `most`; the text need not be JSON.
[[nodiscard]] bool nests_deeper_than(std::string_view text, int most) noexcept;

}  // namespace carpus
