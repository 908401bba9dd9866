// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The newest value from one writer for one reader, without locks or waiting on either side: how
// snapshots leave the 1 kHz thread.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <type_traits>

namespace carpus {

/// Triple buffer: the writer fills its own slot and swaps it with the middle one; the reader swaps
/// the middle one with its own when it is fresh. Older values are lost on purpose.
template <typename T>
class LatestValue {
  static_assert(std::is_trivially_copyable_v<T>, "values are copied on the real-time path");

 public:
  /// Writer only.
  void publish(const T& value) noexcept {
    slots_[writing_] = value;
    const std::uint8_t previous =
        middle_.exchange(static_cast<std::uint8_t>(writing_ | kFresh), std::memory_order_acq_rel);
    writing_ = previous & kIndex;
  }

  /// Reader only. True when `value` received something newer than at the last call.
  [[nodiscard]] bool take(T& value) noexcept {
    if ((middle_.load(std::memory_order_relaxed) & kFresh) == 0) return false;
    reading_ = middle_.exchange(reading_, std::memory_order_acq_rel) & kIndex;
    value = slots_[reading_];
    return true;
  }

 private:
  static constexpr std::uint8_t kIndex = 3;
  static constexpr std::uint8_t kFresh = 4;
  std::array<T, 3> slots_{};
  std::uint8_t writing_ = 0;
  std::uint8_t reading_ = 1;
  std::atomic<std::uint8_t> middle_{2};
};

}  // namespace carpus
