// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Any bytes for a case's trust.json: refused in words that name the file, or lines that come back
// from their text.
#include <cstddef>
#include <cstdint>
#include <string>

#include "case_io/trust_file.hpp"
#include "refusals.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace carpus;
  fuzz::reads_or_refuses("trust.json", [&] {
    const case_io::Trust trust =
        case_io::parse_trust({reinterpret_cast<const char*>(data), size}, "trust.json");
    for (const case_io::TrustLine& line : trust.bones) {
      fuzz::require(line.confidence >= 0 && line.confidence <= 1);
    }
    const auto back = case_io::parse_trust(case_io::trust_text(trust, "fuzz"), "trust.json");
    fuzz::require(back == trust);
  });
  return 0;
}
