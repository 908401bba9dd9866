// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What one DICOM file says about its image, checked against the bytes that there are. No library
// sees a header; one is given the compressed frames alone.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geometry/vec3.hpp"
#include "image_formats/byte_source.hpp"
#include "image_formats/dicom_elements.hpp"

namespace carpus::image_formats {

/// How the pixels are stored [dicom_ps3_5] chapter 10.
enum class PixelCoding { Plain, Rle, Jpeg, JpegLs, Jpeg2000, Unknown };

struct TransferSyntax {
  std::string uid;
  DicomEncoding encoding;
  PixelCoding coding = PixelCoding::Unknown;
  bool is_deflated = false;  ///< all that follows the file's own group
  bool is_lossy = false;
};

/// The file's own group 0002.
struct DicomFront {
  TransferSyntax syntax;
  std::string class_uid;  ///< what kind of object it is
  std::uint64_t data_begins = 0;
};

/// Whether the file opens like DICOM ("DICM" after the preamble).
[[nodiscard]] bool has_dicom_mark(ByteSource& bytes);

/// @throws IoError where it is damaged.
[[nodiscard]] DicomFront parse_dicom_front(ByteSource& bytes, const Refuser& refuse);

/// Place and scaling of one frame; of most files the only one.
struct DicomFrame {
  bool has_place = false;  ///< position, orientation and spacing were all there
  Vec3 position{};         ///< centre of the first voxel, LPS [mm]
  Vec3 row{};              ///< direction of increasing column, LPS
  Vec3 column{};           ///< direction of increasing row, LPS
  Vec3 spacing{};          ///< x: between columns, y: between rows [mm]
  bool has_rescale = false;
  double slope = 1;
  double intercept = 0;
};

struct DicomHeader {
  TransferSyntax syntax;
  std::string series_uid;
  std::string series_description;
  std::string modality;
  std::string instance_uid;
  std::string frame_of_reference_uid;

  bool is_image = false;  ///< it has rows and columns
  int rows = 0;
  int columns = 0;
  int samples = 1;
  int bits_allocated = 0;
  int bits_stored = 0;
  int high_bit = 0;
  bool is_signed = false;
  bool has_float_pixels = false;  ///< a map of parameters, no scan
  std::string photometric;
  std::vector<DicomFrame> frames;

  /// In the data set (of a deflated one: unpacked). Plain: one range of all frames. Otherwise the
  /// pieces of each frame.
  std::vector<std::vector<ByteRange>> pixels;

  [[nodiscard]] std::uint64_t frame_bytes() const noexcept {
    return static_cast<std::uint64_t>(rows) * static_cast<std::uint64_t>(columns) *
           static_cast<std::uint64_t>(bits_allocated / 8);
  }
};

/// Reads the data set from `begins` to the end of `bytes`. Of an image, the bytes of its pixels are
/// compared with what rows, columns, bits, samples and frames need.
/// @throws IoError where an element claims more than there is, something stands where it may not,
/// or the numbers contradict each other.
[[nodiscard]] DicomHeader parse_dicom(ByteSource& bytes,
                                      std::uint64_t begins,
                                      const TransferSyntax& syntax,
                                      const Refuser& refuse);

/// Whether the frames can be a slice of a CT: one sample, 8 or 16 bits, MONOCHROME2, a coding that
/// is read here. Not asked of images that are passed over.
/// @throws InvalidInput naming the field and what to do.
void check_readable(const DicomHeader& header, const Refuser& refuse);

}  // namespace carpus::image_formats
