// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Values of the voxels of a mask alone, side by side in the order of memory: most of a CT is no
// bone, and a number for each of its voxels would be the largest thing in memory.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/grid.hpp"

namespace carpus::imaging {

/// Numbers the voxels of a mask from 0 in the order of memory. A bit a voxel, and for 64 voxels how
/// many of the mask lie before them.
class MaskIndex {
 public:
  explicit MaskIndex(const GridView<const std::uint8_t>& mask)
      : voxels_(mask.values().size()),
        words_((voxels_ + kBits - 1) / kBits),
        before_(words_.size()) {
    for (std::size_t word = 0; word < words_.size(); ++word) {
      before_[word] = static_cast<std::uint32_t>(count_);
      const std::size_t first = word * kBits;
      const std::size_t length = voxels_ - first < kBits ? voxels_ - first : kBits;
      std::uint64_t bits = 0;
      for (std::size_t k = 0; k < length; ++k) {
        bits |= std::uint64_t{mask[first + k] != 0 ? 1U : 0U} << k;
      }
      words_[word] = bits;
      count_ += static_cast<std::size_t>(std::popcount(bits));
    }
  }

  [[nodiscard]] bool contains(std::size_t voxel) const noexcept {
    return (words_[voxel / kBits] >> (voxel % kBits) & 1U) != 0;
  }
  /// Number of a voxel of the mask.
  [[nodiscard]] std::size_t number_of(std::size_t voxel) const noexcept {
    const std::uint64_t earlier = words_[voxel / kBits] & ((std::uint64_t{1} << voxel % kBits) - 1);
    return before_[voxel / kBits] + static_cast<std::size_t>(std::popcount(earlier));
  }
  /// Voxels of the mask.
  [[nodiscard]] std::size_t count() const noexcept { return count_; }

  /// Calls visit(voxel) for each voxel of the mask, in the order of their numbers.
  template <typename Visit>
  void for_each(const Visit& visit) const {
    for (std::size_t word = 0; word < words_.size(); ++word) {
      for (std::uint64_t bits = words_[word]; bits != 0; bits &= bits - 1) {
        visit(word * kBits + static_cast<std::size_t>(std::countr_zero(bits)));
      }
    }
  }

 private:
  static constexpr std::size_t kBits = 64;

  std::size_t voxels_ = 0;
  std::size_t count_ = 0;
  std::vector<std::uint64_t> words_;
  std::vector<std::uint32_t> before_;
};

/// What `image` has at the voxels of a mask.
class MaskedValues {
 public:
  MaskedValues(const GridView<const float>& image, const GridView<const std::uint8_t>& mask)
      : geometry_(image.geometry()), index_(mask) {
    CARPUS_CHECK(mask.values().size() == image.values().size());
    values_.reserve(index_.count());
    index_.for_each([&](std::size_t voxel) { values_.push_back(image[voxel]); });
  }

  [[nodiscard]] const GridGeometry& geometry() const noexcept { return geometry_; }
  [[nodiscard]] const MaskIndex& mask() const noexcept { return index_; }
  /// At a voxel of the mask.
  [[nodiscard]] float operator[](std::size_t voxel) const noexcept {
    return values_[index_.number_of(voxel)];
  }
  /// Calls visit(voxel, value) for each voxel of the mask, in the order of memory.
  template <typename Visit>
  void for_each(const Visit& visit) const {
    const float* value = values_.data();
    index_.for_each([&](std::size_t voxel) { visit(voxel, *value++); });
  }

 private:
  GridGeometry geometry_;
  MaskIndex index_;
  std::vector<float> values_;
};

}  // namespace carpus::imaging
