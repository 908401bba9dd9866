// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Compressed bytes to exactly as many as a header promises: no fewer, no more, checksums enforced.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "image_formats/byte_source.hpp"
#include "image_formats/refusal.hpp"
#include "image_formats/volume_header.hpp"

namespace carpus::case_io {

/// Unpacks `stored` to its end, block by block. Gzip may hold several members, as parallel packers
/// write them.
/// @param total  bytes that must come out.
/// @throws IoError where the stream is damaged, cut short, longer, or followed by anything.
void unpack(std::span<const std::byte> stored,
            image_formats::Packing packing,
            std::uint64_t total,
            const image_formats::Refuser& refuse,
            const std::function<void(std::span<const std::byte>)>& take);

/// The first bytes of a gzip file; fewer where it holds no more.
/// @throws IoError where it is damaged.
[[nodiscard]] std::vector<std::byte> unpack_front(image_formats::ByteSource& stored,
                                                  std::size_t bytes,
                                                  const image_formats::Refuser& refuse);

/// A raw deflate stream (the data set of a deflated DICOM file), followed by a byte of padding at
/// most, or by the checksum and length that some writers leave, which must then be right.
/// @throws IoError as unpack, and where more than `most` bytes come out.
[[nodiscard]] std::vector<std::byte> unpack_deflated(std::span<const std::byte> stored,
                                                     std::uint64_t most,
                                                     const image_formats::Refuser& refuse);

/// Refuses before anything is unpacked: deflate packs at most 1032 to 1, and never makes anything
/// much longer. @throws IoError
void check_packed_size(std::uint64_t stored,
                       std::uint64_t total,
                       const image_formats::Refuser& refuse);

}  // namespace carpus::case_io
