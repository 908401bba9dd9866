// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Brings threads to the parallel loops of the pure modules.
#pragma once

namespace carpus::cli {

/// Hands core/parallel.hpp's loops to oneTBB. Call once, before any loop runs.
void install_tbb_executor();

}  // namespace carpus::cli
