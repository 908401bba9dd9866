// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What an instructor prepared to be wrong in a case's joints, the same in every examination of it;
// where nobody did, each examination's own seed decides (arthroscopy/make_lesions.hpp). A file of
// its own beside the case (docs/case_format.md). Generated, never seen in a CT.
#pragma once

#include <cstdint>

#include "cases/joint_lesions.hpp"

namespace carpus::cases {

inline constexpr int kPathologySchemaVersion = 1;
/// A number of JSON keeps no larger one exactly.
inline constexpr std::uint64_t kMostPathologySeed = 9007199254740991U;

struct PreparedPathology {
  Grades grades{};         ///< all 0: a healthy wrist
  std::uint64_t seed = 0;  ///< where within its place a patch lies
  bool is_drawn = false;   ///< the grades, too, came from that seed; else somebody chose them
  bool operator==(const PreparedPathology&) const = default;
};

}  // namespace carpus::cases
