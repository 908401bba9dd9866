// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "core/parallel.hpp"

#include <algorithm>
#include <utility>

namespace carpus {
namespace {

ParallelExecutor& installed_executor() {
  static ParallelExecutor executor;
  return executor;
}

}  // namespace

void parallel_for(std::size_t count,
                  std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body) {
  if (count == 0) return;
  grain = std::max<std::size_t>(grain, 1);
  if (const ParallelExecutor& executor = installed_executor(); executor && count > grain) {
    executor(count, grain, body);
    return;
  }
  body(0, count);
}

void side_by_side(std::initializer_list<std::function<void()>> works) {
  parallel_for(works.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) works.begin()[i]();
  });
}

void install_parallel_executor(ParallelExecutor executor) {
  installed_executor() = std::move(executor);
}

}  // namespace carpus
