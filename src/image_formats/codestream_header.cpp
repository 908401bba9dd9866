// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// JPEG and JPEG-LS [itu_t81] B.1: marker segments FF xx, length, content, up to the frame header.
// JPEG 2000 [itu_t800] A.5: FF4F, then SIZ. All three end with FFD9.
#include "image_formats/codestream_header.hpp"

#include <string>

namespace carpus::image_formats {
namespace {

class Reader {
 public:
  Reader(std::span<const std::byte> bytes, const Refuser& refuse)
      : bytes_(bytes), refuse_(refuse) {}

  [[nodiscard]] std::uint32_t at(std::size_t place, std::size_t count) const {
    if (place > bytes_.size() || bytes_.size() - place < count) {
      refuse_.damaged("a compressed frame", "cut short", "its header is not all there");
    }
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < count; ++i) {
      value = value << 8U | std::to_integer<std::uint32_t>(bytes_[place + i]);
    }
    return value;
  }

  void check_end() const {
    std::size_t size = bytes_.size();
    const bool is_ended = size >= 2 && at(size - 2, 2) == 0xFFD9U;
    // Padding to an even length: zeros, or JPEG's own fill byte.
    const bool is_padded =
        size >= 3 && (bytes_[size - 1] == std::byte{0} || bytes_[size - 1] == std::byte{0xFF});
    if (!is_ended && is_padded) --size;
    if (size < 2 || at(size - 2, 2) != 0xFFD9U) {
      refuse_.damaged("a compressed frame", "without its end", "so that it is cut short");
    }
  }

  [[nodiscard]] CodestreamHeader jpeg(PixelCoding coding) const {
    require(at(0, 2) == 0xFFD8U);
    for (std::size_t place = 2;;) {
      const std::uint32_t marker = at(place, 2);
      require(marker >= 0xFFC0U && marker != 0xFFD8U && marker != 0xFFD9U && marker != 0xFFDAU);
      const std::uint32_t length = at(place + 2, 2);
      require(length >= 2);
      const bool is_frame = coding == PixelCoding::JpegLs
                                ? marker == 0xFFF7U
                                : marker <= 0xFFC3U;  // baseline, extended, progressive, lossless
      if (is_frame) {
        CodestreamHeader header;
        header.bits = static_cast<int>(at(place + 4, 1));
        header.rows = at(place + 5, 2);
        header.columns = at(place + 7, 2);
        header.components = static_cast<int>(at(place + 9, 1));
        return header;
      }
      place += 2 + length;
    }
  }

  [[nodiscard]] CodestreamHeader jpeg2000() const {
    require(at(0, 4) == 0xFF4FFF51U);
    CodestreamHeader header;
    const std::uint32_t left = at(16, 4);
    const std::uint32_t top = at(20, 4);
    require(at(8, 4) > left && at(12, 4) > top);
    header.columns = at(8, 4) - left;
    header.rows = at(12, 4) - top;
    header.components = static_cast<int>(at(40, 2));
    const std::uint32_t depth = at(42, 1);
    header.bits = static_cast<int>(depth & 0x7FU) + 1;
    header.is_signed = (depth & 0x80U) != 0;
    require(at(43, 2) == 0x0101U);  // one sample a pixel
    return header;
  }

 private:
  void require(bool holds) const {
    if (holds) return;
    refuse_.damaged("a compressed frame", "not of the kind that its transfer syntax says",
                    "its header is another");
  }

  std::span<const std::byte> bytes_;
  const Refuser& refuse_;
};

}  // namespace

CodestreamHeader parse_codestream(std::span<const std::byte> bytes,
                                  PixelCoding coding,
                                  const Refuser& refuse) {
  const Reader reader(bytes, refuse);
  const CodestreamHeader header =
      coding == PixelCoding::Jpeg2000 ? reader.jpeg2000() : reader.jpeg(coding);
  reader.check_end();
  return header;
}

void check_codestream(std::span<const std::byte> bytes,
                      const DicomHeader& header,
                      const Refuser& refuse) {
  const CodestreamHeader own = parse_codestream(bytes, header.syntax.coding, refuse);
  const std::string said = std::to_string(own.rows) + " rows x " + std::to_string(own.columns) +
                           " columns, " + std::to_string(own.bits) + " bits, " +
                           std::to_string(own.components) + " components";
  if (own.rows != static_cast<std::uint32_t>(header.rows) ||
      own.columns != static_cast<std::uint32_t>(header.columns) || own.components != 1 ||
      own.bits < 2 || own.bits > header.bits_allocated ||
      (header.is_signed && own.bits < header.bits_stored) ||  // where would the sign be
      (own.is_signed && *own.is_signed != header.is_signed)) {
    refuse.damaged("a compressed frame", said,
                   "but its DICOM header says " + std::to_string(header.rows) + " x " +
                       std::to_string(header.columns) + ", " + std::to_string(header.bits_stored) +
                       " of " + std::to_string(header.bits_allocated) + " bits, " +
                       (header.is_signed ? "signed" : "unsigned"));
  }
}

}  // namespace carpus::image_formats
