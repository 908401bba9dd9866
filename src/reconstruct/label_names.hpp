// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The list of --names: which number of a label volume from elsewhere is which bone.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace carpus::reconstruct {

/// Number there -> number here (anatomy/bone_id.hpp); 0 = left out.
using LabelNumbers = std::array<std::uint8_t, 256>;

/// @param name  "radius", "scaphoid_distal"; nothing where no bone is called so
[[nodiscard]] std::optional<std::uint8_t> label_of_bone(const std::string& name);

/// @param text  {"radius": 1, ...}; "background" and "fracture_gap", as phantom's list has them,
/// are
///     left out
/// @throws InvalidInput naming `file`: no such list, a name that is no bone's, a name or a number
///     that is given twice.
[[nodiscard]] LabelNumbers parse_label_names(const std::string& text, const std::string& file);

}  // namespace carpus::reconstruct
