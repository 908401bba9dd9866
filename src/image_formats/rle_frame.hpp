// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One frame of DICOM's run-length coding.
#pragma once

#include <cstddef>
#include <span>

#include "image_formats/dicom_header.hpp"

namespace carpus::image_formats {

/// Unpacks a frame of 8 or 16 bits a pixel into little-endian bytes. Every segment must give
/// exactly one byte a pixel and no run may pass its end. Source: [dicom_ps3_5] annex G.
/// @param to  header.frame_bytes().
/// @throws IoError otherwise.
void unpack_rle(std::span<const std::byte> frame,
                const DicomHeader& header,
                std::span<std::byte> to,
                const Refuser& refuse);

}  // namespace carpus::image_formats
