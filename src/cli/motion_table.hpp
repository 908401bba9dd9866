// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How the instruments moved in an operation, as a table for those who study motion: a line each
// hand and moment, comma-separated, in the units that its heads name (docs/json.md).
#pragma once

#include <string>

#include "core/units.hpp"
#include "simulation/snapshot.hpp"

namespace carpus::cli {

class MotionTable {
 public:
  /// @param every  ticks between two lines of a hand; at least 1.
  explicit MotionTable(Tick every);

  /// Takes down what each hand holds, where the moment is one of the table's.
  void see(const simulation::Snapshot& now);

  /// So far, with its heads.
  [[nodiscard]] const std::string& text() const noexcept { return text_; }

 private:
  Tick every_;
  std::string text_;
};

}  // namespace carpus::cli
