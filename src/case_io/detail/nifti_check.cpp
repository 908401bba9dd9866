// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Header fields by their place in nifti1.h: sizeof_hdr 0, dim 40, bitpix 72, pixdim 76, vox_offset
// 108, qform_code 252, sform_code 254, quatern_b to qoffset_z 256, srow_x to srow_z 280, magic 344.
#include "case_io/detail/nifti_check.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace carpus::case_io {
namespace {

constexpr std::size_t kHeaderBytes = 348;
using HeaderBytes = std::array<unsigned char, kHeaderBytes>;

template <typename T>
T field(const HeaderBytes& header, std::size_t at, bool is_swapped) {
  std::array<unsigned char, sizeof(T)> bytes{};
  std::copy_n(header.begin() + static_cast<std::ptrdiff_t>(at), sizeof(T), bytes.begin());
  if (is_swapped) std::reverse(bytes.begin(), bytes.end());
  T value;
  std::memcpy(&value, bytes.data(), sizeof(T));
  return value;
}

/// Bytes that the header promises; 0 where it is no single-file NIfTI-1 header.
double promised_bytes(const HeaderBytes& header) {
  if (std::memcmp(header.data() + 344, "n+1", 3) != 0) return 0;
  const bool is_swapped = field<std::int32_t>(header, 0, false) != 348;
  if (field<std::int32_t>(header, 0, is_swapped) != 348) return 0;
  double bytes = field<std::int16_t>(header, 72, is_swapped) / 8.0;
  const int dimensions = field<std::int16_t>(header, 40, is_swapped);
  for (int i = 1; i <= std::min(dimensions, 7); ++i) {
    bytes *= field<std::int16_t>(header, 40 + 2 * static_cast<std::size_t>(i), is_swapped);
  }
  return bytes + static_cast<double>(field<float>(header, 108, is_swapped));
}

/// ITK 5.2 ends the whole program (vnl's abort) on a matrix that is not finite.
bool has_finite_geometry(const HeaderBytes& header) {
  const bool is_swapped = field<std::int32_t>(header, 0, false) != 348;
  const auto are_finite = [&](std::size_t at, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      if (!std::isfinite(field<float>(header, at + 4 * i, is_swapped))) return false;
    }
    return true;
  };
  const bool has_qform = field<std::int16_t>(header, 252, is_swapped) > 0;
  const bool has_sform = field<std::int16_t>(header, 254, is_swapped) > 0;
  return are_finite(76, 4) && (!has_qform || are_finite(256, 6)) &&
         (!has_sform || are_finite(280, 12));
}

}  // namespace

void check_nifti_is_whole(const std::filesystem::path& file) {
  const auto refuse = [&](const char* why) {
    throw IoError(file.string() + ": " + why + "; copy it again from its source");
  };
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> in(gzopen(file.string().c_str(), "rb"), gzclose);
  if (!in) refuse("cannot be opened");
  HeaderBytes header{};
  if (gzread(in.get(), header.data(), kHeaderBytes) != static_cast<int>(kHeaderBytes)) {
    refuse("is damaged or too short to be NIfTI");
  }
  const double promised = promised_bytes(header);
  if (!(promised > 0)) refuse("is not a NIfTI-1 file, whatever its name says");
  if (!has_finite_geometry(header)) refuse("has a spacing, place or direction that is no number");
  std::vector<char> buffer(1U << 18U);
  double bytes = kHeaderBytes;
  int got = 0;
  while ((got = gzread(in.get(), buffer.data(), static_cast<unsigned>(buffer.size()))) > 0) {
    bytes += got;
  }
  int error = Z_OK;
  gzerror(in.get(), &error);
  if (got < 0 || error != Z_OK || bytes < promised) refuse("is damaged or cut short");
}

}  // namespace carpus::case_io
