// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "image_formats/volume_header.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace carpus::image_formats {
namespace {

/// Direction cosines in files carry six digits or float32; a sheared grid (gantry tilt of one
/// degree) is off by 0.017.
constexpr double kDirectionTolerance = 2e-3;
/// Wider than any scanner, thinner than any detector [mm]: outside, the unit is wrong.
constexpr double kLeastSpacingMm = 0.005;
constexpr double kGreatestSpacingMm = 20.0;
/// No patient lies further from a scanner's origin [mm].
constexpr double kFarthestMm = 1e5;

/// Gram-Schmidt on nearly orthonormal columns; keeps the sign of the determinant.
Mat3 orthonormalized(const Mat3& m) {
  const Vec3 x = normalized_or(m.column(0), {1, 0, 0});
  const Vec3 y = normalized_or(m.column(1) - x * dot(x, m.column(1)), {0, 1, 0});
  const Vec3 z = cross(x, y);
  return Mat3::from_columns(x, y, m.determinant() < 0 ? -z : z);
}

void check_direction(const Mat3& m, const Refuser& refuse) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      const double wanted = i == j ? 1.0 : 0.0;
      if (!(std::abs(dot(m.column(i), m.column(j)) - wanted) < kDirectionTolerance)) {
        refuse.unusable("its direction", "not of axes at right angles (tilted gantry or a shear)",
                        "resample it to a rectangular grid, for example in 3D Slicer, and open the "
                        "result");
      }
    }
  }
}

void check_size(const std::array<double, 3>& size, const Refuser& refuse) {
  double voxels = 1;
  std::string text;
  for (const double n : size) {
    text += (text.empty() ? "" : " x ") + printable(n);
    voxels *= n;
    if (!(n >= 1) || n != std::floor(n)) {
      refuse.damaged("its size", text + " voxels", "which is impossible");
    }
  }
  if (!(voxels <= static_cast<double>(kMostVoxels))) {
    refuse.unusable("its size", text + " voxels, more than this program holds (2^30)",
                    "crop it to the wrist");
  }
}

void check_place(const StatedGeometry& stated, const Refuser& refuse) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(stated.spacing[i] >= kLeastSpacingMm && stated.spacing[i] <= kGreatestSpacingMm)) {
      refuse.unusable(
          "its spacing " + printable(stated.spacing[i]) + " mm on axis " + std::to_string(i),
          "not between " + printable(kLeastSpacingMm) + " and " + printable(kGreatestSpacingMm) +
              " mm",
          "correct the header (spacing must be in mm) and open it again");
    }
    if (!(std::abs(stated.origin[i]) <= kFarthestMm)) {
      refuse.damaged("its origin", printable(stated.origin[i]) + " mm on axis " + std::to_string(i),
                     "no place within 100 m");
    }
  }
}

}  // namespace

std::size_t size_of(VoxelType type) noexcept {
  switch (type) {
    case VoxelType::U8:
    case VoxelType::I8:
      return 1;
    case VoxelType::U16:
    case VoxelType::I16:
      return 2;
    case VoxelType::U32:
    case VoxelType::I32:
    case VoxelType::F32:
      return 4;
    case VoxelType::U64:
    case VoxelType::I64:
    case VoxelType::F64:
      break;
  }
  return 8;
}

GridGeometry usable_geometry(const StatedGeometry& stated, const Refuser& refuse) {
  check_size(stated.size, refuse);
  check_place(stated, refuse);
  GridGeometry g;
  for (std::size_t i = 0; i < 3; ++i) g.size[i] = static_cast<int>(stated.size[i]);
  g.spacing = stated.spacing;
  g.origin = stated.origin;
  const Mat3 direction = Mat3::from_columns(stated.axes[0], stated.axes[1], stated.axes[2]);
  check_direction(direction, refuse);
  g.direction = orthonormalized(direction);
  return g;
}

double decimal_of_float(double v) {
  if (!(std::abs(v) <= 3e38)) return v;  // beyond a float, conversion is undefined
  const auto as_float = static_cast<float>(v);
  if (static_cast<double>(as_float) != v) return v;
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), as_float).ptr;
  double decimal = v;
  std::from_chars(digits.data(), end, decimal);
  return decimal;
}

bool is_plain_file_name(const std::string& name) {
  constexpr std::size_t kLongest = 255;
  return !name.empty() && name.size() <= kLongest && name[0] != '.' &&
         name.find_first_of(std::string_view("/\\\0", 3)) == std::string::npos &&
         std::all_of(name.begin(), name.end(),
                     [](char c) { return static_cast<unsigned char>(c) >= 0x20; });
}

}  // namespace carpus::image_formats
