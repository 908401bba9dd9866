// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace carpus::bench {

/// Places in the order of the wanted ones, at least `spacing` apart, within [low, high] where there
/// is room, and with the least sum of squared shifts.
[[nodiscard]] std::vector<double> spread_labels(const std::vector<double>& wanted,
                                                double spacing,
                                                double low,
                                                double high);

}  // namespace carpus::bench
