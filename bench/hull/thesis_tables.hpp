// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Tables 4.1 and 4.2 of [yaacoub2008], as printed, to stand beside our own.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "anatomy/bone_id.hpp"

namespace carpus::bench {

/// One row as the thesis prints it; seconds include displaying the model.
struct ThesisRow {
  std::string_view name;
  BoneId model;  ///< the wrist bone that stands for it here; for table 4.2 only the counts matter
  std::size_t vertices;
  std::size_t facets;
  std::size_t hull_vertices;
  std::size_t hull_facets;
  double brute_force;  ///< 0 where the thesis has none
  double gift_wrapping;
  double quickhull;
  double chan;
  double hybrid;
};

[[nodiscard]] std::span<const ThesisRow> thesis_table_4_1();
[[nodiscard]] std::span<const ThesisRow> thesis_table_4_2();

}  // namespace carpus::bench
