// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The elements of a DICOM data set one after another: tag, (value representation,) length, value.
// Every one must end within its bounds; nothing is guessed.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>

#include "image_formats/byte_source.hpp"
#include "image_formats/refusal.hpp"

namespace carpus::image_formats {

inline constexpr std::uint32_t kUndefinedLength = 0xFFFFFFFFU;
/// Deeper nesting than any standard object; a bound for hostile files.
inline constexpr int kDeepestNesting = 16;

struct DicomEncoding {
  bool is_implicit = false;
  bool is_big_endian = false;
};

struct DicomElement {
  std::uint32_t tag = 0;  ///< group << 16 | element
  std::array<char, 2> vr{};
  std::uint32_t length = 0;
  std::uint64_t value_begins = 0;
  bool is_implicit_inside = false;  ///< of an undefined length and value representation UN

  [[nodiscard]] bool is_undefined() const noexcept { return length == kUndefinedLength; }
  [[nodiscard]] bool is(const char* name) const noexcept {
    return vr[0] == name[0] && vr[1] == name[1];
  }
};

/// "(0028,0010)"
[[nodiscard]] std::string tag_text(std::uint32_t tag);

/// Walks elements. Source: [dicom_ps3_5] chapter 7.
class DicomElements {
 public:
  DicomElements(ByteSource& bytes, const Refuser& refuse, DicomEncoding encoding)
      : bytes_(bytes), refuse_(refuse), encoding_(encoding) {}

  /// Elements from `at` to `end` exactly; `visit` is told each one and may read its value.
  /// Nested items of undefined length are walked to their delimiters, others passed over whole.
  /// Tags must rise, as the standard demands.
  using Visit = std::function<void(const DicomElement&)>;
  void walk(std::uint64_t at, std::uint64_t end, const Visit& visit);

  /// The one element at `at`.
  void first(std::uint64_t at, std::uint64_t end, const Visit& visit);

  /// The data sets of a sequence's items: `visit_item` once for each, then `visit` for its
  /// elements.
  void walk_items(const DicomElement& sequence,
                  std::uint64_t end,
                  const std::function<void()>& visit_item,
                  const Visit& visit,
                  int depth = 1);

  /// The pieces of encapsulated pixel data, the offset table first; returns where they end.
  std::uint64_t walk_fragments(
      std::uint64_t at,
      std::uint64_t end,
      const std::function<void(std::uint64_t at, std::uint32_t length)>& visit);

  [[nodiscard]] std::string text(const DicomElement& element);
  [[nodiscard]] int unsigned_short(const DicomElement& element);
  [[nodiscard]] std::uint32_t number32(std::uint64_t at);

 private:
  std::uint64_t elements(std::uint64_t at,
                         std::uint64_t end,
                         bool is_item,
                         bool is_implicit,
                         const Visit& visit,
                         int depth);
  /// Whether a delimiter comes next; refuses what may not.
  bool check_tag(std::uint64_t at, std::uint64_t end, bool is_item);
  [[nodiscard]] std::uint64_t item_end(const DicomElement& e) const;
  std::uint64_t skip_items(std::uint64_t at, std::uint64_t end, bool is_implicit, int depth);
  DicomElement header(std::uint64_t at, std::uint64_t end, bool is_implicit);
  [[nodiscard]] std::uint32_t take(std::uint64_t at, std::uint64_t end, std::size_t bytes);
  [[nodiscard]] std::uint32_t take_tag(std::uint64_t at, std::uint64_t end);

  ByteSource& bytes_;
  const Refuser& refuse_;
  DicomEncoding encoding_;
};

}  // namespace carpus::image_formats
