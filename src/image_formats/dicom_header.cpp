// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "image_formats/dicom_header.hpp"

#include <array>
#include <map>
#include <string_view>

#include "image_formats/header_text.hpp"

namespace carpus::image_formats {
namespace {

constexpr std::uint64_t kPreambleBytes = 132;
/// More frames or pieces than any volume has.
constexpr std::int64_t kMostFrames = 65535;

constexpr std::uint32_t kMediaClassUid = 0x00020002U;
constexpr std::uint32_t kTransferSyntax = 0x00020010U;
constexpr std::uint32_t kInstanceUid = 0x00080018U;
constexpr std::uint32_t kModality = 0x00080060U;
constexpr std::uint32_t kSeriesDescription = 0x0008103EU;
constexpr std::uint32_t kSeriesUid = 0x0020000EU;
constexpr std::uint32_t kPosition = 0x00200032U;
constexpr std::uint32_t kOrientation = 0x00200037U;
constexpr std::uint32_t kFrameOfReference = 0x00200052U;
constexpr std::uint32_t kPlanePositionSequence = 0x00209113U;
constexpr std::uint32_t kPlaneOrientationSequence = 0x00209116U;
constexpr std::uint32_t kSamples = 0x00280002U;
constexpr std::uint32_t kPhotometric = 0x00280004U;
constexpr std::uint32_t kNumberOfFrames = 0x00280008U;
constexpr std::uint32_t kRows = 0x00280010U;
constexpr std::uint32_t kColumns = 0x00280011U;
constexpr std::uint32_t kPixelSpacing = 0x00280030U;
constexpr std::uint32_t kBitsAllocated = 0x00280100U;
constexpr std::uint32_t kBitsStored = 0x00280101U;
constexpr std::uint32_t kHighBit = 0x00280102U;
constexpr std::uint32_t kPixelRepresentation = 0x00280103U;
constexpr std::uint32_t kIntercept = 0x00281052U;
constexpr std::uint32_t kSlope = 0x00281053U;
constexpr std::uint32_t kPixelMeasuresSequence = 0x00289110U;
constexpr std::uint32_t kValueTransformationSequence = 0x00289145U;
constexpr std::uint32_t kSharedGroups = 0x52009229U;
constexpr std::uint32_t kPerFrameGroups = 0x52009230U;
constexpr std::uint32_t kFloatPixelData = 0x7FE00008U;
constexpr std::uint32_t kDoublePixelData = 0x7FE00009U;
constexpr std::uint32_t kPixelData = 0x7FE00010U;

/// Numbers of a backslash-separated value; empty where one is not a number.
std::vector<double> decimals(std::string_view value) {
  std::vector<double> numbers;
  for (std::size_t begin = 0; begin <= value.size();) {
    const std::size_t end = std::min(value.find('\\', begin), value.size());
    const auto number = number_of(trimmed(value.substr(begin, end - begin)));
    if (!number) return {};
    numbers.push_back(*number);
    begin = end + 1;
  }
  return numbers;
}

/// What says where a frame lies and what its values mean; texts as they stand.
struct FrameFields {
  std::map<std::uint32_t, std::string> texts;

  static bool is_one(std::uint32_t tag) {
    return tag == kPosition || tag == kOrientation || tag == kPixelSpacing || tag == kIntercept ||
           tag == kSlope;
  }
  static bool is_macro(std::uint32_t tag) {
    return tag == kPlanePositionSequence || tag == kPlaneOrientationSequence ||
           tag == kPixelMeasuresSequence || tag == kValueTransformationSequence;
  }
};

class Parser {
 public:
  Parser(ByteSource& bytes, const TransferSyntax& syntax, const Refuser& refuse)
      : bytes_(bytes), refuse_(refuse), elements_(bytes, refuse, syntax.encoding) {
    header_.syntax = syntax;
  }

  DicomHeader run(std::uint64_t begins) {
    elements_.walk(begins, bytes_.size(), [&](const DicomElement& e) { take(e); });
    header_.is_image = has_size_ || has_pixels_;
    if (!header_.is_image) return std::move(header_);
    if (header_.series_uid.empty() || header_.instance_uid.empty()) {
      refuse_.damaged("SeriesInstanceUID or SOPInstanceUID", "missing", "every image has both");
    }
    if (header_.rows == 0 || header_.columns == 0) {
      refuse_.damaged("Rows or Columns", "missing or 0", "its pixels need both");
    }
    header_.has_float_pixels = has_other_pixels_;
    if (has_other_pixels_ && !has_pixels_) {
      header_.frames.resize(static_cast<std::size_t>(frames_));
      return std::move(header_);
    }
    if (!has_pixels_) refuse_.damaged("PixelData", "missing", "so that it is cut short");
    check_pixel_format();
    take_frames();
    if (pixel_data_.is_undefined()) {
      take_pieces();
    } else {
      take_plain();
    }
    return std::move(header_);
  }

 private:
  void take(const DicomElement& e) {
    if (FrameFields::is_one(e.tag)) return take_frame_field(e, own_);
    switch (e.tag) {
      case kInstanceUid:
        header_.instance_uid = elements_.text(e);
        return;
      case kModality:
        header_.modality = elements_.text(e);
        return;
      case kSeriesDescription:
        header_.series_description = elements_.text(e);
        return;
      case kSeriesUid:
        header_.series_uid = elements_.text(e);
        return;
      case kFrameOfReference:
        header_.frame_of_reference_uid = elements_.text(e);
        return;
      case kPhotometric:
        header_.photometric = elements_.text(e);
        return;
      case kNumberOfFrames:
        frames_ = whole_number(e);
        return;
      case kSamples:
        header_.samples = elements_.unsigned_short(e);
        return;
      case kFloatPixelData:
      case kDoublePixelData:
        has_other_pixels_ = true;
        return;
      case kRows:
        has_size_ = true;
        header_.rows = elements_.unsigned_short(e);
        return;
      case kColumns:
        has_size_ = true;
        header_.columns = elements_.unsigned_short(e);
        return;
      case kBitsAllocated:
        header_.bits_allocated = elements_.unsigned_short(e);
        return;
      case kBitsStored:
        header_.bits_stored = elements_.unsigned_short(e);
        return;
      case kHighBit:
        header_.high_bit = elements_.unsigned_short(e);
        return;
      case kPixelRepresentation:
        representation_ = elements_.unsigned_short(e);
        return;
      case kSharedGroups:
        return take_groups(e, shared_);
      case kPerFrameGroups:
        return take_groups(e, per_frame_);
      case kPixelData:
        has_pixels_ = true;
        pixel_data_ = e;
        return;
      default:
        return;
    }
  }

  std::int64_t whole_number(const DicomElement& e) {
    const std::string text = elements_.text(e);
    const auto n = integer_of(text);
    if (!n || *n < 1 || *n > kMostFrames) {
      refuse_.damaged("NumberOfFrames", "'" + printable(text) + "'", "not from 1 to 65535");
    }
    return *n;
  }

  void take_frame_field(const DicomElement& e, FrameFields& fields) {
    std::string text = elements_.text(e);
    if (!fields.texts.emplace(e.tag, std::move(text)).second) {
      refuse_.damaged(tag_text(e.tag), "there twice for one frame", "one of the two is wrong");
    }
  }

  /// One item of functional groups a frame; in them the macros that place a frame.
  void take_groups(const DicomElement& sequence, std::vector<FrameFields>& into) {
    elements_.walk_items(
        sequence, bytes_.size(),
        [&] {
          if (into.size() >= static_cast<std::size_t>(kMostFrames)) {
            refuse_.damaged("its functional groups", "more than 65535", "which no volume has");
          }
          into.emplace_back();
        },
        [&](const DicomElement& macro) {
          if (!FrameFields::is_macro(macro.tag)) return;
          elements_.walk_items(
              macro, bytes_.size(), {},
              [&](const DicomElement& e) {
                if (FrameFields::is_one(e.tag)) take_frame_field(e, into.back());
              },
              2);
        });
  }

  void check_pixel_format() const {
    const int allocated = header_.bits_allocated;
    const std::string bits = std::to_string(allocated) + " allocated, " +
                             std::to_string(header_.bits_stored) + " stored, high bit " +
                             std::to_string(header_.high_bit);
    if (allocated < 1 || allocated > 64 || header_.bits_stored < 1 ||
        header_.bits_stored > allocated || header_.high_bit != header_.bits_stored - 1) {
      refuse_.damaged("BitsAllocated, BitsStored and HighBit", bits, "which do not fit together");
    }
    if (header_.samples < 1 || header_.samples > 4) {
      refuse_.damaged("SamplesPerPixel", std::to_string(header_.samples), "not 1 to 4");
    }
    if (representation_ < 0 || representation_ > 1) {
      refuse_.damaged("PixelRepresentation",
                      representation_ < 0 ? "missing" : std::to_string(representation_),
                      "not 0 or 1");
    }
  }

  DicomFrame frame_of(const FrameFields* per_frame) const {
    const auto text = [&](std::uint32_t tag) -> const std::string* {
      const FrameFields* shared = shared_.empty() ? nullptr : &shared_.front();
      for (const FrameFields* fields : {per_frame, shared, &own_}) {
        if (fields == nullptr) continue;
        const auto found = fields->texts.find(tag);
        if (found != fields->texts.end()) return &found->second;
      }
      return nullptr;
    };
    const auto numbers = [&](std::uint32_t tag, std::size_t count) {
      const std::string* value = text(tag);
      if (value == nullptr || value->empty()) return std::vector<double>{};
      std::vector<double> all = decimals(*value);
      if (all.size() != count) {
        refuse_.damaged(tag_text(tag), "'" + printable(*value) + "'",
                        "where " + std::to_string(count) + " numbers are needed");
      }
      return all;
    };
    DicomFrame frame;
    const std::vector<double> position = numbers(kPosition, 3);
    const std::vector<double> axes = numbers(kOrientation, 6);
    const std::vector<double> spacing = numbers(kPixelSpacing, 2);
    frame.has_place = !position.empty() && !axes.empty() && !spacing.empty();
    if (frame.has_place) {
      frame.position = {position[0], position[1], position[2]};
      frame.row = {axes[0], axes[1], axes[2]};
      frame.column = {axes[3], axes[4], axes[5]};
      frame.spacing = {spacing[1], spacing[0], 0};  // PixelSpacing is row distance first
    }
    const std::vector<double> slope = numbers(kSlope, 1);
    const std::vector<double> intercept = numbers(kIntercept, 1);
    if (slope.empty() != intercept.empty()) {
      refuse_.damaged(slope.empty() ? "RescaleSlope" : "RescaleIntercept", "missing",
                      "the other one is there");
    }
    frame.has_rescale = !slope.empty();
    if (frame.has_rescale) {
      frame.slope = slope[0];
      frame.intercept = intercept[0];
      if (frame.slope == 0)
        refuse_.damaged("RescaleSlope", "0", "which would make all voxels alike");
    }
    return frame;
  }

  void take_frames() {
    if (!per_frame_.empty() && per_frame_.size() != static_cast<std::size_t>(frames_)) {
      refuse_.damaged("NumberOfFrames", std::to_string(frames_),
                      "but functional groups describe " + std::to_string(per_frame_.size()));
    }
    if (shared_.size() > 1) {
      refuse_.damaged("SharedFunctionalGroupsSequence", std::to_string(shared_.size()) + " items",
                      "where one is allowed");
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(frames_); ++i) {
      header_.frames.push_back(frame_of(per_frame_.empty() ? nullptr : &per_frame_[i]));
    }
    header_.is_signed = representation_ == 1;
  }

  void take_plain() {
    if (header_.syntax.coding != PixelCoding::Plain &&
        header_.syntax.coding != PixelCoding::Unknown) {
      refuse_.damaged("PixelData", "not in pieces", "as its transfer syntax demands");
    }
    const std::uint64_t bits =
        static_cast<std::uint64_t>(header_.rows) * static_cast<std::uint64_t>(header_.columns) *
        static_cast<std::uint64_t>(header_.bits_allocated) *
        static_cast<std::uint64_t>(header_.samples) * static_cast<std::uint64_t>(frames_);
    const std::uint64_t needed = bits / 8 + (bits % 8 != 0 ? 1 : 0);
    const std::uint64_t padded = needed + needed % 2;
    // YBR_FULL_422 shares colours between pixels; such an image is passed over in any case.
    if (header_.samples == 1 && pixel_data_.length != needed && pixel_data_.length != padded) {
      refuse_.damaged("PixelData", std::to_string(pixel_data_.length) + " bytes",
                      "but " + std::to_string(header_.rows) + " rows x " +
                          std::to_string(header_.columns) + " columns x " +
                          std::to_string(header_.bits_allocated) + " bits x " +
                          std::to_string(frames_) + " frames need " + std::to_string(needed));
    }
    header_.pixels = {{{pixel_data_.value_begins, needed}}};
  }

  void take_pieces() {
    if (header_.syntax.coding == PixelCoding::Plain) {
      refuse_.damaged("PixelData", "in pieces", "which its transfer syntax does not have");
    }
    std::vector<ByteRange> pieces;
    elements_.walk_fragments(
        pixel_data_.value_begins, bytes_.size(), [&](std::uint64_t at, std::uint32_t length) {
          if (pieces.size() > static_cast<std::size_t>(kMostFrames)) {
            refuse_.damaged("PixelData", "in more than 65535 pieces", "which no scanner writes");
          }
          pieces.push_back({at, length});
        });
    if (pieces.size() < 2)
      refuse_.damaged("PixelData", "without a piece", "so that it is cut short");
    const ByteRange table = pieces.front();
    pieces.erase(pieces.begin());
    if (frames_ == 1) {
      header_.pixels = {pieces};
      check_table(table, {pieces.front().begins - 8}, pieces.front().begins - 8);
      return;
    }
    if (pieces.size() != static_cast<std::size_t>(frames_)) {
      refuse_.unusable("PixelData",
                       "in " + std::to_string(pieces.size()) + " pieces for " +
                           std::to_string(frames_) + " frames",
                       "convert it, for example by gdcmconv --raw, and open the result");
    }
    std::vector<std::uint64_t> begins;
    for (const ByteRange& piece : pieces) {
      header_.pixels.push_back({piece});
      begins.push_back(piece.begins - 8);
    }
    check_table(table, begins, begins.front());
  }

  /// The table of where frames begin may be empty; where it is not, it must be right.
  void check_table(const ByteRange& table,
                   const std::vector<std::uint64_t>& begins,
                   std::uint64_t first) {
    if (table.bytes == 0) return;
    bool is_right = table.bytes == 4 * begins.size();
    for (std::size_t i = 0; is_right && i < begins.size(); ++i) {
      is_right = elements_.number32(table.begins + 4 * i) == begins[i] - first;
    }
    if (!is_right) refuse_.damaged("the table of frames", "wrong", "its offsets meet no frame");
  }

  ByteSource& bytes_;
  const Refuser& refuse_;
  DicomElements elements_;
  DicomHeader header_;
  DicomElement pixel_data_;
  bool has_size_ = false;
  bool has_pixels_ = false;
  bool has_other_pixels_ = false;  ///< of floating point: a map of parameters, no scan
  int representation_ = -1;
  std::int64_t frames_ = 1;
  FrameFields own_;
  std::vector<FrameFields> shared_;
  std::vector<FrameFields> per_frame_;
};

TransferSyntax syntax_of(const std::string& uid) {
  constexpr std::string_view kRoot = "1.2.840.10008.1.2";
  TransferSyntax s;
  s.uid = uid;
  if (!uid.starts_with(kRoot)) return s;
  const std::string_view rest = std::string_view(uid).substr(kRoot.size());
  s.encoding.is_implicit = rest.empty();
  s.encoding.is_big_endian = rest == ".2";
  s.is_deflated = rest == ".1.99";
  s.is_lossy = rest == ".4.50" || rest == ".4.51" || rest == ".4.81" || rest == ".4.91";
  if (rest.empty() || rest == ".1" || rest == ".2" || rest == ".1.99")
    s.coding = PixelCoding::Plain;
  if (rest == ".5") s.coding = PixelCoding::Rle;
  if (rest == ".4.50" || rest == ".4.51" || rest == ".4.57" || rest == ".4.70") {
    s.coding = PixelCoding::Jpeg;
  }
  if (rest == ".4.80" || rest == ".4.81") s.coding = PixelCoding::JpegLs;
  if (rest == ".4.90" || rest == ".4.91") s.coding = PixelCoding::Jpeg2000;
  return s;
}

}  // namespace

bool has_dicom_mark(ByteSource& bytes) {
  std::array<std::byte, 4> mark{};
  return bytes.read(kPreambleBytes - mark.size(), mark) && mark[0] == std::byte{'D'} &&
         mark[1] == std::byte{'I'} && mark[2] == std::byte{'C'} && mark[3] == std::byte{'M'};
}

DicomFront parse_dicom_front(ByteSource& bytes, const Refuser& refuse) {
  // The group is always explicit little endian, whatever follows; a big-endian tag 0008 of what
  // follows reads as group 0800, which ends it too.
  DicomElements elements(bytes, refuse, {});
  DicomFront front;
  std::uint64_t at = kPreambleBytes;
  std::string uid;
  const std::uint64_t size = bytes.size();
  for (;;) {
    std::array<std::byte, 2> group{};
    if (at >= size || !bytes.read(at, group)) {
      refuse.damaged("its data set", "missing", "so that it is cut short");
    }
    if (group[0] != std::byte{2} || group[1] != std::byte{0}) break;
    std::uint64_t next = 0;
    elements.first(at, size, [&](const DicomElement& e) {
      if (e.is_undefined()) refuse.damaged(tag_text(e.tag), "of no stated length", "as it must be");
      if (e.tag == kTransferSyntax) uid = elements.text(e);
      if (e.tag == kMediaClassUid) front.class_uid = elements.text(e);
      next = e.value_begins + e.length;
    });
    at = next;
  }
  if (uid.empty()) refuse.damaged("its transfer syntax", "missing", "its header needs it");
  front.syntax = syntax_of(uid);
  front.data_begins = at;
  return front;
}

DicomHeader parse_dicom(ByteSource& bytes,
                        std::uint64_t begins,
                        const TransferSyntax& syntax,
                        const Refuser& refuse) {
  return Parser(bytes, syntax, refuse).run(begins);
}

void check_readable(const DicomHeader& h, const Refuser& refuse) {
  if (h.has_float_pixels) {
    refuse.unusable("PixelData", "of floating point", "export the original series");
  }
  if (h.samples != 1) {
    refuse.unusable("SamplesPerPixel", std::to_string(h.samples) + " (a colour image)",
                    "a CT has one value a pixel");
  }
  if (h.photometric != "MONOCHROME2") {
    refuse.unusable("PhotometricInterpretation", "'" + printable(h.photometric) + "'",
                    "a CT is MONOCHROME2; export the original series");
  }
  if ((h.bits_allocated != 8 && h.bits_allocated != 16) ||
      (h.bits_allocated == 16 && h.bits_stored < 8)) {
    refuse.unusable(
        "BitsAllocated",
        std::to_string(h.bits_allocated) + " with " + std::to_string(h.bits_stored) + " stored",
        "8 or 16 are read; export the series again with 16");
  }
  if (h.syntax.coding == PixelCoding::Unknown ||
      (h.syntax.encoding.is_big_endian && h.bits_allocated == 8)) {
    refuse.unusable("its transfer syntax", "'" + printable(h.syntax.uid) + "'",
                    "convert it, for example by gdcmconv --raw, and open the result");
  }
}

}  // namespace carpus::image_formats
