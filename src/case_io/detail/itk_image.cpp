// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/detail/itk_image.hpp"

#include <itkImageIOBase.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace carpus::case_io {
namespace {

/// Direction cosines in files carry six digits or float32; a sheared grid (gantry tilt of one
/// degree) is off by 0.017.
constexpr double kDirectionTolerance = 2e-3;
/// Wider than any scanner, thinner than any detector [mm]: outside, the unit is wrong.
constexpr double kLeastSpacingMm = 0.005;
constexpr double kGreatestSpacingMm = 20.0;

std::string text(double v) {
  std::string s = std::to_string(v);
  s.erase(s.find_last_not_of('0') + 1);
  if (s.back() == '.') s.pop_back();
  return s;
}

/// NIfTI keeps lengths as float32, so that 0.3 comes back as 0.300000012: a number that is exactly
/// a float is taken for the shortest decimal that this float stands for.
double decimal_of_float(double v) {
  const auto as_float = static_cast<float>(v);
  if (static_cast<double>(as_float) != v) return v;
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), as_float).ptr;
  double decimal = v;
  std::from_chars(digits.data(), end, decimal);
  return decimal;
}

/// Gram-Schmidt on nearly orthonormal columns; keeps the sign of the determinant.
Mat3 orthonormalized(const Mat3& m) {
  const Vec3 x = normalized_or(m.column(0), {1, 0, 0});
  const Vec3 y = normalized_or(m.column(1) - x * dot(x, m.column(1)), {0, 1, 0});
  const Vec3 z = cross(x, y);
  return Mat3::from_columns(x, y, m.determinant() < 0 ? -z : z);
}

void check_direction(const Mat3& m, const std::string& name) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      const double wanted = i == j ? 1.0 : 0.0;
      if (!(std::abs(dot(m.column(i), m.column(j)) - wanted) < kDirectionTolerance)) {
        throw InvalidInput(
            name +
            ": its axes are not at right angles (tilted gantry or a shear); resample "
            "it to a rectangular grid, for example in 3D Slicer, and open the result");
      }
    }
  }
}

void check_size(const GridGeometry& g, const std::string& name) {
  double voxels = 1;
  for (const int n : g.size) {
    if (n < 1) throw InvalidInput(name + ": an axis has no voxels");
    voxels *= n;
  }
  if (voxels > static_cast<double>(kMostVoxels)) {
    throw InvalidInput(name + ": " + std::to_string(g.size[0]) + " x " + std::to_string(g.size[1]) +
                       " x " + std::to_string(g.size[2]) +
                       " voxels are more than this program holds (2^30); crop it to the wrist");
  }
}

void check_spacing(const Vec3& spacing, const std::string& name) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(spacing[i] >= kLeastSpacingMm && spacing[i] <= kGreatestSpacingMm)) {
      throw InvalidInput(name + ": spacing " + text(spacing[i]) + " mm on axis " +
                         std::to_string(i) + " is not between " + text(kLeastSpacingMm) + " and " +
                         text(kGreatestSpacingMm) +
                         " mm; correct the header (spacing must be in mm) and open it again");
    }
  }
}

template <typename From, typename T>
void convert(const std::vector<char>& bytes, std::span<T> to, ValueCount& count) {
  constexpr double low = static_cast<double>(std::numeric_limits<T>::lowest());
  constexpr double high = static_cast<double>(std::numeric_limits<T>::max());
  for (std::size_t i = 0; i < to.size(); ++i) {
    From raw;
    std::memcpy(&raw, bytes.data() + i * sizeof(From), sizeof(From));
    double v = static_cast<double>(raw);
    if (!std::isfinite(v)) {
      ++count.not_finite;
      to[i] = T{};
      continue;
    }
    count.least = std::min(count.least, v);
    count.greatest = std::max(count.greatest, v);
    if (v < low || v > high) ++count.clamped;
    v = std::clamp(v, low, high);
    if constexpr (std::is_integral_v<T>) {
      const double whole = std::nearbyint(v);
      if (whole != v) ++count.rounded;
      v = whole;
    }
    to[i] = static_cast<T>(v);
  }
}

template <typename T>
void convert_as(itk::IOComponentEnum type,
                const std::vector<char>& bytes,
                std::span<T> to,
                ValueCount& count,
                const std::string& name) {
  using enum itk::IOComponentEnum;
  switch (type) {
    case UCHAR:
      return convert<unsigned char>(bytes, to, count);
    case CHAR:
      return convert<signed char>(bytes, to, count);
    case USHORT:
      return convert<unsigned short>(bytes, to, count);
    case SHORT:
      return convert<short>(bytes, to, count);
    case UINT:
      return convert<unsigned int>(bytes, to, count);
    case INT:
      return convert<int>(bytes, to, count);
    case ULONG:
      return convert<unsigned long>(bytes, to, count);
    case LONG:
      return convert<long>(bytes, to, count);
    case ULONGLONG:
      return convert<unsigned long long>(bytes, to, count);
    case LONGLONG:
      return convert<long long>(bytes, to, count);
    case FLOAT:
      return convert<float>(bytes, to, count);
    case DOUBLE:
      return convert<double>(bytes, to, count);
    default:
      throw InvalidInput(name +
                         ": its voxels are of a type that this program does not know; "
                         "convert it to 16-bit integers and open it again");
  }
}

}  // namespace

void throw_itk_error(const std::filesystem::path& file, const char* what, const char* detail) {
  std::string words = detail;
  const std::size_t end = words.find_last_not_of(" \n\r\t");
  words.erase(end == std::string::npos ? 0 : end + 1);
  throw IoError(file.string() + ": " + what + " (" + words + ")");
}

GridGeometry read_geometry(itk::ImageIOBase& io, const std::filesystem::path& file) {
  const std::string name = file.string();
  try {
    io.SetFileName(name);
    io.ReadImageInformation();
  } catch (const itk::ExceptionObject& error) {
    throw_itk_error(file, "cannot be read; it is damaged or not what its name says: copy it again",
                    error.GetDescription());
  }
  if (io.GetNumberOfComponents() != 1) {
    throw InvalidInput(name + ": has " + std::to_string(io.GetNumberOfComponents()) +
                       " values a voxel (a colour image or a vector field); a CT has one");
  }
  const unsigned dimensions = io.GetNumberOfDimensions();
  for (unsigned i = 3; i < dimensions; ++i) {
    if (io.GetDimensions(i) > 1) {
      throw InvalidInput(name + ": has " + std::to_string(dimensions) +
                         " dimensions; save one time point as a volume and open that");
    }
  }
  if (dimensions < 2) throw InvalidInput(name + ": is not an image");
  GridGeometry g;
  std::array<Vec3, 3> columns{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  for (unsigned i = 0; i < std::min(dimensions, 3U); ++i) {
    const auto size = io.GetDimensions(i);
    g.size[i] = size > kMostVoxels ? std::numeric_limits<int>::max() : static_cast<int>(size);
    g.spacing[i] = decimal_of_float(io.GetSpacing(i));
    g.origin[i] = decimal_of_float(io.GetOrigin(i));
    const std::vector<double> column = io.GetDirection(i);
    for (unsigned j = 0; j < std::min(dimensions, 3U); ++j) columns[i][j] = column[j];
    if (g.spacing[i] < 0) {  // a flipped axis, written as a negative spacing
      g.spacing[i] = -g.spacing[i];
      columns[i] = -columns[i];
    }
  }
  if (dimensions == 2) {
    g.size[2] = 1;
    columns[2] = cross(columns[0], columns[1]);
  }
  check_size(g, name);
  check_spacing(g.spacing, name);
  if (!is_finite(g.origin)) throw InvalidInput(name + ": its origin is not finite");
  const Mat3 direction = Mat3::from_columns(columns[0], columns[1], columns[2]);
  check_direction(direction, name);
  g.direction = orthonormalized(direction);
  return g;
}

template <typename T>
void read_values(itk::ImageIOBase& io,
                 const std::filesystem::path& file,
                 std::span<T> values,
                 ValueCount& count) {
  try {
    // Some readers resize to what the header promises; the buffer must be what they write.
    const auto bytes_needed = static_cast<std::size_t>(io.GetImageSizeInBytes());
    if (bytes_needed < values.size() * io.GetComponentSize()) {
      throw InvalidInput(file.string() + ": holds fewer values than its header says");
    }
    itk::ImageIORegion region(io.GetNumberOfDimensions());
    for (unsigned i = 0; i < io.GetNumberOfDimensions(); ++i) {
      region.SetIndex(i, 0);
      region.SetSize(i, io.GetDimensions(i));
    }
    io.SetIORegion(region);
    std::vector<char> bytes(bytes_needed);
    io.Read(bytes.data());
    convert_as(io.GetComponentType(), bytes, values, count, file.string());
  } catch (const itk::ExceptionObject& error) {
    throw_itk_error(file, "its voxels cannot be read; it is damaged or cut short: copy it again",
                    error.GetDescription());
  }
}

template void read_values(itk::ImageIOBase&,
                          const std::filesystem::path&,
                          std::span<std::int16_t>,
                          ValueCount&);
template void read_values(itk::ImageIOBase&,
                          const std::filesystem::path&,
                          std::span<std::uint8_t>,
                          ValueCount&);
template void read_values(itk::ImageIOBase&,
                          const std::filesystem::path&,
                          std::span<float>,
                          ValueCount&);

}  // namespace carpus::case_io
