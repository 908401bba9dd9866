// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The cases that a station can open, of which one is open. Which they are is found when the station
// is started, and new ones come while it runs; a case itself is loaded when it is chosen.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cases/prepared_pathology.hpp"
#include "protocol/bodies.hpp"
#include "server/attempt_owners.hpp"
#include "server/truth_gate.hpp"

namespace carpus::server {

struct ShelvedCase {
  std::string id;     ///< of its folder
  std::string name;   ///< its pseudonym, by which attempts name it
  std::string title;  ///< of its lesson, else what the case calls itself
  std::string history;
  std::string goal;
  std::optional<double> difficulty;
  std::shared_ptr<const std::string> preview;  ///< PNG; null where it has none
  std::filesystem::path folder{};              ///< empty: its scan is not shown
  std::vector<std::string> flagged{};          ///< bones to be checked, whole ones
  std::vector<std::string> of_scan{};          ///< what is to be known of all of its scan
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

  /// Id of the only case with this pseudonym; empty where there is none, or several.
  [[nodiscard]] std::string id_of_named(std::string_view name) const;
};

/// The shelf that all look at while cases are put on it. From any thread.
class SharedShelf {
 public:
  SharedShelf() = default;
  explicit SharedShelf(CaseShelf shelf)
      : shelf_(std::make_shared<const CaseShelf>(std::move(shelf))) {}

  /// As it is now; it does not change any more.
  [[nodiscard]] std::shared_ptr<const CaseShelf> now() const {
    const std::lock_guard lock(mutex_);
    return shelf_;
  }
  /// @param change  is given a copy, which takes the shelf's place
  void change(const std::function<void(CaseShelf&)>& change) {
    const std::lock_guard lock(mutex_);
    auto changed = std::make_shared<CaseShelf>(*shelf_);
    change(*changed);
    shelf_ = std::move(changed);
  }

 private:
  mutable std::mutex mutex_;
  std::shared_ptr<const CaseShelf> shelf_ = std::make_shared<const CaseShelf>();
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
  /// What the case has prepared to be wrong as an examination begins; throws as case_io does.
  /// Empty: as it was when the case was loaded. In the thread aside.
  std::function<std::optional<cases::PreparedPathology>()> prepared{};
};

}  // namespace carpus::server
