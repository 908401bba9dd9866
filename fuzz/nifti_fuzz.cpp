// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <span>

#include "image_formats/nifti_header.hpp"
#include "scan_headers.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace carpus;
  const auto bytes = std::as_bytes(std::span(data, size));
  fuzz::accepts([&](const image_formats::Refuser& refuse) {
    fuzz::require_usable(image_formats::parse_nifti(bytes, refuse));
  });
  return 0;
}
