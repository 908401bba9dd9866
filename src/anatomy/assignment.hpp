// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Who gets what at the least total cost.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace carpus::anatomy {

/// For each row of the row-major rows x columns matrix `costs` (rows <= columns, finite), the
/// column it gets, no column twice, the total cost least. O(rows^2 columns). Source:
/// [kuhn1955hungarian] in the shortest-augmenting-path form of [jonker1987shortest].
[[nodiscard]] std::vector<std::size_t> assign_at_least_cost(std::span<const double> costs,
                                                            std::size_t rows,
                                                            std::size_t columns);

}  // namespace carpus::anatomy
