// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Engines down, seconds across: one panel a case, side by side, on one logarithmic scale. The dot
// is a mean or a median, the tick that a thin line joins to it p99.
#pragma once

#include <string>
#include <vector>

namespace carpus::bench {

struct Dot {
  std::string row;
  bool is_peer = false;
  double seconds = 0;  ///< 0: not run
  double p99 = 0;      ///< 0: not drawn
  bool agrees = true;
};

struct DotPanel {
  std::string title;
  std::vector<Dot> dots;
};

/// Panels that share their rows and their scale. A row's place is its mean of logarithms, each
/// against the fastest of its panel, so that a panel in which it is missing does not place it.
struct DotBlock {
  std::string title;
  std::vector<DotPanel> panels;
};

/// `figure` names what the dots are: "mean"; `notes` stand below. Empty where nothing was run.
[[nodiscard]] std::string dot_chart_svg(const std::string& title,
                                        const std::string& figure,
                                        const std::vector<DotBlock>& blocks,
                                        const std::vector<std::string>& notes = {});

}  // namespace carpus::bench
