// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Fields by their place in nifti1.h: sizeof_hdr 0, dim 40, datatype 70, bitpix 72, pixdim 76,
// vox_offset 108, scl_slope 112, scl_inter 116, xyzt_units 123, descrip 148, qform_code 252,
// sform_code 254, quatern_b to qoffset_z 256, srow_x to srow_z 280, magic 344.
#include "image_formats/nifti_header.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>

namespace carpus::image_formats {
namespace {

/// qform, sform and pixdim are each rounded to float32 by writers, some to six digits: over a wrist
/// of 300 voxels that is below these.
constexpr double kSameSpacingRatio = 2e-4;
constexpr double kSamePlaceMm = 0.02;
/// The most that may stand between header and voxels: extensions hold a few hundred kB of text.
constexpr double kFarthestVoxels = 1 << 26;

struct Form {
  Vec3 origin{};                  ///< RAS
  std::array<Vec3, 3> columns{};  ///< RAS, one voxel's step [mm]
};

class Parser {
 public:
  Parser(std::span<const std::byte> front, const Refuser& refuse)
      : front_(front), refuse_(refuse) {}

  VolumeHeader run() {
    check_kind();
    VolumeHeader header;
    header.is_big_endian = is_swapped_;
    take_type(header);
    take_scaling(header);
    const double begins = number(108, "vox_offset");
    if (!(begins >= kNiftiFrontBytes && begins <= kFarthestVoxels) ||
        begins != std::floor(begins)) {
      refuse_.damaged("vox_offset", printable(begins), "not a whole number from 352 to 2^26");
    }
    header.stored_begins = static_cast<std::uint64_t>(begins);
    header.geometry = geometry(header);
    header.description = text(148, 80);
    return header;
  }

 private:
  template <typename T>
  [[nodiscard]] T raw(std::size_t at) const {
    std::array<std::byte, sizeof(T)> bytes{};
    std::copy_n(front_.begin() + static_cast<std::ptrdiff_t>(at), sizeof(T), bytes.begin());
    if (is_swapped_) std::reverse(bytes.begin(), bytes.end());
    T value;
    std::memcpy(&value, bytes.data(), sizeof(T));
    return value;
  }
  [[nodiscard]] double number(std::size_t at, const char* field) const {
    const double v = static_cast<double>(raw<float>(at));
    if (!std::isfinite(v)) refuse_.damaged(field, "no number", "a finite one is needed");
    return v;
  }
  [[nodiscard]] Vec3 numbers(std::size_t at, const char* field) const {
    return {number(at, field), number(at + 4, field), number(at + 8, field)};
  }
  [[nodiscard]] std::string text(std::size_t at, std::size_t longest) const {
    std::string s(longest, '\0');
    std::memcpy(s.data(), front_.data() + at, longest);
    return s.substr(0, s.find('\0'));
  }

  void check_kind() {
    if (front_.size() < kNiftiFrontBytes) {
      refuse_.damaged("the file", "shorter than a header", "NIfTI has one of 352 bytes");
    }
    if (const auto size = raw<std::int32_t>(0); size == 540 || size == 0x1C020000) {
      refuse_.unusable("sizeof_hdr", "540 (NIfTI-2)", "save it as NIfTI-1 and open that");
    }
    is_swapped_ = raw<std::int32_t>(0) != 348;
    if (raw<std::int32_t>(0) != 348 || text(344, 4) != "n+1") {
      refuse_.damaged("its start", "not that of a NIfTI-1 volume in one file",
                      "whatever its name says");
    }
  }

  void take_type(VolumeHeader& header) const {
    struct Known {
      int code;
      VoxelType type;
    };
    constexpr std::array kKnown{Known{2, VoxelType::U8},     Known{4, VoxelType::I16},
                                Known{8, VoxelType::I32},    Known{16, VoxelType::F32},
                                Known{64, VoxelType::F64},   Known{256, VoxelType::I8},
                                Known{512, VoxelType::U16},  Known{768, VoxelType::U32},
                                Known{1024, VoxelType::I64}, Known{1280, VoxelType::U64}};
    const int code = raw<std::int16_t>(70);
    const auto* known =
        std::find_if(kKnown.begin(), kKnown.end(), [&](const Known& k) { return k.code == code; });
    if (known == kKnown.end()) {
      refuse_.unusable("datatype", std::to_string(code) + ", not one real number a voxel",
                       "convert it to 16-bit integers and open it again");
    }
    header.type = known->type;
    const int bits = raw<std::int16_t>(72);
    if (bits != static_cast<int>(8 * size_of(header.type))) {
      refuse_.damaged("bitpix", std::to_string(bits),
                      "but datatype says " + std::to_string(8 * size_of(header.type)));
    }
  }

  void take_scaling(VolumeHeader& header) const {
    const double slope = number(112, "scl_slope");
    const double intercept = number(116, "scl_inter");
    if (slope == 0) return;  // "not to be used"
    header.slope = slope;
    header.intercept = intercept;
    if (slope == 1 && intercept == 0) return;
    header.conventions.push_back("values are stored x " + printable(decimal_of_float(slope)) +
                                 " + " + printable(decimal_of_float(intercept)) +
                                 " (scl_slope, scl_inter)");
  }

  /// mm in the file's unit of length.
  double unit(VolumeHeader& header) const {
    switch (std::to_integer<int>(front_[123]) & 7) {
      case 0:
        header.conventions.emplace_back("lengths are in mm (xyzt_units says nothing)");
        return 1;
      case 1:
        header.conventions.emplace_back("lengths were converted from metres");
        return 1000;
      case 2:
        return 1;
      case 3:
        header.conventions.emplace_back("lengths were converted from micrometres");
        return 0.001;
      default:
        refuse_.damaged("xyzt_units", std::to_string(std::to_integer<int>(front_[123])),
                        "which is no unit of length");
    }
  }

  [[nodiscard]] Form sform(double mm) const {
    Form form;
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t i = 0; i < 3; ++i) {
        form.columns[i][row] = mm * number(280 + 16 * row + 4 * i, "srow");
      }
      form.origin[row] = mm * decimal_of_float(number(292 + 16 * row, "srow"));
    }
    return form;
  }

  [[nodiscard]] Form qform(const Vec3& spacing, double mm) const {
    const Vec3 q = numbers(256, "quatern");
    const double rest = 1.0 - squared_length(q);
    constexpr double kRounding = 1e-5;
    if (!(rest > -kRounding)) {
      refuse_.damaged("quatern", "longer than 1", "which is no rotation");
    }
    const double handed = number(76, "pixdim[0]");
    if (handed != 1 && handed != -1 && handed != 0) {
      refuse_.damaged("pixdim[0]", printable(handed), "which must be 1 or -1");
    }
    const Mat3 rotation = rotation_from_quaternion(std::sqrt(std::max(rest, 0.0)), q.x, q.y, q.z);
    Form form;
    for (std::size_t i = 0; i < 3; ++i) form.columns[i] = rotation.column(i) * spacing[i];
    if (handed == -1) form.columns[2] = -form.columns[2];
    const Vec3 offset = numbers(268, "qoffset");
    for (std::size_t i = 0; i < 3; ++i) form.origin[i] = mm * decimal_of_float(offset[i]);
    return form;
  }

  void check_agree(const Form& q, const Form& s, const std::array<double, 3>& size) const {
    for (int corner = 0; corner < 8; ++corner) {
      Vec3 apart = q.origin - s.origin;
      for (std::size_t i = 0; i < 3; ++i) {
        if ((corner >> i) % 2 == 1) apart += (q.columns[i] - s.columns[i]) * (size[i] - 1);
      }
      if (!(length(apart) <= kSamePlaceMm)) {
        refuse_.damaged("qform", printable(length(apart)) + " mm off sform at a corner",
                        "and the two must say the same place");
      }
    }
  }

  GridGeometry geometry(VolumeHeader& header) const {
    StatedGeometry stated;
    const int dimensions = raw<std::int16_t>(40);
    if (dimensions < 3 || dimensions > 7) {
      refuse_.unusable("dim[0]", std::to_string(dimensions), "a CT has 3 dimensions");
    }
    for (int i = 4; i <= dimensions; ++i) {
      if (raw<std::int16_t>(40 + 2 * static_cast<std::size_t>(i)) != 1) {
        refuse_.unusable("dim[0]", std::to_string(dimensions) + " dimensions",
                         "save one time point as a volume and open that");
      }
    }
    const double mm = unit(header);
    for (std::size_t i = 0; i < 3; ++i) {
      stated.size[i] = raw<std::int16_t>(42 + 2 * i);
      stated.spacing[i] = mm * decimal_of_float(number(80 + 4 * i, "pixdim"));
    }
    const bool has_qform = raw<std::int16_t>(252) > 0;
    const bool has_sform = raw<std::int16_t>(254) > 0;
    if (!has_qform && !has_sform) {
      refuse_.unusable("qform_code", "0 and sform_code too, so left and right are not known",
                       "convert it again from the scan, for example by dcm2niix");
    }
    const Form form = has_sform ? sform(mm) : qform(stated.spacing, mm);
    for (std::size_t i = 0; i < 3; ++i) {
      const double step = length(form.columns[i]);
      if (!(std::abs(step - stated.spacing[i]) <= kSameSpacingRatio * step)) {
        refuse_.damaged("pixdim[" + std::to_string(i + 1) + "]",
                        printable(stated.spacing[i]) + " mm",
                        "but sform says " + printable(decimal_of_float(step)) + " mm");
      }
      stated.axes[i] = normalized_or(form.columns[i], {0, 0, 0});
    }
    if (has_sform && has_qform) check_agree(qform(stated.spacing, mm), form, stated.size);
    stated.origin = {-form.origin.x, -form.origin.y, form.origin.z};  // RAS to LPS
    for (Vec3& axis : stated.axes) axis = {-axis.x, -axis.y, axis.z};
    return usable_geometry(stated, refuse_);
  }

  std::span<const std::byte> front_;
  const Refuser& refuse_;
  bool is_swapped_ = false;
};

}  // namespace

VolumeHeader parse_nifti(std::span<const std::byte> front, const Refuser& refuse) {
  return Parser(front, refuse).run();
}

}  // namespace carpus::image_formats
