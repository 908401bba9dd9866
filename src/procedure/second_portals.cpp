// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedure/second_portals.hpp"

#include <algorithm>
#include <string>

#include "cases/arthroscopic_map.hpp"
#include "cases/find_structure.hpp"

namespace carpus::procedure {

std::vector<std::uint8_t> second_portals(const cases::CaseData& data, const PortalMaking& making) {
  std::vector<std::uint8_t> found;
  if (data.arthroscopy == nullptr) return found;
  const std::vector<cases::Portal>& portals = data.arthroscopy->portals;
  for (std::uint8_t p = 0; p < portals.size(); ++p) {
    const std::string& id = portals[p].id;
    if (std::find(making.second.begin(), making.second.end(), id) == making.second.end()) continue;
    const PortalLandmark* landmark = landmark_of(making, id);
    if (making.needs_structures &&
        (landmark == nullptr || !cases::lacking(data.structures, landmark->endangers).empty())) {
      continue;
    }
    found.push_back(p);
  }
  return found;
}

}  // namespace carpus::procedure
