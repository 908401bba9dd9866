// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Bodies that lie loose in a joint and are to be taken out with a grasper: how many, how large and
// where a procedure lets them lie; what was done with them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace carpus::procedure {

/// Most that float in one wrist.
inline constexpr std::size_t kMaxLooseBodies = 4;

/// How many and how large is drawn by the exercise's seed.
struct LooseRemoval {
  std::array<std::uint8_t, 2> bodies{};  ///< least and most
  std::array<double, 2> radius_mm{};     ///< least and most
  std::vector<std::uint8_t> places;      ///< of the tour, by one of which each lies at first

  [[nodiscard]] bool operator==(const LooseRemoval&) const = default;
};

struct LooseFacts {
  std::uint8_t there = 0;             ///< at first
  std::uint8_t seen = 0;              ///< of them, for a second
  std::uint8_t out = 0;               ///< brought out through the skin
  std::uint32_t closings = 0;         ///< of the jaws in a joint
  std::uint32_t unseen_closings = 0;  ///< ... while the scope did not see them
  std::uint32_t catches = 0;
  std::uint32_t bites = 0;       ///< ... on what lines the joint
  std::uint32_t slips = 0;       ///< a body sprang from the jaws, or was stripped off in the way
  std::uint32_t seen_since = 0;  ///< places of the tour, by number, since the last came out
  bool operator==(const LooseFacts&) const = default;
};

}  // namespace carpus::procedure
