// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The bones of a table of the thesis, as far as this machine has them.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "bench/hull/point_sets.hpp"
#include "bench/hull/thesis_tables.hpp"

namespace carpus::bench {

/// A surface for each row, at its vertex count where one has so many. With a folder: the bone's own
/// <surface>.ply, else that of the wrist bone that stands for it, else the parametric wrist's;
/// without one the parametric wrist's. Origins say which.
/// @throws IoError when the folder is missing, or holds none of the table's bones.
[[nodiscard]] std::vector<PointSet> thesis_bones(std::span<const ThesisRow> table,
                                                 const std::filesystem::path& folder);

}  // namespace carpus::bench
