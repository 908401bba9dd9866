// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <gdcmDataElement.h>
#include <gdcmTrace.h>
#include <gdcmVR.h>
#include <gdcmWriter.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "case_io/detail/dicom_text.hpp"
#include "case_io/detail/disk_space.hpp"
#include "case_io/write_volume.hpp"
#include "core/error.hpp"
#include "core/state_hash.hpp"

namespace carpus::case_io {
namespace fs = std::filesystem;
namespace {

static_assert(std::endian::native == std::endian::little,
              "pixels are stored as they lie in memory");

constexpr int kInterceptHu = -1024;
constexpr int kGreatest12BitHu = kInterceptHu + 4095;
constexpr std::string_view kCtImageStorage = "1.2.840.10008.5.1.4.1.1.2";

std::string decimals(std::initializer_list<double> values) {
  std::string joined;
  for (const double v : values) joined += (joined.empty() ? "" : "\\") + decimal(v);
  return joined;
}

class Elements {
 public:
  explicit Elements(gdcm::DataSet& data) : data_(data) {}

  void text(std::uint16_t group, std::uint16_t element, gdcm::VR::VRType vr, std::string value) {
    if (value.size() % 2 != 0) value += vr == gdcm::VR::UI ? '\0' : ' ';
    bytes(group, element, vr, value.data(), value.size());
  }
  void number(std::uint16_t group, std::uint16_t element, int value) {
    const auto v = static_cast<std::uint16_t>(value);
    bytes(group, element, gdcm::VR::US, &v, sizeof v);
  }
  void bytes(std::uint16_t group,
             std::uint16_t element,
             gdcm::VR::VRType vr,
             const void* data,
             std::size_t size) {
    gdcm::DataElement e(gdcm::Tag(group, element), 0, vr);
    e.SetByteValue(static_cast<const char*>(data), static_cast<std::uint32_t>(size));
    data_.Replace(e);
  }

 private:
  gdcm::DataSet& data_;
};

struct Series {
  GridGeometry geometry;
  DicomDescription description;
  std::string study_uid;
  std::string series_uid;
  std::string frame_uid;
  std::uint64_t instance_seed = 0;
  bool is_12_bit = true;
};

void add_identity(Elements& e, const Series& s, int slice) {
  using VR = gdcm::VR;
  e.text(0x0008, 0x0005, VR::CS, "ISO_IR 100");
  e.text(0x0008, 0x0008, VR::CS, "DERIVED\\PRIMARY\\AXIAL");
  e.text(0x0008, 0x0016, VR::UI, std::string(kCtImageStorage));
  e.text(0x0008, 0x0018, VR::UI,
         uid_from(s.instance_seed + static_cast<std::uint64_t>(slice) * 0x9E3779B97F4A7C15ULL));
  for (const std::uint16_t date : std::array<std::uint16_t, 3>{0x0020, 0x0021, 0x0023})
    e.text(0x0008, date, VR::DA, "20260101");
  for (const std::uint16_t time : std::array<std::uint16_t, 3>{0x0030, 0x0031, 0x0033})
    e.text(0x0008, time, VR::TM, "120000");
  e.text(0x0008, 0x0050, VR::SH, "");
  e.text(0x0008, 0x0060, VR::CS, "CT");
  e.text(0x0008, 0x0070, VR::LO, "Carpus (simulated)");
  e.text(0x0008, 0x0090, VR::PN, "");
  e.text(0x0008, 0x1030, VR::LO, "Simulated wrist CT");
  e.text(0x0008, 0x103e, VR::LO, s.description.series_description);
  e.text(0x0010, 0x0010, VR::PN, "Simulated^Phantom");
  e.text(0x0010, 0x0020, VR::LO, "SIMULATED-" + std::to_string(s.description.seed));
  e.text(0x0010, 0x0030, VR::DA, "");
  e.text(0x0010, 0x0040, VR::CS, "O");
}

void add_geometry(Elements& e, const Series& s, int slice) {
  using VR = gdcm::VR;
  const GridGeometry& g = s.geometry;
  const Vec3 row = g.direction.column(0);
  const Vec3 column = g.direction.column(1);
  const Vec3 place = g.patient_from_voxel({0, 0, static_cast<double>(slice)});
  e.text(0x0018, 0x0015, VR::CS, "WRIST");
  e.text(0x0018, 0x0050, VR::DS, decimal(g.spacing.z));
  e.text(0x0018, 0x0060, VR::DS, "120");
  e.text(0x0018, 0x0088, VR::DS, decimal(g.spacing.z));
  e.text(0x0018, 0x5100, VR::CS, "HFS");
  e.text(0x0020, 0x000d, VR::UI, s.study_uid);
  e.text(0x0020, 0x000e, VR::UI, s.series_uid);
  e.text(0x0020, 0x0010, VR::SH, "1");
  e.text(0x0020, 0x0011, VR::IS, "1");
  e.text(0x0020, 0x0012, VR::IS, "1");
  e.text(0x0020, 0x0013, VR::IS, std::to_string(slice + 1));
  e.text(0x0020, 0x0032, VR::DS, decimals({place.x, place.y, place.z}));
  e.text(0x0020, 0x0037, VR::DS, decimals({row.x, row.y, row.z, column.x, column.y, column.z}));
  e.text(0x0020, 0x0052, VR::UI, s.frame_uid);
  e.text(0x0020, 0x0060, VR::CS, s.description.side == Side::Left ? "L" : "R");
  e.text(0x0020, 0x1040, VR::LO, "");
  e.text(0x0028, 0x0030, VR::DS, decimals({g.spacing.y, g.spacing.x}));
}

void add_pixels(Elements& e, const Series& s, std::span<const std::int16_t> hu) {
  using VR = gdcm::VR;
  e.number(0x0028, 0x0002, 1);
  e.text(0x0028, 0x0004, VR::CS, "MONOCHROME2");
  e.number(0x0028, 0x0010, s.geometry.size[1]);
  e.number(0x0028, 0x0011, s.geometry.size[0]);
  e.number(0x0028, 0x0100, 16);
  e.number(0x0028, 0x0101, s.is_12_bit ? 12 : 16);
  e.number(0x0028, 0x0102, s.is_12_bit ? 11 : 15);
  e.number(0x0028, 0x0103, s.is_12_bit ? 0 : 1);
  e.text(0x0028, 0x1050, VR::DS, "400");
  e.text(0x0028, 0x1051, VR::DS, "1800");
  const int intercept = s.is_12_bit ? kInterceptHu : 0;
  e.text(0x0028, 0x1052, VR::DS, std::to_string(intercept));
  e.text(0x0028, 0x1053, VR::DS, "1");
  e.text(0x0028, 0x1054, VR::LO, "HU");
  std::vector<std::int16_t> stored(hu.size());
  std::transform(hu.begin(), hu.end(), stored.begin(),
                 [&](std::int16_t v) { return static_cast<std::int16_t>(v - intercept); });
  e.bytes(0x7fe0, 0x0010, VR::OW, stored.data(), stored.size() * sizeof(std::int16_t));
}

void write_slice(const fs::path& file,
                 const Series& series,
                 int slice,
                 std::span<const std::int16_t> hu) {
  // Into memory first: where the disk is full, GDCM as Debian builds it aborts or does not notice.
  std::ostringstream bytes;
  gdcm::Writer writer;
  writer.SetStream(bytes);
  gdcm::File& content = writer.GetFile();
  content.GetHeader().SetDataSetTransferSyntax(gdcm::TransferSyntax::ExplicitVRLittleEndian);
  Elements elements(content.GetDataSet());
  add_identity(elements, series, slice);
  add_geometry(elements, series, slice);
  add_pixels(elements, series, hu);
  const bool is_encoded = writer.Write();
  std::ofstream out(file, std::ios::binary);
  out << bytes.view();
  out.close();
  if (!is_encoded || !out) throw_cannot_write(file);
}

Series series_for(const GridView<const std::int16_t>& ct, const DicomDescription& description) {
  Series s{ct.geometry(), description, {}, {}, {}, 0, true};
  const auto [least, greatest] = std::minmax_element(ct.values().begin(), ct.values().end());
  s.is_12_bit = *least >= kInterceptHu && *greatest <= kGreatest12BitHu;
  StateHash hash;
  hash.add(description.seed);
  hash.add_bytes(std::as_bytes(ct.values()));
  s.study_uid = uid_from(hash.value() ^ 1);
  s.series_uid = uid_from(hash.value() ^ 2);
  s.frame_uid = uid_from(hash.value() ^ 3);
  s.instance_seed = hash.value() ^ 4;
  return s;
}

void check_writable_grid(const GridGeometry& g) {
  if (g.voxel_count() == 0 || g.size[0] > 65535 || g.size[1] > 65535 || g.size[2] > 9999) {
    throw InvalidInput("a DICOM series holds 1 to 9999 slices of at most 65535 x 65535 voxels");
  }
  if (g.direction.determinant() < 0) {
    throw InvalidInput("a DICOM series needs right-handed axes; reverse the order of the slices");
  }
}

}  // namespace

void write_dicom_series(const fs::path& folder,
                        const GridView<const std::int16_t>& ct,
                        const DicomDescription& description,
                        const Progress& progress) {
  gdcm::Trace::WarningOff();
  gdcm::Trace::ErrorOff();
  check_writable_grid(ct.geometry());
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw_cannot_write(folder);
  if (!fs::is_empty(folder)) {
    throw IoError(folder.string() +
                  ": is not empty; a series needs a folder of its own, so choose another");
  }
  const Series series = series_for(ct, description);
  const int slices = ct.geometry().size[2];
  const std::size_t slice_size = ct.values().size() / static_cast<std::size_t>(slices);
  for (int k = 0; k < slices; ++k) {
    std::array<char, 24> name{};
    std::snprintf(name.data(), name.size(), "IM_%04d.dcm", k + 1);
    write_slice(folder / name.data(), series, k,
                ct.values().subspan(static_cast<std::size_t>(k) * slice_size, slice_size));
    progress("writing", static_cast<double>(k + 1) / slices);
  }
}

}  // namespace carpus::case_io
