// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/collision/measure.hpp"

namespace carpus::bench {

/// Engines down, cases across; mean, median and p99 in microseconds, marked where the answers
/// differ; below, our fastest engine that agrees against the fastest peer by each of these, and
/// lp_growth against our own GJK by mean.
[[nodiscard]] std::string text_of(const std::vector<CollisionRow>& rows);

/// @throws IoError where the file cannot be written.
void write_json(const std::filesystem::path& file,
                const std::string& table,
                const std::string& bones,
                const std::vector<CollisionRow>& rows);

/// What the horizontal axis of a plot counts.
enum class CollisionAxis { Cases, Facets, Vertices };

/// Mean and p99 of each engine as dots, one panel a case; against facets or vertices means as
/// curves. Against vertices (figure 5.3) only the cold rows are drawn. Empty where nothing ran.
[[nodiscard]] std::string collision_plot_svg(const std::string& title,
                                             const std::vector<CollisionRow>& rows,
                                             CollisionAxis axis);

}  // namespace carpus::bench
