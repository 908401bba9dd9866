// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a compressed frame says about itself, before a library decodes it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "image_formats/dicom_header.hpp"

namespace carpus::image_formats {

struct CodestreamHeader {
  std::uint32_t rows = 0;
  std::uint32_t columns = 0;
  int components = 0;
  int bits = 0;                   ///< of one sample
  std::optional<bool> is_signed;  ///< JPEG does not say
};

/// Reads JPEG (lossless too), JPEG-LS and JPEG 2000 up to the size of the picture, and looks for
/// the mark that ends it. @throws IoError where either is not there.
[[nodiscard]] CodestreamHeader parse_codestream(std::span<const std::byte> bytes,
                                                PixelCoding coding,
                                                const Refuser& refuse);

/// Compares a frame's own words with what its DICOM header says.
/// @throws IoError where they differ.
void check_codestream(std::span<const std::byte> bytes,
                      const DicomHeader& header,
                      const Refuser& refuse);

}  // namespace carpus::image_formats
