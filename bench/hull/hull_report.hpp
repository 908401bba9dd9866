// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Hull rows as text.
#pragma once

#include <string>
#include <vector>

#include "bench/hull/hull_bench.hpp"

namespace carpus::bench {

/// One line a set: seconds of each engine, how many times faster `fast` is than the best peer, and
/// what must be known of it (origin.hpp).
[[nodiscard]] std::string text_of(const std::vector<HullRow>& rows);

/// How time grows, by least squares of the logarithms: with n for each distribution and engine that
/// ran on three sizes or more, with h for each engine and n over three distributions or more.
[[nodiscard]] std::string growth_of(const std::vector<HullRow>& rows);

/// What brute force would take for `whole` points, from the rows of fewer that it ran on.
[[nodiscard]] std::string brute_force_growth_of(const std::vector<HullRow>& rows,
                                                std::size_t whole);

}  // namespace carpus::bench
