// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The data set is read by DCMTK; frames are laid on here, because foreign objects are often not
// what DCMTK's own segmentation class accepts, and every number in them is checked.
#include "case_io/detail/segmentation_object.hpp"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcistrmb.h>
#include <dcmtk/dcmdata/dctk.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "image_formats/dicom_elements.hpp"
#include "image_formats/dicom_header.hpp"

namespace carpus::case_io {
namespace {

/// A pixel's place may be off the grid by this part of a voxel: formats round differently.
constexpr double kSamePlace = 0.05;

class Reader {
 public:
  Reader(DcmDataset& data, const GridGeometry& onto, std::string file)
      : data_(data), onto_(onto), file_(std::move(file)) {}

  void lay_on(std::span<std::uint8_t> labels, SegmentationObject& found) {
    check_kind();
    read_names(found);
    rows_ = whole(DCM_Rows);
    columns_ = whole(DCM_Columns);
    frames_ = static_cast<std::size_t>(frame_count());
    const Uint8* bits = pixel_bits();
    for (std::size_t f = 0; f < frames_; ++f) {
      lay_frame(bits, f, labels, found);
    }
  }

 private:
  [[noreturn]] void damaged(const std::string& what) const {
    throw IoError(file_ + ": " + what + "; export the segmentation anew");
  }
  [[noreturn]] void unfit(const std::string& what) const {
    throw InvalidInput(file_ + ": " + what);
  }

  std::size_t whole(const DcmTagKey& tag) const {
    Uint16 value = 0;
    if (data_.findAndGetUint16(tag, value).bad() || value == 0) damaged("has no rows or columns");
    return value;
  }

  void check_kind() const {
    OFString kind;
    if (data_.findAndGetOFString(DCM_SOPClassUID, kind).bad() || kind != UID_SegmentationStorage) {
      damaged("is no DICOM segmentation");
    }
    OFString type;
    if (data_.findAndGetOFString(DCM_SegmentationType, type).bad()) damaged("has no type");
    if (type != "BINARY") unfit("is a fractional segmentation; export a binary one");
    Uint16 allocated = 0;
    if (data_.findAndGetUint16(DCM_BitsAllocated, allocated).bad() || allocated != 1) {
      damaged("has not one bit a pixel");
    }
  }

  void read_names(SegmentationObject& found) const {
    DcmSequenceOfItems* segments = nullptr;
    if (data_.findAndGetSequence(DCM_SegmentSequence, segments).bad() || segments == nullptr) {
      damaged("names no segment");
    }
    if (segments->card() == 0) damaged("names no segment");
    if (segments->card() > kMostSegments) unfit("has more than 255 segments");
    std::array<bool, kMostSegments + 1> described{};
    for (unsigned long i = 0; i < segments->card(); ++i) {
      Uint16 number = 0;
      OFString name;
      DcmItem* item = segments->getItem(i);
      if (item == nullptr || item->findAndGetUint16(DCM_SegmentNumber, number).bad() ||
          number == 0 || number > kMostSegments) {
        damaged("has a segment without a number");
      }
      if (described[number]) damaged("has two segments of number " + std::to_string(number));
      described[number] = true;
      (void)item->findAndGetOFString(DCM_SegmentLabel, name);
      auto& to = found.names[number - std::size_t{1}];
      to = {};
      for (std::size_t c = 0; c + 1 < to.size() && c < name.size(); ++c) to[c] = name[c];
      found.segments = std::max<std::uint64_t>(found.segments, number);
    }
  }

  std::int64_t frame_count() const {
    Sint32 frames = 0;
    if (data_.findAndGetSint32(DCM_NumberOfFrames, frames).bad() || frames < 1) {
      damaged("has no frames");
    }
    DcmSequenceOfItems* places = nullptr;
    if (data_.findAndGetSequence(DCM_PerFrameFunctionalGroupsSequence, places).bad() ||
        places == nullptr || places->card() != static_cast<unsigned long>(frames)) {
      damaged("does not describe as many frames as it says it has");
    }
    return frames;
  }

  const Uint8* pixel_bits() const {
    const Uint8* bits = nullptr;
    unsigned long length = 0;
    if (data_.findAndGetUint8Array(DCM_PixelData, bits, &length).bad() || bits == nullptr) {
      damaged("has no pixels, or packed ones that are not read");
    }
    const std::uint64_t needed = (static_cast<std::uint64_t>(frames_) * rows_ * columns_ + 7) / 8;
    if (length != needed && length != needed + needed % 2) {
      damaged("has " + std::to_string(length) + " bytes of pixels where its frames have " +
              std::to_string(needed));
    }
    return bits;
  }

  /// The item of a functional group: the frame's own, else the shared one.
  DcmItem* group(std::size_t frame, const DcmTagKey& tag) const {
    DcmItem* own = nullptr;
    if (data_
            .findAndGetSequenceItem(DCM_PerFrameFunctionalGroupsSequence, own,
                                    static_cast<long>(frame))
            .bad() ||
        own == nullptr) {
      damaged("does not say where frame " + std::to_string(frame + 1) + " lies");
    }
    DcmItem* item = nullptr;
    if (own->findAndGetSequenceItem(tag, item, 0).good() && item != nullptr) return item;
    DcmItem* shared = nullptr;
    if (data_.findAndGetSequenceItem(DCM_SharedFunctionalGroupsSequence, shared, 0).bad() ||
        shared == nullptr || shared->findAndGetSequenceItem(tag, item, 0).bad() ||
        item == nullptr) {
      damaged("does not say where frame " + std::to_string(frame + 1) + " lies");
    }
    return item;
  }

  double number(DcmItem& item, const DcmTagKey& tag, unsigned long at) const {
    Float64 value = 0;
    if (item.findAndGetFloat64(tag, value, at).bad() || !std::isfinite(value) ||
        std::abs(value) > 1e6) {
      damaged("has a place that is no number");
    }
    return value;
  }

  Vec3 vector(DcmItem& item, const DcmTagKey& tag, unsigned long from) const {
    return {number(item, tag, from), number(item, tag, from + 1), number(item, tag, from + 2)};
  }

  /// A step to the next pixel, in voxels of the scan: along one of its axes.
  VoxelIndex step_of(const Vec3& mm, std::size_t count) const {
    const Vec3 zero = onto_.voxel_from_patient({0, 0, 0});
    const Vec3 step = onto_.voxel_from_patient(mm) - zero;
    const Vec3 rounded{std::round(step.x), std::round(step.y), std::round(step.z)};
    const double drift = length(step - rounded) * static_cast<double>(count);
    if (std::abs(rounded.x) + std::abs(rounded.y) + std::abs(rounded.z) != 1 ||
        drift > 2 * kSamePlace) {
      off_grid();
    }
    return {static_cast<int>(rounded.x), static_cast<int>(rounded.y), static_cast<int>(rounded.z)};
  }

  [[noreturn]] void off_grid() const {
    unfit(
        "does not lie on the scan's grid; give the scan that it was drawn on, or export it with "
        "that scan as the reference");
  }

  void lay_frame(const Uint8* bits,
                 std::size_t frame,
                 std::span<std::uint8_t> labels,
                 SegmentationObject& found) const {
    DcmItem* identification = group(frame, DCM_SegmentIdentificationSequence);
    Uint16 segment = 0;
    if (identification->findAndGetUint16(DCM_ReferencedSegmentNumber, segment).bad() ||
        segment == 0 || segment > found.segments) {
      damaged("has a frame of no segment");
    }
    DcmItem* plane = group(frame, DCM_PlanePositionSequence);
    DcmItem* orientation = group(frame, DCM_PlaneOrientationSequence);
    DcmItem* measures = group(frame, DCM_PixelMeasuresSequence);
    const double row_mm = number(*measures, DCM_PixelSpacing, 0);
    const double column_mm = number(*measures, DCM_PixelSpacing, 1);
    const VoxelIndex right =
        step_of(vector(*orientation, DCM_ImageOrientationPatient, 0) * column_mm, columns_);
    const VoxelIndex down =
        step_of(vector(*orientation, DCM_ImageOrientationPatient, 3) * row_mm, rows_);
    if (right.x * down.x + right.y * down.y + right.z * down.z != 0) {
      damaged("has rows along its columns");
    }
    const Vec3 place = onto_.voxel_from_patient(vector(*plane, DCM_ImagePositionPatient, 0));
    const Vec3 first{std::round(place.x), std::round(place.y), std::round(place.z)};
    if (!(length(place - first) < 2 * kSamePlace) || !(length(first) < 1e6)) off_grid();
    const VoxelIndex begin{static_cast<int>(first.x), static_cast<int>(first.y),
                           static_cast<int>(first.z)};
    std::size_t bit = frame * rows_ * columns_;
    for (int r = 0; r < static_cast<int>(rows_); ++r) {
      for (int c = 0; c < static_cast<int>(columns_); ++c, ++bit) {
        if (((bits[bit / 8] >> (bit % 8)) & 1U) == 0) continue;
        const VoxelIndex v{begin.x + c * right.x + r * down.x, begin.y + c * right.y + r * down.y,
                           begin.z + c * right.z + r * down.z};
        if (!onto_.contains(v)) unfit("shows bone outside the scan; give the scan it belongs to");
        std::uint8_t& label = labels[onto_.offset_of(v)];
        if (label == 0) {
          label = static_cast<std::uint8_t>(segment);
        } else if (label != segment) {
          ++found.disputed;
        }
      }
    }
  }

  DcmDataset& data_;
  const GridGeometry& onto_;
  std::string file_;
  std::size_t rows_ = 0;
  std::size_t columns_ = 0;
  std::size_t frames_ = 0;
};

}  // namespace

void check_segmentation_structure(const std::string& text, const std::string& file) {
  const image_formats::Refuser refuse(file);
  image_formats::MemoryBytes bytes(std::as_bytes(std::span(text)));
  if (!image_formats::has_dicom_mark(bytes)) {
    throw IoError(file + ": is no DICOM file, or a damaged one; export the segmentation anew");
  }
  const image_formats::DicomFront front = image_formats::parse_dicom_front(bytes, refuse);
  if (front.syntax.is_deflated || front.syntax.coding != image_formats::PixelCoding::Plain) {
    refuse.unusable("its transfer syntax", front.syntax.uid, "export it uncompressed");
  }
  image_formats::DicomElements(bytes, refuse, front.syntax.encoding)
      .walk(front.data_begins, bytes.size(), [](const image_formats::DicomElement&) {});
}

void lay_segmentation_on(const std::string& bytes,
                         const std::string& file,
                         const GridGeometry& onto,
                         std::span<std::uint8_t> labels,
                         SegmentationObject& found) {
  DcmInputBufferStream stream;
  stream.setBuffer(bytes.data(), static_cast<offile_off_t>(bytes.size()));
  stream.setEos();
  DcmFileFormat format;
  format.transferInit();
  const OFCondition read = format.read(stream);
  format.transferEnd();
  if (read.bad()) throw IoError(file + ": is no DICOM file, or a damaged one");
  Reader(*format.getDataset(), onto, file).lay_on(labels, found);
}

}  // namespace carpus::case_io
