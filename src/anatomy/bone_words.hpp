// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What people call the bones; files and messages use the names of bone_id.hpp.
#pragma once

#include <string_view>

#include "anatomy/bone_id.hpp"

namespace carpus {

/// "capitate", "first metacarpal", "proximal part of the scaphoid".
[[nodiscard]] std::string_view words_of(BoneId bone, BonePart part = BonePart::Whole) noexcept;

}  // namespace carpus
