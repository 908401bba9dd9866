// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The peers one by one; each source is compiled only where its library is installed.
#pragma once

#include "bench/hull/engine.hpp"

namespace carpus::bench {

[[nodiscard]] HullEngine qhull_engine();
[[nodiscard]] HullEngine cgal_engine();
[[nodiscard]] HullEngine bullet_engine();

}  // namespace carpus::bench
