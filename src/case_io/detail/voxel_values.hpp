// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Voxels as stored to voxels as used, with what happened to them counted.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <type_traits>

#include "image_formats/volume_header.hpp"

namespace carpus::case_io {

static_assert(std::endian::native == std::endian::little, "files are read as memory lies");

/// What conversion met.
struct ValueCount {
  double least = std::numeric_limits<double>::infinity();
  double greatest = -std::numeric_limits<double>::infinity();
  std::size_t not_finite = 0;  ///< NaN or infinite; written as 0
  std::size_t clamped = 0;     ///< outside what T can hold; written as its nearest value
  std::size_t rounded = 0;     ///< not whole where T is an integer
};

template <typename T>
[[nodiscard]] T converted(double v, ValueCount& count) {
  if (!std::isfinite(v)) {
    ++count.not_finite;
    return T{};
  }
  constexpr auto low = static_cast<double>(std::numeric_limits<T>::lowest());
  constexpr auto high = static_cast<double>(std::numeric_limits<T>::max());
  count.least = std::min(count.least, v);
  count.greatest = std::max(count.greatest, v);
  if (v < low || v > high) ++count.clamped;
  v = std::clamp(v, low, high);
  if constexpr (std::is_integral_v<T>) {
    const double whole = std::nearbyint(v);
    if (whole != v) ++count.rounded;
    v = whole;
  }
  return static_cast<T>(v);
}

/// Takes the bytes of voxels in any portions and fills `to`.
template <typename T>
class VoxelWriter {
 public:
  VoxelWriter(const image_formats::VolumeHeader& header, std::span<T> to, ValueCount& count)
      : header_(header), to_(to), count_(count), skip_(header.unpacked_skip) {}

  void put(std::span<const std::byte> bytes) {
    const auto skipped = static_cast<std::size_t>(std::min<std::uint64_t>(skip_, bytes.size()));
    skip_ -= skipped;
    bytes = bytes.subspan(skipped);
    const std::size_t size = image_formats::size_of(header_.type);
    while (kept_ > 0 && !bytes.empty()) {  // a voxel whose front came with the last portion
      part_[kept_++] = bytes.front();
      bytes = bytes.subspan(1);
      if (kept_ == size) {
        convert(std::span<const std::byte>(part_).first(size));
        kept_ = 0;
      }
    }
    const std::size_t whole = bytes.size() - bytes.size() % size;
    convert(bytes.first(whole));
    for (const std::byte b : bytes.subspan(whole)) part_[kept_++] = b;
  }

  [[nodiscard]] bool is_full() const noexcept { return at_ == to_.size() && kept_ == 0; }

 private:
  void convert(std::span<const std::byte> bytes) {
    switch (header_.type) {
      case image_formats::VoxelType::U8:
        return convert_as<std::uint8_t>(bytes);
      case image_formats::VoxelType::I8:
        return convert_as<std::int8_t>(bytes);
      case image_formats::VoxelType::U16:
        return convert_as<std::uint16_t>(bytes);
      case image_formats::VoxelType::I16:
        return convert_as<std::int16_t>(bytes);
      case image_formats::VoxelType::U32:
        return convert_as<std::uint32_t>(bytes);
      case image_formats::VoxelType::I32:
        return convert_as<std::int32_t>(bytes);
      case image_formats::VoxelType::U64:
        return convert_as<std::uint64_t>(bytes);
      case image_formats::VoxelType::I64:
        return convert_as<std::int64_t>(bytes);
      case image_formats::VoxelType::F32:
        return convert_as<float>(bytes);
      case image_formats::VoxelType::F64:
        return convert_as<double>(bytes);
    }
  }

  template <typename From>
  void convert_as(std::span<const std::byte> bytes) {
    const bool is_scaled = header_.slope != 1 || header_.intercept != 0;
    const std::size_t voxels = std::min(bytes.size() / sizeof(From), to_.size() - at_);
    for (std::size_t i = 0; i < voxels; ++i) {
      std::array<std::byte, sizeof(From)> b;
      std::memcpy(b.data(), bytes.data() + i * sizeof(From), sizeof(From));
      if (header_.is_big_endian) std::reverse(b.begin(), b.end());
      From stored;
      std::memcpy(&stored, b.data(), sizeof(From));
      auto v = static_cast<double>(stored);
      if (is_scaled) v = v * header_.slope + header_.intercept;
      to_[at_++] = converted<T>(v, count_);
    }
  }

  const image_formats::VolumeHeader& header_;
  std::span<T> to_;
  ValueCount& count_;
  std::uint64_t skip_;
  std::size_t at_ = 0;
  std::array<std::byte, 8> part_{};
  std::size_t kept_ = 0;
};

}  // namespace carpus::case_io
