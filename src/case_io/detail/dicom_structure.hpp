// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether a DICOM file is all there, before GDCM opens it: its Debian build aborts the program on a
// header that is cut short and fills missing pixels with zeros without a word.
#pragma once

#include <filesystem>

namespace carpus::case_io {

enum class DicomStructure {
  Whole,     ///< every element ends within the file
  CutShort,  ///< an element claims more bytes than there are, or the file ends inside one
  Damaged,   ///< a value representation that does not exist
  Unknown,   ///< stored so that it is not walked here (big endian, deflated, scanners' oddities)
};

struct DicomCheck {
  DicomStructure structure = DicomStructure::Unknown;
  bool has_pixels = false;  ///< the walk reached PixelData
};

/// Walks the elements of a file that has the DICM mark; reads headers only, seeks over values.
/// Cost: O(elements). Source: [dicom_ps3_5] chapter 7 and annex A.4.
[[nodiscard]] DicomCheck check_dicom_structure(const std::filesystem::path& file);

}  // namespace carpus::case_io
