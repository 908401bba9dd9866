// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/find_structure.hpp"

#include <algorithm>

#include "anatomy/structure_table.hpp"

namespace carpus::cases {

const Structure* find_structure(const std::vector<Structure>& structures,
                                std::string_view id) noexcept {
  const auto found = std::find_if(structures.begin(), structures.end(),
                                  [id](const Structure& each) { return each.id == id; });
  return found == structures.end() ? nullptr : &*found;
}

std::string lacking(const std::vector<Structure>& structures, const std::vector<std::string>& ids) {
  std::string names;
  for (const std::string& id : ids) {
    if (find_structure(structures, id) != nullptr) continue;
    const anatomy::TabledStructure* tabled = anatomy::StructureTable::generic().find(id);
    names += (names.empty() ? "" : ", ") + (tabled == nullptr ? id : tabled->name);
  }
  return names;
}

std::string lacking(const std::vector<Structure>& structures) {
  std::vector<std::string> ids;
  for (const auto& tabled : anatomy::StructureTable::generic().structures) {
    ids.push_back(tabled.id);
  }
  return lacking(structures, ids);
}

}  // namespace carpus::cases
