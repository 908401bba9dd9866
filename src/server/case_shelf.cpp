// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/case_shelf.hpp"

namespace carpus::server {

std::string CaseShelf::id_of_named(std::string_view name) const {
  const ShelvedCase* found = nullptr;
  for (const ShelvedCase& each : cases) {
    if (each.name != name) continue;
    if (found != nullptr) return {};
    found = &each;
  }
  return found == nullptr ? std::string{} : found->id;
}

protocol::CaseList message_of(const CaseShelf& shelf) {
  protocol::CaseList list;
  list.open = shelf.open;
  for (const ShelvedCase& each : shelf.cases) {
    list.cases.push_back({each.id, each.title, each.history, each.goal, each.difficulty,
                          each.flagged, each.of_scan, each.preview != nullptr});
  }
  return list;
}

}  // namespace carpus::server
