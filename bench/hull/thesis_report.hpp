// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Our rows beside those of the thesis.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/hull/hull_bench.hpp"
#include "bench/hull/thesis_tables.hpp"

namespace carpus::bench {

/// The rows of one bone of the thesis; null where an engine did not run.
struct ThesisBeside {
  const ThesisRow* thesis = nullptr;
  const HullRow* gift_wrapping = nullptr;
  const HullRow* quickhull = nullptr;
  const HullRow* chan = nullptr;
  const HullRow* hybrid = nullptr;
};

/// The table's bones that were measured, in its order. Points into both.
[[nodiscard]] std::vector<ThesisBeside> beside_thesis(std::span<const ThesisRow> table,
                                                      const std::vector<HullRow>& rows);

/// The hybrid's seconds over another's; nothing where either did not run.
[[nodiscard]] std::optional<double> ratio_of(const HullRow* hybrid, const HullRow* other);

/// The thesis's seconds of an engine; nothing where it has none.
[[nodiscard]] std::optional<double> thesis_seconds(const ThesisRow& row, const std::string& engine);

/// Sizes, seconds and ratios here and in the thesis, its misprints, and why they differ.
[[nodiscard]] std::string thesis_text(std::span<const ThesisRow> table,
                                      const std::vector<HullRow>& rows);

}  // namespace carpus::bench
