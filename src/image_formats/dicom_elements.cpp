// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "image_formats/dicom_elements.hpp"

#include <cstdio>
#include <string_view>

namespace carpus::image_formats {
namespace {

constexpr std::uint32_t kItem = 0xFFFEE000U;
constexpr std::uint32_t kItemEnd = 0xFFFEE00DU;
constexpr std::uint32_t kSequenceEnd = 0xFFFEE0DDU;
constexpr std::uint32_t kPixelData = 0x7FE00010U;
/// Longer texts than this are no value that is read here.
constexpr std::uint32_t kLongestText = 1024;

bool is_listed(std::string_view forms, const std::array<char, 2>& vr) {
  return vr[0] != ' ' && vr[1] != ' ' &&
         forms.find(std::string_view(vr.data(), 2)) != std::string_view::npos;
}

/// [dicom_ps3_5] table 6.2-1.
bool is_known_form(const std::array<char, 2>& vr) {
  return is_listed(
      "AE AS AT CS DA DS DT FD FL IS LO LT OB OD OF OL OV OW PN SH SL SQ SS ST SV TM UC UI UL UN "
      "UR US UT UV",
      vr);
}
/// Those with a length of 32 bits, [dicom_ps3_5] table 7.1-1.
bool is_long_form(const std::array<char, 2>& vr) {
  return is_listed("OB OD OF OL OV OW SQ SV UC UN UR UT UV", vr);
}

/// Groups that no data set has [dicom_ps3_5] 7.1, 0004 being a DICOMDIR's; 0000 is what zeros
/// behind a file look like.
bool is_forbidden_group(std::uint32_t group) { return group <= 7 ? group != 4 : group == 0xFFFFU; }

}  // namespace

std::string tag_text(std::uint32_t tag) {
  std::array<char, 16> text{};
  const int n = std::snprintf(text.data(), text.size(), "(%04x,%04x)", tag >> 16U, tag & 0xFFFFU);
  return {text.data(), static_cast<std::size_t>(n)};
}

std::uint32_t DicomElements::take(std::uint64_t at, std::uint64_t end, std::size_t count) {
  std::array<std::byte, 4> b{};
  if (at > end || end - at < count || !bytes_.read(at, std::span(b).first(count))) {
    refuse_.cut_short("an element");
  }
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t place = encoding_.is_big_endian ? count - 1 - i : i;
    value |= std::to_integer<std::uint32_t>(b[i]) << (8U * place);
  }
  return value;
}

std::uint32_t DicomElements::take_tag(std::uint64_t at, std::uint64_t end) {
  return take(at, end, 2) << 16U | take(at + 2, end, 2);
}

std::uint32_t DicomElements::number32(std::uint64_t at) { return take(at, bytes_.size(), 4); }

DicomElement DicomElements::header(std::uint64_t at, std::uint64_t end, bool is_implicit) {
  DicomElement e;
  e.tag = take_tag(at, end);
  if (e.tag >> 16U == kItem >> 16U || is_implicit) {
    e.length = take(at + 4, end, 4);
    e.value_begins = at + 8;
    e.is_implicit_inside = is_implicit;
    return e;
  }
  std::array<std::byte, 2> vr{};
  if (end - at < 6 || !bytes_.read(at + 4, vr)) refuse_.cut_short(tag_text(e.tag));
  e.vr = {static_cast<char>(vr[0]), static_cast<char>(vr[1])};
  if (!is_known_form(e.vr)) {
    refuse_.damaged("the value representation of " + tag_text(e.tag),
                    "'" + printable(std::string_view(e.vr.data(), 2)) + "'",
                    "which does not exist");
  }
  const bool is_long = is_long_form(e.vr);
  e.length = is_long ? take(at + 8, end, 4) : take(at + 6, end, 2);
  e.value_begins = at + (is_long ? 12 : 8);
  e.is_implicit_inside = e.is("UN");  // [dicom_ps3_5] 6.2.2 note 2
  return e;
}

bool DicomElements::check_tag(std::uint64_t at, std::uint64_t end, bool is_item) {
  constexpr std::uint64_t kLeastElement = 8;
  if (!is_item && end - at < kLeastElement) {
    refuse_.damaged("its end", "followed by " + std::to_string(end - at) + " bytes",
                    "which belong to nothing");
  }
  const std::uint32_t tag = take_tag(at, end);
  const bool is_delimiter = tag >> 16U == kItem >> 16U;
  if (is_forbidden_group(tag >> 16U) || (is_delimiter && !is_item)) {
    refuse_.damaged("an element", tag_text(tag), "where no such element may stand");
  }
  return is_delimiter;
}

std::uint64_t DicomElements::item_end(const DicomElement& e) const {
  if (e.tag != kItemEnd) refuse_.damaged("an element", tag_text(e.tag), "in an item");
  if (e.length != 0) refuse_.damaged("the end of an item", "not empty", "as it must be");
  return e.value_begins;
}

std::uint64_t DicomElements::elements(std::uint64_t at,
                                      std::uint64_t end,
                                      bool is_item,
                                      bool is_implicit,
                                      const Visit& visit,
                                      int depth) {
  std::uint64_t last_tag = 0;
  while (at < end) {
    const bool is_delimiter = check_tag(at, end, is_item);
    const DicomElement e = header(at, end, is_implicit);
    if (is_delimiter) return item_end(e);
    if (depth == 0 && e.tag <= last_tag) {
      refuse_.damaged("an element",
                      tag_text(e.tag) + " after " + tag_text(static_cast<std::uint32_t>(last_tag)),
                      "where tags must rise");
    }
    last_tag = e.tag;
    if (e.is_undefined()) {
      const bool is_pixels = e.tag == kPixelData && depth == 0;
      at = is_pixels ? walk_fragments(e.value_begins, end, [](std::uint64_t, std::uint32_t) {})
                     : skip_items(e.value_begins, end, e.is_implicit_inside, depth + 1);
    } else {
      if (end - e.value_begins < e.length) refuse_.cut_short(tag_text(e.tag));
      at = e.value_begins + e.length;
    }
    if (visit) visit(e);
  }
  if (is_item) refuse_.cut_short("an item");
  return at;
}

std::uint64_t DicomElements::skip_items(std::uint64_t at,
                                        std::uint64_t end,
                                        bool is_implicit,
                                        int depth) {
  if (depth > kDeepestNesting) {
    refuse_.damaged("its nesting", "deeper than " + std::to_string(kDeepestNesting) + " sequences",
                    "which no scanner writes");
  }
  for (;;) {
    const std::uint32_t tag = take_tag(at, end);
    const std::uint32_t length = take(at + 4, end, 4);
    at += 8;
    if (tag == kSequenceEnd) {
      if (length != 0) refuse_.damaged("the end of a sequence", "not empty", "as it must be");
      return at;
    }
    if (tag != kItem) refuse_.damaged("an item", tag_text(tag), "where (fffe,e000) is needed");
    if (length == kUndefinedLength) {
      at = elements(at, end, true, is_implicit, {}, depth);
    } else {
      if (end - at < length) refuse_.cut_short("an item");
      at += length;
    }
  }
}

void DicomElements::walk(std::uint64_t at, std::uint64_t end, const Visit& visit) {
  elements(at, end, false, encoding_.is_implicit, visit, 0);
}

void DicomElements::first(std::uint64_t at, std::uint64_t end, const Visit& visit) {
  const DicomElement e = header(at, end, encoding_.is_implicit);
  if (!e.is_undefined() && end - e.value_begins < e.length) refuse_.cut_short(tag_text(e.tag));
  visit(e);
}

void DicomElements::walk_items(const DicomElement& sequence,
                               std::uint64_t end,
                               const std::function<void()>& visit_item,
                               const Visit& visit,
                               int depth) {
  if (depth > kDeepestNesting) {
    refuse_.damaged("its nesting", "deeper than " + std::to_string(kDeepestNesting) + " sequences",
                    "which no scanner writes");
  }
  const bool is_implicit = encoding_.is_implicit || sequence.is("UN");
  std::uint64_t at = sequence.value_begins;
  if (!sequence.is_undefined()) end = at + sequence.length;
  while (at < end) {
    const std::uint32_t tag = take_tag(at, end);
    const std::uint32_t length = take(at + 4, end, 4);
    at += 8;
    if (sequence.is_undefined() && tag == kSequenceEnd) return;
    if (tag != kItem) refuse_.damaged("an item", tag_text(tag), "where (fffe,e000) is needed");
    if (visit_item) visit_item();
    if (length == kUndefinedLength) {
      at = elements(at, end, true, is_implicit, visit, depth);
    } else {
      if (end - at < length) refuse_.cut_short("an item");
      elements(at, at + length, false, is_implicit, visit, depth);
      at += length;
    }
  }
}

std::uint64_t DicomElements::walk_fragments(
    std::uint64_t at,
    std::uint64_t end,
    const std::function<void(std::uint64_t at, std::uint32_t length)>& visit) {
  for (;;) {
    const std::uint32_t tag = take_tag(at, end);
    const std::uint32_t length = take(at + 4, end, 4);
    at += 8;
    if (tag == kSequenceEnd) {
      if (length != 0) refuse_.damaged("the end of the pixels", "not empty", "as it must be");
      return at;
    }
    if (tag != kItem || length == kUndefinedLength) {
      refuse_.damaged("a piece of the pixels", tag_text(tag), "where (fffe,e000) is needed");
    }
    if (end - at < length) refuse_.cut_short("a piece of the pixels");
    visit(at, length);
    at += length;
  }
}

std::string DicomElements::text(const DicomElement& e) {
  if (e.length > kLongestText) {
    refuse_.damaged(tag_text(e.tag), std::to_string(e.length) + " bytes long",
                    "at most 1024 are possible");
  }
  std::string value(e.length, '\0');
  if (!bytes_.read(e.value_begins, std::as_writable_bytes(std::span(value)))) {
    refuse_.cut_short(tag_text(e.tag));
  }
  const std::size_t first = value.find_first_not_of(std::string_view(" \0", 2));
  if (first == std::string::npos) return {};
  return value.substr(first, value.find_last_not_of(std::string_view(" \0", 2)) - first + 1);
}

int DicomElements::unsigned_short(const DicomElement& e) {
  if (e.length != 2 || (e.vr[0] != '\0' && !e.is("US") && !e.is("UN"))) {
    refuse_.damaged(tag_text(e.tag), "not one number of 16 bits", "as it must be");
  }
  return static_cast<int>(take(e.value_begins, bytes_.size(), 2));
}

}  // namespace carpus::image_formats
