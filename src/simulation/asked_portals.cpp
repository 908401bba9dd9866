// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/asked_portals.hpp"

#include <vector>

#include "core/rng.hpp"

namespace carpus::simulation {

std::optional<std::array<std::uint8_t, procedure::kPortalsMade>> asked_portals(
    const cases::ArthroscopicMap& map,
    const procedure::PortalMaking& making,
    std::uint64_t seed) {
  std::optional<std::uint8_t> first;
  std::vector<std::uint8_t> seconds;
  for (std::uint8_t p = 0; p < map.portals.size(); ++p) {
    if (map.portals[p].id == making.first) first = p;
    for (const std::string& id : making.second) {
      if (map.portals[p].id == id) seconds.push_back(p);
    }
  }
  if (!first || seconds.empty()) return std::nullopt;
  Rng rng(seed);
  return std::array{*first, seconds[rng.below(seconds.size())]};
}

}  // namespace carpus::simulation
