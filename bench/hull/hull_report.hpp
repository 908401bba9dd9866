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

}  // namespace carpus::bench
