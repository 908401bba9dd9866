// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/asked_portals.hpp"

#include <vector>

#include "core/rng.hpp"
#include "procedure/second_portals.hpp"

namespace carpus::simulation {

std::optional<std::array<std::uint8_t, procedure::kPortalsMade>> asked_portals(
    const cases::CaseData& data,
    const procedure::PortalMaking& making,
    std::uint64_t seed) {
  if (data.arthroscopy == nullptr) return std::nullopt;
  const std::vector<cases::Portal>& portals = data.arthroscopy->portals;
  std::optional<std::uint8_t> first;
  for (std::uint8_t p = 0; p < portals.size(); ++p) {
    if (portals[p].id == making.first) first = p;
  }
  const std::vector<std::uint8_t> seconds = procedure::second_portals(data, making);
  if (!first || seconds.empty()) return std::nullopt;
  Rng rng(seed);
  return std::array{*first, seconds[rng.below(seconds.size())]};
}

}  // namespace carpus::simulation
