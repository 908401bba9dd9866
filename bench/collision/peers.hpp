// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The peers one by one; each source is compiled only where its library is installed.
#pragma once

#include <vector>

#include "bench/collision/engine.hpp"

namespace carpus::bench {

[[nodiscard]] std::vector<PairEngine> fcl_engines();
[[nodiscard]] std::vector<PairEngine> libccd_engines();
[[nodiscard]] std::vector<PairEngine> bullet_engines();
[[nodiscard]] PairEngine glpk_engine();
[[nodiscard]] PairEngine clp_engine();

}  // namespace carpus::bench
