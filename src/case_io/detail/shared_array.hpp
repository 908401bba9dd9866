// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Memory that a child process writes and its parent reads. T holds no pointers.
#pragma once

#include <sys/mman.h>

#include <algorithm>
#include <cstddef>
#include <new>
#include <span>
#include <type_traits>
#include <vector>

namespace carpus::case_io {

template <typename T>
class SharedArray {
 public:
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

  /// Zeros. @throws std::bad_alloc
  explicit SharedArray(std::size_t count) {
    void* const place = ::mmap(nullptr, count * sizeof(T), PROT_READ | PROT_WRITE,
                               MAP_SHARED | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (count == 0 || place == MAP_FAILED) throw std::bad_alloc();
    values_ = {static_cast<T*>(place), count};
  }
  ~SharedArray() { ::munmap(values_.data(), values_.size_bytes()); }
  SharedArray(const SharedArray&) = delete;
  SharedArray& operator=(const SharedArray&) = delete;

  [[nodiscard]] std::span<T> values() noexcept { return values_; }

  /// Copies out and gives each part back to the system at once, so that the two never take twice
  /// the memory of one.
  [[nodiscard]] std::vector<T> take() {
    constexpr std::size_t kPart = std::size_t{1} << 24U;  // a multiple of every page's size
    std::vector<T> copy;
    copy.reserve(values_.size());
    for (std::size_t at = 0; at < values_.size(); at += kPart) {
      const std::span<T> part = values_.subspan(at, std::min(kPart, values_.size() - at));
      copy.insert(copy.end(), part.begin(), part.end());
      ::madvise(part.data(), part.size_bytes(), MADV_REMOVE);
    }
    return copy;
  }

 private:
  std::span<T> values_;
};

}  // namespace carpus::case_io
