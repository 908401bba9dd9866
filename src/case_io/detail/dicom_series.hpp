// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// DICOM series in a folder: headers scanned without pixels, slices sorted by place, gaps found.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "case_io/detail/itk_image.hpp"
#include "case_io/read_volume.hpp"
#include "geometry/grid.hpp"

namespace carpus::case_io {

/// What the header of one DICOM image says.
struct DicomSlice {
  std::filesystem::path file;
  std::string series_uid;
  std::string series_description;
  std::string modality;
  std::string instance_uid;
  int columns = 0;
  int rows = 0;
  int frames = 1;
  Vec3 position{};         ///< centre of the first voxel, LPS [mm]
  Vec3 row{};              ///< direction of increasing column, LPS
  Vec3 column{};           ///< direction of increasing row, LPS
  Vec3 spacing{};          ///< x: between columns, y: between rows [mm]
  bool has_place = false;  ///< position, orientation and spacing were all there
};

/// Images of one series, in the order of their files' names.
struct DicomSeries {
  SeriesSummary summary;
  std::vector<DicomSlice> slices;
};

/// All image series under `folder`, most slices first, then by UID. Files that are no DICOM image
/// (reports, DICOMDIR, text) are passed over.
/// @throws IoError naming a DICOM file whose header is cut short or cannot be read.
[[nodiscard]] std::vector<DicomSeries> scan_dicom(const std::filesystem::path& folder);

/// Whether the file opens like DICOM ("DICM" after the preamble).
[[nodiscard]] bool looks_like_dicom(const std::filesystem::path& file);

/// Sorts the slices by place and reads them.
/// @throws InvalidInput on missing, doubled, tilted or unlike slices; IoError on damaged ones.
[[nodiscard]] Grid<std::int16_t> read_series(DicomSeries series,
                                             const Progress& progress,
                                             ValueCount& count);

}  // namespace carpus::case_io
