// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "image_formats/meta_image_header.hpp"
#include "scan_headers.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace carpus;
  const std::string_view front(reinterpret_cast<const char*>(data), size);
  fuzz::accepts([&](const image_formats::Refuser& refuse) {
    const image_formats::VolumeHeader header = image_formats::parse_meta_image(front, refuse);
    fuzz::require_usable(header);
    // Behind the header, or so many bytes into another file.
    fuzz::require(!header.data_file.empty() || header.stored_begins >= 8);
  });
  return 0;
}
