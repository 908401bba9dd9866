// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Tables 4.1 and 4.2 of [yaacoub2008], as printed, to stand beside our own.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "anatomy/bone_id.hpp"

namespace carpus::bench {

/// One row as the thesis prints it; seconds include displaying the model.
struct ThesisRow {
  std::string_view name;
  std::string_view surface;  ///< its own file in a folder of bones, without .ply
  BoneId model;              ///< the wrist bone that stands for it where there is none
  std::size_t vertices = 0;
  std::size_t facets = 0;
  std::size_t hull_vertices = 0;
  std::size_t hull_facets = 0;
  double brute_force = 0;  ///< 0 where the thesis has none
  double gift_wrapping = 0;
  double quickhull = 0;
  double chan = 0;
  double hybrid = 0;
  std::size_t left_by_stage_1 = 0;  ///< vertices that the hybrid wraps; 0 where the text has none
};

/// By how much less time the hybrid takes than another algorithm, as the thesis's text prints it.
struct PrintedGain {
  std::string_view bone;
  std::string_view engine;
  double ThesisRow::*other;
  double percent;
};

/// The same from the table's own seconds.
[[nodiscard]] double gain_of(const ThesisRow& row, double ThesisRow::*other);

/// The gains printed for bones of the table that its own seconds do not give, by more than
/// rounding.
[[nodiscard]] std::vector<PrintedGain> misprinted_gains(std::span<const ThesisRow> table);

[[nodiscard]] std::span<const ThesisRow> thesis_table_4_1();
[[nodiscard]] std::span<const ThesisRow> thesis_table_4_2();

}  // namespace carpus::bench
