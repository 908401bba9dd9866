// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Seconds against a count, logarithmic on both axes: one curve an engine, with its name at its
// right end; panels side by side on the same scales.
#pragma once

#include <string>
#include <vector>

namespace carpus::bench {

struct CurvePoint {
  double count = 0;
  double seconds = 0;
  bool agrees = true;
};

struct Curve {
  std::string name;
  bool is_peer = false;
  std::vector<CurvePoint> points;  ///< in any order
};

struct CurvePanel {
  std::string title;
  std::vector<Curve> curves;
};

/// An engine has its pen (engine_pens.hpp). `notes` stand below, a line each. Empty where
/// nothing was run.
[[nodiscard]] std::string curve_chart_svg(const std::string& title,
                                          const std::string& counted,
                                          const std::string& measured,
                                          const std::vector<CurvePanel>& panels,
                                          const std::vector<std::string>& notes = {});

}  // namespace carpus::bench
