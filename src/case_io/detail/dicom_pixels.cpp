// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Plain and run-length coded pixels are unpacked here. Of JPEG, JPEG-LS and JPEG 2000 a library
// gets the compressed frame and a description made by us; it never sees the file's header.
#include "case_io/detail/dicom_pixels.hpp"

#include <gdcmDataElement.h>
#include <gdcmFragment.h>
#include <gdcmImage.h>
#include <gdcmSequenceOfFragments.h>
#include <gdcmTrace.h>

#include <cstdint>
#include <string>
#include <vector>

#include "image_formats/codestream_header.hpp"
#include "image_formats/rle_frame.hpp"

namespace carpus::case_io {
namespace {

using image_formats::ByteRange;
using image_formats::DicomHeader;
using image_formats::PixelCoding;
using image_formats::Refuser;

std::vector<std::byte> joined(std::span<const std::byte> data,
                              const std::vector<ByteRange>& pieces) {
  std::vector<std::byte> bytes;
  for (const ByteRange& piece : pieces) {
    const auto part =
        data.subspan(static_cast<std::size_t>(piece.begins), static_cast<std::size_t>(piece.bytes));
    bytes.insert(bytes.end(), part.begin(), part.end());
  }
  return bytes;
}

gdcm::TransferSyntax::TSType library_syntax(const std::string& uid) {
  return gdcm::TransferSyntax::GetTSType(uid.c_str());
}

std::vector<std::byte> decoded_by_library(const std::vector<std::byte>& frame,
                                          const DicomHeader& header,
                                          const Refuser& refuse) {
  gdcm::Trace::WarningOff();
  gdcm::Trace::ErrorOff();
  const gdcm::SmartPointer<gdcm::SequenceOfFragments> pieces = new gdcm::SequenceOfFragments;
  gdcm::Fragment piece;
  piece.SetByteValue(reinterpret_cast<const char*>(frame.data()),
                     static_cast<std::uint32_t>(frame.size()));
  pieces->AddFragment(piece);
  gdcm::DataElement pixels(gdcm::Tag(0x7fe0, 0x0010));
  pixels.SetVR(gdcm::VR::OB);
  pixels.SetValue(*pieces);
  gdcm::Image image;
  image.SetNumberOfDimensions(2);
  image.SetDimension(0, static_cast<unsigned>(header.columns));
  image.SetDimension(1, static_cast<unsigned>(header.rows));
  const gdcm::PixelFormat format(1, static_cast<unsigned short>(header.bits_allocated),
                                 static_cast<unsigned short>(header.bits_stored),
                                 static_cast<unsigned short>(header.high_bit),
                                 header.is_signed ? 1 : 0);
  image.SetPixelFormat(format);
  image.SetPhotometricInterpretation(gdcm::PhotometricInterpretation::MONOCHROME2);
  image.SetTransferSyntax(library_syntax(header.syntax.uid));
  image.SetDataElement(pixels);
  const auto cannot = [&] {
    refuse.damaged("a compressed frame", "not to be decoded", "though its header is right");
  };
  std::vector<std::byte> decoded(static_cast<std::size_t>(header.frame_bytes()));
  if (image.GetBufferLength() != decoded.size()) cannot();
  if (!image.GetBuffer(reinterpret_cast<char*>(decoded.data()))) cannot();
  const bool is_as_said =
      image.GetDimension(0) == static_cast<unsigned>(header.columns) &&
      image.GetDimension(1) == static_cast<unsigned>(header.rows) &&
      image.GetPixelFormat().GetBitsAllocated() == header.bits_allocated &&
      image.GetPixelFormat().GetPixelRepresentation() == format.GetPixelRepresentation();
  if (!is_as_said) cannot();
  return decoded;
}

class Pixels {
 public:
  Pixels(const DicomHeader& header, const Refuser& refuse) : header_(header), refuse_(refuse) {}

  /// What a pixel's stored bits mean. Bits above those that are said to be stored hold nothing, or
  /// the sign once more; anything else there (an overlay of old scanners, damage) is refused.
  [[nodiscard]] int value(std::uint32_t raw, bool is_from_library) const {
    const auto bits = static_cast<unsigned>(header_.bits_stored);
    const std::uint32_t used = (std::uint32_t{1} << bits) - 1;
    const std::uint32_t all =
        (std::uint32_t{1} << static_cast<unsigned>(header_.bits_allocated)) - 1;
    const bool is_negative = header_.is_signed && ((raw >> (bits - 1)) & 1U) != 0;
    const std::uint32_t above = raw & ~used & all;
    if (above != 0 && !(is_negative && above == (all & ~used)) && !is_from_library) {
      refuse_.damaged("a pixel", std::to_string(raw),
                      "but only " + std::to_string(bits) + " bits are said to be stored");
    }
    const auto low = static_cast<int>(raw & used);
    return is_negative ? low - static_cast<int>(used) - 1 : low;
  }

 private:
  const DicomHeader& header_;
  const Refuser& refuse_;
};

}  // namespace

std::uint64_t decoding_bytes(const DicomHeader& header) {
  // Decoders keep a picture in 32 bits a pixel, and JPEG 2000 its wavelets besides.
  constexpr std::uint64_t kBytesAPixel = 32;
  constexpr std::uint64_t kTables = std::uint64_t{64} << 20U;
  return kTables + kBytesAPixel * static_cast<std::uint64_t>(header.rows) *
                       static_cast<std::uint64_t>(header.columns);
}

void decode_dicom_frame(std::span<const std::byte> data,
                        const DicomHeader& header,
                        std::size_t frame,
                        std::span<std::int16_t> to,
                        ValueCount& count,
                        const Refuser& refuse) {
  const auto frame_bytes = static_cast<std::size_t>(header.frame_bytes());
  const bool is_plain = header.syntax.coding == PixelCoding::Plain;
  const bool is_rle = header.syntax.coding == PixelCoding::Rle;
  std::vector<std::byte> unpacked;
  std::span<const std::byte> pixels;
  if (is_plain) {
    const auto begins = static_cast<std::size_t>(header.pixels[0][0].begins) + frame * frame_bytes;
    pixels = data.subspan(begins, frame_bytes);
  } else {
    const std::vector<std::byte> packed = joined(data, header.pixels[frame]);
    if (is_rle) {
      unpacked.resize(frame_bytes);
      image_formats::unpack_rle(packed, header, unpacked, refuse);
    } else {
      image_formats::check_codestream(packed, header, refuse);
      unpacked = decoded_by_library(packed, header, refuse);
    }
    pixels = unpacked;
  }
  const Pixels values(header, refuse);
  const bool is_wide = header.bits_allocated == 16;
  // Of big endian only words come here (check_readable).
  const std::size_t swap = is_plain && header.syntax.encoding.is_big_endian ? 1 : 0;
  const image_formats::DicomFrame& scaling = header.frames[frame];
  for (std::size_t i = 0; i < to.size(); ++i) {
    const std::size_t at = is_wide ? 2 * i : i;
    std::uint32_t raw = std::to_integer<std::uint32_t>(pixels[at + (is_wide ? swap : 0)]);
    if (is_wide) raw |= std::to_integer<std::uint32_t>(pixels[at + 1 - swap]) << 8U;
    const int stored = values.value(raw, !is_plain && !is_rle);
    to[i] = converted<std::int16_t>(stored * scaling.slope + scaling.intercept, count);
  }
}

}  // namespace carpus::case_io
