// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What was done with a punch that bites tissue off in a joint. What came off by it is counted with
// all that was taken away (procedure/shaving.hpp).
#pragma once

#include <cstdint>

namespace carpus::procedure {

/// A bite is one closing of the jaws in a joint; it is of one kind alone.
struct PunchFacts {
  std::uint32_t bites = 0;
  std::uint32_t unseen = 0;     ///< ... while the scope did not see the jaws, whatever they took
  std::uint32_t empty = 0;      ///< ... on nothing
  std::uint32_t cartilage = 0;  ///< ... on cartilage, which is scuffed there
  std::uint32_t lining = 0;     ///< ... on capsule, ligament or disc that no bite takes off
  bool operator==(const PunchFacts&) const = default;
};

}  // namespace carpus::procedure
