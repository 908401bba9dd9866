// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A label volume as DICOM Segmentation, for archives and viewers that want nothing else.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "geometry/grid.hpp"

namespace carpus::case_io {

struct SegmentName {
  std::uint8_t label = 0;
  std::string name;  ///< "capitate"
};

/// What the object says about itself. Never a person's data: a case holds none.
struct SegmentationDescription {
  std::string pseudonym;  ///< as the patient's name and ID
  bool simulated = false;
  std::string made_by;  ///< program and version
};

/// Writes one binary segment a name whose label occurs, a frame for each slice that shows it
/// [dicom_ps3_3 A.51]. UIDs are made from the content: the same volume gives the same file.
/// @throws InvalidInput where no label occurs, an axis is reversed, or the grid is too large for
/// the format; IoError where the file cannot be written.
void write_dicom_segmentation(const std::filesystem::path& file,
                              const GridView<const std::uint8_t>& labels,
                              const std::vector<SegmentName>& names,
                              const SegmentationDescription& description);

}  // namespace carpus::case_io
