// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Runs one engine in a process of its own, bounded in memory and time: a peer that crashes, hangs
// or eats the machine costs its own row and nothing else.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <type_traits>

namespace carpus::bench {

struct Caps {
  std::size_t memory_bytes = std::size_t{8} << 30U;
  unsigned seconds = 60;
};

namespace detail {
/// Child: writes `size` bytes that `work` leaves at `result`; parent: true when they arrived whole.
bool run_in_child(const Caps& caps,
                  const std::function<void(void*)>& work,
                  void* result,
                  std::size_t size);
}  // namespace detail

/// What `work` returns, or nothing when it crashed, ran out of memory or took too long.
template <typename T>
std::optional<T> run_capped(const Caps& caps, const std::function<T()>& work) {
  static_assert(std::is_trivially_copyable_v<T>, "the result crosses a pipe by its bytes");
  T result{};
  const bool arrived = detail::run_in_child(
      caps, [&](void* out) { *static_cast<T*>(out) = work(); }, &result, sizeof(T));
  return arrived ? std::optional<T>(result) : std::nullopt;
}

}  // namespace carpus::bench
