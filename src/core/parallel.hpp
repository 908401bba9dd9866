// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Parallel loops for pure modules: serial unless the program installs an executor at start
// (carpus::cli installs oneTBB), because these modules know no threads.
#pragma once

#include <cstddef>
#include <functional>
#include <initializer_list>

namespace carpus {

/// Runs body(begin, end) over disjoint ranges that cover [0, count), each at least `grain` long but
/// for the last; returns when all are done. Ranges may run at the same time and in any order, so a
/// body must write only what belongs to its range: the result then does not depend on threads.
/// An exception in a body is rethrown here.
void parallel_for(std::size_t count,
                  std::size_t grain,
                  const std::function<void(std::size_t begin, std::size_t end)>& body);

/// Runs pieces of work that do not touch what another writes, as parallel_for runs a loop.
void side_by_side(std::initializer_list<std::function<void()>> works);

/// What parallel_for hands the loop to.
using ParallelExecutor =
    std::function<void(std::size_t count,
                       std::size_t grain,
                       const std::function<void(std::size_t, std::size_t)>& body)>;

/// Replaces the executor; an empty one restores the serial loop. Call before any loop runs.
void install_parallel_executor(ParallelExecutor executor);

}  // namespace carpus
