// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "devices/loop_timing.hpp"

#include <algorithm>

namespace carpus::devices {
namespace {

/// A float's exponent and the first five bits of its fraction, as one number.
constexpr std::uint32_t kFractionBitsDropped = 18;
constexpr float kLeastUs = 0x1p-4F;
constexpr std::uint32_t kLeast = std::bit_cast<std::uint32_t>(kLeastUs) >> kFractionBitsDropped;

}  // namespace

void TimeHistogram::add(double us) noexcept {
  if (!(us < 1e9)) us = 1e9;
  most_ = std::max(most_, us);
  const auto clamped = std::max(static_cast<float>(us), kLeastUs);
  const std::uint32_t number = std::bit_cast<std::uint32_t>(clamped) >> kFractionBitsDropped;
  ++parts_[std::min<std::size_t>(number - kLeast, kSize - 1)];
  ++count_;
}

double TimeHistogram::quantile(double share) const noexcept {
  if (count_ == 0) return 0;
  const auto wanted = static_cast<std::uint64_t>(share * static_cast<double>(count_ - 1));
  std::uint64_t seen = 0;
  std::uint32_t i = 0;
  while (i + 1 < kSize && (seen += parts_[i]) <= wanted) ++i;
  constexpr std::uint32_t kMiddle = 1U << (kFractionBitsDropped - 1);
  const double middle =
      static_cast<double>(std::bit_cast<float>(((i + kLeast) << kFractionBitsDropped) + kMiddle));
  return std::min(middle, most_);
}

}  // namespace carpus::devices
