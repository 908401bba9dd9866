// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The tables of `carpus bench collision`, each as rows.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/collision/bones.hpp"
#include "bench/collision/measure.hpp"

namespace carpus::bench {

/// Yes or no between two bones, warm or cold, in each of pose_cases().
[[nodiscard]] std::vector<CollisionRow> pair_table(const BoneSet& bones,
                                                   bool cold,
                                                   const BenchOptions& options);
/// All pairs of all bones, every bone moved.
[[nodiscard]] std::vector<CollisionRow> tick_table(const BoneSet& bones,
                                                   const BenchOptions& options);
/// Distances and depths with their largest errors.
[[nodiscard]] std::vector<CollisionRow> distance_table(const BoneSet& bones,
                                                       const BenchOptions& options);
/// Table 5.1 and figure 5.3 of [yaacoub2008].
[[nodiscard]] std::vector<CollisionRow> thesis_table(const std::filesystem::path& folder,
                                                     const BenchOptions& options);
[[nodiscard]] std::string thesis_text(const std::vector<CollisionRow>& rows);
/// All instruments against the true surfaces of all bones.
/// @throws InvalidInput for bones without surfaces.
[[nodiscard]] std::vector<CollisionRow> surface_table(const BoneSet& bones,
                                                      const BenchOptions& options);
/// Cost against the number of facets.
[[nodiscard]] std::vector<CollisionRow> growth_table(const BenchOptions& options);
[[nodiscard]] std::string growth_text(const std::vector<CollisionRow>& rows);

}  // namespace carpus::bench
