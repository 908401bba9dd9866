// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Writing volumes: one file of a standard format, or a DICOM CT series for programs that want one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "anatomy/bone_id.hpp"
#include "core/progress.hpp"
#include "geometry/grid.hpp"

namespace carpus::case_io {

/// @throws InvalidInput where no volume can be written to a file of this name.
void require_volume_name(const std::filesystem::path& file);

/// Writes a volume as its ending says: .nii, .nii.gz, .nrrd (raw) or .mha (raw). T is int16_t,
/// uint8_t or float. The file is read back and compared, because the NIfTI library does not report
/// a full disk.
/// @param description  what the file says about itself wherever it is copied (read_description):
/// NIfTI's `descrip`, which holds 79 bytes, or a field of the header; none when empty.
/// @throws IoError where the file cannot be written whole; what is there then is not to be used.
template <typename T>
void write_volume(const std::filesystem::path& file,
                  const GridView<const T>& volume,
                  const std::string& description = {});

/// What a DICOM series says about itself. Never holds a person's data: this writer exists for
/// simulated scans, and says so in every file.
struct DicomDescription {
  std::string series_description = "simulated wrist";
  Side side = Side::Left;
  std::uint64_t seed = 0;  ///< UIDs are made from it: the same seed and grid give the same series
};

/// Writes a CT series of simulated data, one axial file a slice (IM_0001.dcm ...), explicit VR
/// little endian, PatientName "Simulated^Phantom", UIDs under 2.25 (UUID-derived, [dicom_ps3_5]
/// B.2). Values between -1024 and 3071 HU are stored in 12 bits with intercept -1024 as scanners
/// do, others as signed 16 bits. `folder` is made where missing and must hold no other file.
/// @throws IoError where the folder is not empty or a file cannot be written; InvalidInput where
/// the grid has more than 9999 slices or a side over 65535 voxels.
void write_dicom_series(const std::filesystem::path& folder,
                        const GridView<const std::int16_t>& ct,
                        const DicomDescription& description,
                        const Progress& progress = no_progress);

}  // namespace carpus::case_io
