// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Time against number of points, logarithmic on both axes, as SVG: figures 4.7 and 4.8 anew.
#pragma once

#include <string>
#include <vector>

#include "bench/hull/hull_bench.hpp"

namespace carpus::bench {

/// What the horizontal axis counts.
enum class PlotAxis { Points, HullVertices };

/// Against h each engine's time stands at the exact hull's count, also where it finds another.
/// One curve an engine over all rows that ran; a panel for each set where sets have sizes in
/// common. Empty where nothing ran.
[[nodiscard]] std::string plot_svg(const std::string& title,
                                   const std::vector<HullRow>& rows,
                                   PlotAxis axis);

}  // namespace carpus::bench
