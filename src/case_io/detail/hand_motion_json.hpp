// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// hand_motion.json: a case's table of hand motion.
#pragma once

#include <filesystem>
#include <string>

#include "cases/hand_motion.hpp"

namespace carpus::case_io {

/// The text of hand_motion.json; reading it back gives the same bits.
[[nodiscard]] std::string hand_motion_text(const cases::HandMotion& motion);

/// @throws SchemaError, IoError; messages name `file`. What is returned is safe to read in a step:
///     axes rise, nodes fill the table, every number is finite, no quaternion is far from unit, and
///     the motion is one that a hand could have (cases/plausible_hand_motion.hpp).
[[nodiscard]] cases::HandMotion parse_hand_motion(const std::string& text,
                                                  const std::filesystem::path& file);

}  // namespace carpus::case_io
