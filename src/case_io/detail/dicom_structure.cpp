// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Elements are tag, (value representation,) length, value. The file's own group 0002 is always
// explicit little endian and names how the rest is stored. An undefined length means nested items
// that end with a delimiter; those are walked too.
#include "case_io/detail/dicom_structure.hpp"

#include <array>
#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>

namespace carpus::case_io {
namespace {

constexpr std::uint32_t kUndefinedLength = 0xFFFFFFFFU;
constexpr std::uint32_t kPixelData = 0x7FE00010U;
constexpr std::uint32_t kTransferSyntax = 0x00020010U;
constexpr std::uint32_t kItem = 0xFFFEE000U;
constexpr std::uint32_t kItemEnd = 0xFFFEE00DU;
constexpr std::uint32_t kSequenceEnd = 0xFFFEE0DDU;
constexpr std::uint64_t kPreambleBytes = 132;
/// Deeper nesting than any standard object; a bound for hostile files.
constexpr int kDeepestNesting = 12;

class Walker {
 public:
  explicit Walker(const std::filesystem::path& file) : in_(file, std::ios::binary) {
    in_.seekg(0, std::ios::end);
    size_ = in_ ? static_cast<std::uint64_t>(in_.tellg()) : 0;
  }

  DicomCheck run() {
    at_ = kPreambleBytes;
    const DicomStructure structure = elements(0);
    return {structure, has_pixels_};
  }

 private:
  struct Element {
    std::uint32_t tag = 0;
    std::uint32_t length = 0;
    std::array<char, 2> vr{};
  };
  enum class Next { Element, CutShort, Damaged, Unknown };

  template <std::size_t N>
  bool take(std::array<unsigned char, N>& bytes) {
    if (size_ - at_ < N) return false;
    in_.seekg(static_cast<std::streamoff>(at_));
    in_.read(reinterpret_cast<char*>(bytes.data()), N);
    at_ += N;
    return in_.good();
  }
  bool take16(std::uint32_t& v) {
    std::array<unsigned char, 2> b{};
    if (!take(b)) return false;
    v = static_cast<std::uint32_t>(b[0] | (b[1] << 8));
    return true;
  }
  bool take32(std::uint32_t& v) {
    std::uint32_t low = 0;
    std::uint32_t high = 0;
    if (!take16(low) || !take16(high)) return false;
    v = low | (high << 16U);
    return true;
  }
  bool take_tag(std::uint32_t& tag) {
    std::uint32_t group = 0;
    std::uint32_t element = 0;
    if (!take16(group) || !take16(element)) return false;
    tag = (group << 16U) | element;
    return true;
  }

  Next next(Element& e) {
    if (!take_tag(e.tag)) return Next::CutShort;
    const bool is_meta = (e.tag >> 16U) == 2;
    has_data_set_ = has_data_set_ || !is_meta;
    if (!is_meta && is_elsewhere_stored_) return Next::Unknown;
    if ((e.tag >> 16U) == 0xFFFEU || (!is_meta && is_implicit_)) {
      return take32(e.length) ? Next::Element : Next::CutShort;
    }
    std::array<unsigned char, 2> vr{};
    if (!take(vr)) return Next::CutShort;
    e.vr = {static_cast<char>(vr[0]), static_cast<char>(vr[1])};
    if (is_meta && !is_meta_form(e.vr)) return Next::Damaged;
    if (!is_known_form(e.vr)) {
      // "??" and two zeros or spaces are written by some scanners; GDCM knows what to do with them.
      const bool is_placeholder =
          e.vr[0] == e.vr[1] && (e.vr[0] == '?' || e.vr[0] == '\0' || e.vr[0] == ' ');
      return is_placeholder ? Next::Unknown : Next::Damaged;
    }
    constexpr std::string_view kLongForms = "OB OD OF OL OV OW SQ SV UC UN UR UT UV";
    if (kLongForms.find(std::string_view(e.vr.data(), 2)) == std::string_view::npos) {
      return take16(e.length) ? Next::Element : Next::CutShort;
    }
    std::uint32_t reserved = 0;
    return take16(reserved) && take32(e.length) ? Next::Element : Next::CutShort;
  }

  /// The forms that the standard lists for group 0002 [dicom_ps3_10] table 7.1-1.
  static bool is_meta_form(const std::array<char, 2>& vr) {
    constexpr std::string_view kForms = "UL OB UI SH AE UR";
    return kForms.find(std::string_view(vr.data(), 2)) != std::string_view::npos && vr[0] != ' ' &&
           vr[1] != ' ';
  }

  /// [dicom_ps3_5] table 6.2-1.
  static bool is_known_form(const std::array<char, 2>& vr) {
    constexpr std::string_view kForms =
        "AE AS AT CS DA DS DT FD FL IS LO LT OB OD OF OL OV OW PN SH SL SQ SS ST SV TM UC UI UL UN "
        "UR US UT UV";
    return kForms.find(std::string_view(vr.data(), 2)) != std::string_view::npos && vr[0] != ' ' &&
           vr[1] != ' ';
  }

  bool skip(std::uint32_t length) {
    if (size_ - at_ < length) return false;
    at_ += length;
    return true;
  }

  bool take_transfer_syntax(std::uint32_t length) {
    if (size_ - at_ < length || length > 64) return false;
    std::string uid(length, '\0');
    in_.seekg(static_cast<std::streamoff>(at_));
    in_.read(uid.data(), static_cast<std::streamsize>(length));
    while (!uid.empty() && (uid.back() == '\0' || uid.back() == ' ')) uid.pop_back();
    is_implicit_ = uid == "1.2.840.10008.1.2";
    is_elsewhere_stored_ = uid == "1.2.840.10008.1.2.2" || uid == "1.2.840.10008.1.2.1.99";
    return true;
  }

  /// Elements up to the end of the file (depth 0) or of the item.
  DicomStructure elements(int depth) {
    if (depth > kDeepestNesting) return DicomStructure::Unknown;
    while (at_ < size_) {
      Element e;
      const Next found = next(e);
      if (found == Next::CutShort) return DicomStructure::CutShort;
      if (found == Next::Damaged) return DicomStructure::Damaged;
      if (found == Next::Unknown) return DicomStructure::Unknown;
      if (e.tag == kItemEnd || e.tag == kSequenceEnd) return DicomStructure::Whole;
      if (e.tag == kTransferSyntax && !take_transfer_syntax(e.length))
        return DicomStructure::CutShort;
      if (e.length == kUndefinedLength) {
        const DicomStructure inner = items(e, depth);
        if (inner != DicomStructure::Whole) return inner;
      } else if (!skip(e.length)) {
        return DicomStructure::CutShort;
      }
      if (depth == 0 && e.tag == kPixelData) {  // what follows is padding or signatures
        has_pixels_ = true;
        return DicomStructure::Whole;
      }
    }
    return depth == 0 && has_data_set_ ? DicomStructure::Whole : DicomStructure::CutShort;
  }

  /// Items of an undefined length up to their delimiter.
  DicomStructure items(const Element& parent, int depth) {
    const bool was_implicit = is_implicit_;
    if (parent.vr == std::array<char, 2>{'U', 'N'}) is_implicit_ = true;  // PS3.5, 6.2.2 note 2
    DicomStructure outcome = DicomStructure::CutShort;
    while (at_ < size_) {
      std::uint32_t tag = 0;
      std::uint32_t length = 0;
      if (!take_tag(tag) || !take32(length)) break;
      if (tag == kSequenceEnd) {
        outcome = DicomStructure::Whole;
        break;
      }
      if (tag != kItem) {
        outcome = DicomStructure::Unknown;
        break;
      }
      if (length != kUndefinedLength) {
        if (!skip(length)) break;
        continue;
      }
      const DicomStructure inner = elements(depth + 1);
      if (inner != DicomStructure::Whole) {
        outcome = inner;
        break;
      }
    }
    is_implicit_ = was_implicit;
    return outcome;
  }

  std::ifstream in_;
  std::uint64_t size_ = 0;
  std::uint64_t at_ = 0;
  bool is_implicit_ = false;
  bool is_elsewhere_stored_ = false;
  bool has_data_set_ = false;
  bool has_pixels_ = false;
};

}  // namespace

DicomCheck check_dicom_structure(const std::filesystem::path& file) { return Walker(file).run(); }

}  // namespace carpus::case_io
