// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The cases that a station can open, of which one is open. Which they are is found once, when the
// station is started; a case itself is loaded when it is chosen.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/bodies.hpp"
#include "server/attempt_owners.hpp"
#include "server/truth_gate.hpp"

namespace carpus::server {

struct ShelvedCase {
  std::string id;     ///< of its folder
  std::string title;  ///< of its lesson, else what the case calls itself
  std::string history;
  std::string goal;
  std::optional<double> difficulty;
  std::shared_ptr<const std::string> preview;  ///< PNG; null where it has none
  std::filesystem::path folder{};              ///< empty: its scan is not shown
  std::vector<std::string> flagged{};          ///< bones to be checked, whole ones
};

struct CaseShelf {
  std::vector<ShelvedCase> cases;
  std::string open;  ///< id of the one that is served

  [[nodiscard]] const ShelvedCase* find(std::string_view id) const noexcept {
    for (const ShelvedCase& each : cases) {
      if (each.id == id) return &each;
    }
    return nullptr;
  }
};

[[nodiscard]] protocol::CaseList message_of(const CaseShelf& shelf);

/// What a station does when a page chooses another case. @return whether there is such a case, and
/// the station ends to make room for it.
using ChooseCase = std::function<bool(const std::string& id)>;

/// What a station has in common with those of other cases, before and after it.
struct OverCases {
  ChooseCase choose;  ///< called in the network's thread; empty: this case is the only one
  std::shared_ptr<AttemptOwners> owners = std::make_shared<AttemptOwners>();
  /// The same of answers of the view quiz, by their numbers.
  std::shared_ptr<AttemptOwners> quiz_owners = std::make_shared<AttemptOwners>();
  /// Closed while an assessed operation runs.
  std::shared_ptr<TruthGate> truth = std::make_shared<TruthGate>();
};

}  // namespace carpus::server
