// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A whole file: its front, its elements, and each compressed or run-length coded frame.
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "image_formats/codestream_header.hpp"
#include "image_formats/dicom_header.hpp"
#include "image_formats/rle_frame.hpp"
#include "scan_headers.hpp"

namespace {

using namespace carpus;
using image_formats::PixelCoding;

/// Frames larger than this are not unpacked here, for speed.
constexpr std::uint64_t kLargestFrame = 1 << 20;

void unpack_frames(std::span<const std::byte> bytes,
                   const image_formats::DicomHeader& header,
                   const image_formats::Refuser& refuse) {
  for (const std::vector<image_formats::ByteRange>& pieces : header.pixels) {
    std::vector<std::byte> frame;
    for (const image_formats::ByteRange& piece : pieces) {
      fuzz::require(piece.begins <= bytes.size() && piece.bytes <= bytes.size() - piece.begins);
      const auto part = bytes.subspan(piece.begins, piece.bytes);
      frame.insert(frame.end(), part.begin(), part.end());
    }
    if (header.syntax.coding == PixelCoding::Plain) {
      fuzz::require(frame.size() == header.frame_bytes() * header.frames.size());
    } else if (header.syntax.coding != PixelCoding::Rle) {
      image_formats::check_codestream(frame, header, refuse);
    } else if (header.frame_bytes() <= kLargestFrame) {
      std::vector<std::byte> to(header.frame_bytes());
      image_formats::unpack_rle(frame, header, to, refuse);
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  image_formats::MemoryBytes source(bytes);
  if (!image_formats::has_dicom_mark(source)) return 0;
  fuzz::accepts([&](const image_formats::Refuser& refuse) {
    const image_formats::DicomFront front = image_formats::parse_dicom_front(source, refuse);
    const image_formats::DicomHeader header =
        image_formats::parse_dicom(source, front.data_begins, front.syntax, refuse);
    if (!header.is_image) return;
    image_formats::check_readable(header, refuse);
    unpack_frames(bytes, header, refuse);
  });
  return 0;
}
