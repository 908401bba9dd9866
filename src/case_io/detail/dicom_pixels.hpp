// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The pixels of one DICOM frame as HU. Runs in a child process only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "case_io/detail/voxel_values.hpp"
#include "image_formats/dicom_header.hpp"

namespace carpus::case_io {

/// Decodes frame `frame` and applies its slope and intercept.
/// @param data  the bytes that header.pixels counts in.
/// @param to  rows x columns.
/// @throws IoError naming what does not fit; whatever GDCM's decoders do on damaged frames.
void decode_dicom_frame(std::span<const std::byte> data,
                        const image_formats::DicomHeader& header,
                        std::size_t frame,
                        std::span<std::int16_t> to,
                        ValueCount& count,
                        const image_formats::Refuser& refuse);

/// Bytes of memory that decoding one frame may take.
[[nodiscard]] std::uint64_t decoding_bytes(const image_formats::DicomHeader& header);

}  // namespace carpus::case_io
