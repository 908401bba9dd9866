// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/hull/thesis_bones.hpp"

#include <algorithm>

#include "bench/hull/bone_points.hpp"
#include "core/error.hpp"

namespace carpus::bench {
namespace {

namespace fs = std::filesystem;

/// The row's file, or that of its stand-in; empty where the folder has neither.
fs::path file_of(const ThesisRow& row, const fs::path& folder) {
  if (folder.empty()) return {};
  for (const std::string_view name : {row.surface, name_of(row.model)}) {
    fs::path file = folder / (std::string(name) + ".ply");
    if (fs::exists(file)) return file;
  }
  return {};
}

void check_folder(std::span<const ThesisRow> table, const fs::path& folder) {
  check_bones_folder(folder);
  if (std::any_of(table.begin(), table.end(),
                  [&](const ThesisRow& row) { return !file_of(row, folder).empty(); })) {
    return;
  }
  std::string names;
  for (const ThesisRow& row : table) names += " " + std::string(row.surface) + ".ply";
  throw IoError(folder.string() + ": holds none of the table's bones:" + names +
                "; leave --bones out for the parametric wrist (simulated)");
}

}  // namespace

std::vector<PointSet> thesis_bones(std::span<const ThesisRow> table, const fs::path& folder) {
  if (!folder.empty()) check_folder(table, folder);
  std::vector<PointSet> sets;
  for (const ThesisRow& row : table) {
    const fs::path file = file_of(row, folder);
    PointSet set =
        file.empty() ? model_bone(row.model, row.vertices) : thinned_bone(file, row.vertices);
    const bool is_own = name_of(row.model) == row.surface || file.stem() == fs::path(row.surface);
    set.origin.is_stand_in = !is_own || file.empty() != folder.empty();
    set.origin.thesis_points = row.vertices;
    set.name = row.name;
    sets.push_back(std::move(set));
  }
  return sets;
}

}  // namespace carpus::bench
