// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// DICOM series in a folder: headers scanned without pixels, slices sorted by place, gaps found.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "case_io/detail/volume_file.hpp"
#include "case_io/read_volume.hpp"
#include "geometry/grid.hpp"
#include "image_formats/dicom_header.hpp"

namespace carpus::case_io {

/// One DICOM image file.
struct DicomSlice {
  std::filesystem::path file;
  std::uint64_t file_bytes = 0;
  std::string class_uid;             ///< what kind of object it is
  std::uint64_t data_begins = 0;     ///< of a deflated data set, in the file
  std::uint64_t unpacked_bytes = 0;  ///< of a deflated data set; else 0
  image_formats::DicomHeader header;
};

/// Images of one series, in the order of their files' names.
struct DicomSeries {
  SeriesSummary summary;
  std::vector<DicomSlice> slices;
  std::vector<DicomSlice> strays;  ///< of other series, too short to be volumes, passed over
};

/// All image series under `folder`, most slices first, then by UID. Files that are no DICOM image
/// (reports, DICOMDIR, text) are passed over.
/// @throws IoError naming a DICOM file whose header is cut short or damaged.
[[nodiscard]] std::vector<DicomSeries> scan_dicom(const std::filesystem::path& folder);

/// Whether the file opens like DICOM ("DICM" after the preamble).
[[nodiscard]] bool looks_like_dicom(const std::filesystem::path& file);

/// Sorts the slices by place and reads them in a child process.
/// @throws InvalidInput on missing, doubled, tilted or unlike slices; IoError on damaged ones.
[[nodiscard]] Grid<std::int16_t> read_series(DicomSeries series,
                                             const Progress& progress,
                                             ReadingNotes& notes);

}  // namespace carpus::case_io
