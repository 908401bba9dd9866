// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/parallel_executor.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>
#include <functional>

#include "core/parallel.hpp"

namespace carpus::cli {

void install_tbb_executor() {
  install_parallel_executor([](std::size_t count, std::size_t grain,
                               const std::function<void(std::size_t, std::size_t)>& body) {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, count, grain),
        [&](const tbb::blocked_range<std::size_t>& range) { body(range.begin(), range.end()); });
  });
}

}  // namespace carpus::cli
