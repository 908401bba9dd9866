// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Memory in large pages, for long arrays that are visited at random: a processor remembers where
// few pages lie, and looks up each of the others.
#pragma once

#include <cstddef>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace carpus {

/// Of a standard container. Where the system has no such pages it gives ordinary ones.
template <typename T>
struct LargePageAllocator {
  using value_type = T;

  LargePageAllocator() = default;
  template <typename U>
  LargePageAllocator(const LargePageAllocator<U>&) {}

  [[nodiscard]] T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    if (!is_long(count)) return static_cast<T*>(::operator new(bytes));
    void* const memory = ::operator new(bytes, std::align_val_t{kPage});
#ifdef __linux__
    ::madvise(memory, bytes - bytes % kPage,
              MADV_HUGEPAGE);  // a wish: what comes of it, is as good
#endif
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t count) noexcept {
    if (is_long(count)) {
      ::operator delete(memory, std::align_val_t{kPage});
    } else {
      ::operator delete(memory);
    }
  }
  /// What is made without a value stays as the memory is.
  template <typename U>
  void construct(U* at) noexcept(noexcept(U())) {
    ::new (static_cast<void*>(at)) U;
  }
  template <typename U, typename... Arguments>
  void construct(U* at, Arguments&&... arguments) {
    ::new (static_cast<void*>(at)) U(static_cast<Arguments&&>(arguments)...);
  }
  bool operator==(const LargePageAllocator&) const = default;

 private:
  static constexpr std::size_t kPage = std::size_t{2} << 20U;
  static bool is_long(std::size_t count) { return count * sizeof(T) >= 2 * kPage; }
};

}  // namespace carpus
