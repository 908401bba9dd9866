// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the header of a volume file says, checked: where the voxels lie in the patient and where in
// the file. Every format's parser gives this and nothing else.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geometry/grid.hpp"
#include "image_formats/refusal.hpp"

namespace carpus::image_formats {

/// More voxels than this are refused before memory is asked for: eight times a full hand at 0.25
/// mm.
inline constexpr std::size_t kMostVoxels = std::size_t{1} << 30U;

enum class VoxelType { U8, I8, U16, I16, U32, I32, U64, I64, F32, F64 };
[[nodiscard]] std::size_t size_of(VoxelType type) noexcept;

enum class Packing { Raw, Gzip, Zlib };

struct VolumeHeader {
  GridGeometry geometry;
  VoxelType type = VoxelType::I16;
  bool is_big_endian = false;
  double slope = 1;  ///< value = stored * slope + intercept
  double intercept = 0;

  Packing packing = Packing::Raw;
  std::string data_file;  ///< plain name of a file beside the header; empty: the header's own
  std::uint64_t stored_begins = 0;  ///< in the file that holds them; raw or packed
  bool lies_at_end = false;         ///< stored_begins does not count: the last bytes of the file
  std::uint64_t unpacked_skip = 0;  ///< bytes of the unpacked stream before the first voxel
  std::optional<std::uint64_t> packed_bytes;  ///< where the header says it

  std::string description;               ///< what the file says about itself, may be empty
  std::vector<std::string> conventions;  ///< what was taken by convention, in words for the report

  /// All voxels as stored, unpacked.
  [[nodiscard]] std::uint64_t voxel_bytes() const noexcept {
    return geometry.voxel_count() * size_of(type);
  }
};

/// What a header states about place and shape, as numbers and nothing more.
struct StatedGeometry {
  std::array<double, 3> size{};  ///< as double: a header may claim more than any integer holds
  Vec3 spacing{};                ///< all > 0 [mm]
  Vec3 origin{};                 ///< LPS [mm]
  std::array<Vec3, 3> axes{};    ///< unit directions, LPS
};

/// A grid of it, made exactly orthonormal.
/// @throws InvalidInput where a side has no voxels or the whole more than kMostVoxels, a spacing is
/// not between 0.005 and 20 mm, the origin is not finite, or the axes are not at right angles.
[[nodiscard]] GridGeometry usable_geometry(const StatedGeometry& stated, const Refuser& refuse);

/// Formats keep lengths as float32, so that 0.3 comes back as 0.300000012: a number that is exactly
/// a float is taken for the shortest decimal that this float stands for.
[[nodiscard]] double decimal_of_float(double v);

/// A name that can only mean a file in the header's own folder.
[[nodiscard]] bool is_plain_file_name(const std::string& name);

}  // namespace carpus::image_formats
