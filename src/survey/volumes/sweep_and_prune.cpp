// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// An update takes the boxes' ends into values_, repairs each axis's order by insertion sort
// (follow), which switches bits of axis_bits_, and intersects these; a cold axis, or one whose
// order changed too much, is sorted and swept from one end to the other (sort).
#include "survey/volumes/sweep_and_prune.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "core/check.hpp"
#include "core/error.hpp"

namespace carpus::survey {
namespace {

/// An axis that needs more swaps is sorted anew: about where that is cheaper (n = 15 to 1000).
constexpr std::size_t kSwapsPerBox = 16;

/// At equal values lower ends come first: closed intervals that touch overlap.
template <typename End>
bool is_before(const End& a, const End& b) noexcept {
  return a.value < b.value || (a.value == b.value && (a.end & 1U) < (b.end & 1U));
}

bool has_nan(const Aabb& b) noexcept {
  const auto is_nan = [](const Vec3& v) { return v.x != v.x || v.y != v.y || v.z != v.z; };
  return is_nan(b.low) || is_nan(b.high);
}

}  // namespace

SweepAndPrune::SweepAndPrune(std::size_t box_count) : box_count_(box_count) {
  if (box_count > kMaxBoxes) {
    throw InvalidInput("sweep and prune of " + std::to_string(box_count) + " boxes: at most " +
                       std::to_string(kMaxBoxes));
  }
  pairs_.reserve(pair_count_of(box_count));
  for (std::uint32_t i = 0; i < box_count; ++i) {
    for (std::uint32_t j = i + 1; j < box_count; ++j) pairs_.push_back({i, j});
  }
  const std::size_t words = (pairs_.size() + 63) / 64;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    values_[axis].resize(2 * box_count);
    ends_[axis].resize(2 * box_count);
    for (std::uint32_t e = 0; e < 2 * box_count; ++e) ends_[axis][e].end = e;
    axis_bits_[axis].resize(words);
  }
  now_.resize(words);
  before_.resize(words);
  is_empty_.resize(box_count);
  open_.resize(box_count);
}

void SweepAndPrune::forget() noexcept {
  is_cold_ = true;
  std::fill(now_.begin(), now_.end(), 0);
  std::fill(before_.begin(), before_.end(), 0);
  // The order among equal values is no result, but the next update's swaps are counted.
  for (std::vector<End>& ends : ends_) {
    for (std::uint32_t e = 0; e < ends.size(); ++e) ends[e].end = e;
  }
}

SweepStatus SweepAndPrune::update(std::span<const Aabb> boxes) noexcept {
  CARPUS_CHECK(boxes.size() == box_count_);
  ++counts_.updates;
  const SweepStatus status = take(boxes);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (is_cold_ || !follow(axis)) sort(axis);
  }
  is_cold_ = false;
  std::swap(before_, now_);
  for (std::size_t w = 0; w < now_.size(); ++w) {
    now_[w] = axis_bits_[0][w] & axis_bits_[1][w] & axis_bits_[2][w];
  }
  if (some_are_empty_) clear_empty_boxes();
  return status;
}

SweepStatus SweepAndPrune::take(std::span<const Aabb> boxes) noexcept {
  SweepStatus status = SweepStatus::Ok;
  some_are_empty_ = false;
  for (std::size_t i = 0; i < box_count_; ++i) {
    Aabb box = boxes[i];
    is_empty_[i] = 0;
    if (!(box.low.x <= box.high.x && box.low.y <= box.high.y && box.low.z <= box.high.z)) {
      if (has_nan(box)) {
        status = SweepStatus::NotANumber;
        constexpr double kInfinity = std::numeric_limits<double>::infinity();
        box = {{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
      } else {
        is_empty_[i] = 1;
        some_are_empty_ = true;
        box = {{}, {}};
      }
    }
    values_[0][2 * i] = box.low.x;
    values_[0][2 * i + 1] = box.high.x;
    values_[1][2 * i] = box.low.y;
    values_[1][2 * i + 1] = box.high.y;
    values_[2][2 * i] = box.low.z;
    values_[2][2 * i + 1] = box.high.z;
  }
  return status;
}

void SweepAndPrune::switch_pair(Bits& bits, std::uint32_t end, std::uint32_t other) noexcept {
  const std::uint32_t a = end / 2;
  const std::uint32_t b = other / 2;
  const std::size_t number = pair_number(std::min(a, b), std::max(a, b), box_count_);
  bits[number / 64] ^= std::uint64_t{1} << (number % 64);
}

// Of two intervals, at most one lower end lies beyond the other's upper one, before and after; so
// each change of order of a lower and an upper end is a change of overlap, and if both orders
// change, the two cancel.
bool SweepAndPrune::follow(std::size_t axis) noexcept {
  std::vector<End>& ends = ends_[axis];
  const std::vector<double>& values = values_[axis];
  Bits& bits = axis_bits_[axis];
  const std::size_t most_swaps = kSwapsPerBox * box_count_;
  std::size_t swaps = 0;
  double below = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < ends.size() && swaps <= most_swaps; ++k) {
    const End moved{values[ends[k].end], ends[k].end};
    if (moved.value > below) {  // nearly always
      ends[k].value = below = moved.value;
      continue;
    }
    std::size_t at = k;
    for (; at > 0 && is_before(moved, ends[at - 1]); --at) {
      ends[at] = ends[at - 1];
      if (((ends[at].end ^ moved.end) & 1U) != 0) switch_pair(bits, moved.end, ends[at].end);
      ++swaps;
    }
    ends[at] = moved;
    below = ends[k].value;
  }
  counts_.swaps += swaps;
  return swaps <= most_swaps;
}

void SweepAndPrune::sort(std::size_t axis) noexcept {
  ++counts_.full_sorts;
  std::vector<End>& ends = ends_[axis];
  for (End& e : ends) e.value = values_[axis][e.end];
  std::sort(ends.begin(), ends.end(), [](const End& a, const End& b) {
    return is_before(a, b) || (!is_before(b, a) && a.end < b.end);
  });
  Bits& bits = axis_bits_[axis];
  std::fill(bits.begin(), bits.end(), 0);
  std::size_t open_count = 0;
  for (const End& e : ends) {
    if ((e.end & 1U) == 0) {
      for (std::size_t i = 0; i < open_count; ++i) switch_pair(bits, 2 * open_[i], e.end);
      open_[open_count++] = e.end / 2;
    } else {
      std::uint32_t* const closed = std::find(open_.data(), open_.data() + open_count, e.end / 2);
      *closed = open_[--open_count];
    }
  }
}

void SweepAndPrune::clear_empty_boxes() noexcept {
  for (std::size_t i = 0; i < box_count_; ++i) {
    if (is_empty_[i] == 0) continue;
    for (std::size_t j = 0; j < box_count_; ++j) {
      if (j == i) continue;
      const std::size_t number = pair_number(std::min(i, j), std::max(i, j), box_count_);
      now_[number / 64] &= ~(std::uint64_t{1} << (number % 64));
    }
  }
}

std::size_t SweepAndPrune::overlapping_count() const noexcept {
  std::size_t count = 0;
  for (const std::uint64_t bits : now_) count += static_cast<std::size_t>(std::popcount(bits));
  return count;
}

}  // namespace carpus::survey
