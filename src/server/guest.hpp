// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Who asks: what the link that they came by lets them do.
#pragma once

#include <cstdint>
#include <string>

namespace carpus::server {

enum class Role : std::uint8_t {
  Trainee,     ///< operates, and sees the attempts that were made from the same browser
  Instructor,  ///< also sees all attempts and ends another's exercise
};

struct Guest {
  Role role = Role::Trainee;
  /// The browser's own random word, by which what it did is told from what others did. Empty where
  /// the station is open to all.
  std::string browser;
};

}  // namespace carpus::server
