// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "image_formats/rle_frame.hpp"

#include <algorithm>
#include <cstdint>

#include "core/check.hpp"

namespace carpus::image_formats {
namespace {

constexpr std::size_t kHeaderBytes = 64;

std::uint32_t number(std::span<const std::byte> bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    value |= std::to_integer<std::uint32_t>(bytes[at + i]) << (8U * i);
  }
  return value;
}

/// One segment into every `step`-th byte; false where it gives too much or too little.
bool unpack_segment(std::span<const std::byte> from,
                    std::span<std::byte> to,
                    std::size_t first,
                    std::size_t step) {
  std::size_t at = 0;
  std::size_t out = first;
  while (out < to.size()) {
    if (at >= from.size()) return false;
    const int control = std::to_integer<int>(from[at++]);
    if (control == 128) continue;
    const bool is_run = control > 128;
    const auto count = static_cast<std::size_t>(is_run ? 257 - control : control + 1);
    if (from.size() - at < (is_run ? 1 : count)) return false;
    if ((to.size() - out + step - 1) / step < count) return false;
    for (std::size_t i = 0; i < count; ++i, out += step) to[out] = from[is_run ? at : at + i];
    at += is_run ? 1 : count;
  }
  return from.size() - at <= 1;  // a byte of padding to an even length
}

}  // namespace

void unpack_rle(std::span<const std::byte> frame,
                const DicomHeader& header,
                std::span<std::byte> to,
                const Refuser& refuse) {
  CARPUS_CHECK(to.size() == header.frame_bytes());
  const auto segments = static_cast<std::size_t>(header.bits_allocated / 8);
  const auto damaged = [&] {
    refuse.damaged("a run-length coded frame", "not of one byte a pixel in each part",
                   "as its header says");
  };
  if (frame.size() < kHeaderBytes || number(frame, 0) != segments) damaged();
  for (std::size_t i = 0; i < segments; ++i) {
    const std::size_t begins = number(frame, 4 + 4 * i);
    const std::size_t ends = i + 1 < segments ? number(frame, 8 + 4 * i) : frame.size();
    const bool is_first_in_place = i > 0 || begins == kHeaderBytes;
    if (!is_first_in_place || begins < kHeaderBytes || ends < begins || ends > frame.size()) {
      damaged();
    }
    // The most significant byte comes first.
    if (!unpack_segment(frame.subspan(begins, ends - begins), to, segments - 1 - i, segments)) {
      damaged();
    }
  }
}

}  // namespace carpus::image_formats
