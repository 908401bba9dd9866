// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One image file read through an itk::ImageIOBase into our grid: geometry checked, values converted
// with what happened to them counted. Private to case_io: nobody else meets ITK.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>

#include "geometry/grid.hpp"

namespace itk {
class ImageIOBase;
}

namespace carpus::case_io {

/// More voxels than this are refused before memory is asked for: eight times a full hand at 0.25
/// mm.
inline constexpr std::size_t kMostVoxels = std::size_t{1} << 30U;

/// What conversion met.
struct ValueCount {
  double least = std::numeric_limits<double>::infinity();
  double greatest = -std::numeric_limits<double>::infinity();
  std::size_t not_finite = 0;  ///< NaN or infinite; written as 0
  std::size_t clamped = 0;     ///< outside what T can hold; written as its nearest value
  std::size_t rounded = 0;     ///< not whole where T is an integer
};

/// Reads header and geometry.
/// @throws IoError where the file cannot be read; InvalidInput where its geometry cannot be used:
/// not three-dimensional, not one value a voxel, spacing not positive, axes not orthonormal, too
/// large. Both name the file and say what to do.
[[nodiscard]] GridGeometry read_geometry(itk::ImageIOBase& io, const std::filesystem::path& file);

/// Reads the values of the file last given to `io.ReadImageInformation` into `values`, converted to
/// T (rounded to nearest for integers). T is int16_t, uint8_t or float.
/// @throws IoError where the data is damaged or shorter than the header says.
template <typename T>
void read_values(itk::ImageIOBase& io,
                 const std::filesystem::path& file,
                 std::span<T> values,
                 ValueCount& count);

/// Throws IoError: "<file>: <what>: <ITK's words>".
[[noreturn]] void throw_itk_error(const std::filesystem::path& file,
                                  const char* what,
                                  const char* detail);

}  // namespace carpus::case_io
