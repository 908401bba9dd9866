// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The pictures of the assembly guide: which pieces each step adds, and from where it is seen.
#pragma once

#include <filesystem>
#include <span>

#include "hardware/workshop/assembly.hpp"

namespace carpus::hardware {

/// Writes NAME.png for each picture, or for those that are named.
/// @throws IoError where a file cannot be written; InvalidInput for a name that is none.
void draw_guide(const Numbers& numbers,
                const Parts& parts,
                const std::filesystem::path& folder,
                std::span<const char* const> names);

}  // namespace carpus::hardware
