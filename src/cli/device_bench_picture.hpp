// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A touch by each law and drive: force felt against depth, four panels on the same scales.
#pragma once

#include <string>

#include "device_bench/rig.hpp"

namespace carpus::cli {

[[nodiscard]] std::string device_bench_picture(const device_bench::BoardMaker& board);

}  // namespace carpus::cli
