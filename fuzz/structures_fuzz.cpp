// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Any bytes for a case's structures.json: refused in words, or tubes that come back from their
// text.
#include <cstddef>
#include <cstdint>
#include <string>

#include "case_io/detail/structures_json.hpp"
#include "refusals.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace carpus;
  fuzz::reads_or_refuses("structures.json", [&] {
    const auto tubes =
        case_io::parse_structures({reinterpret_cast<const char*>(data), size}, "structures.json");
    fuzz::require(tubes.size() <= cases::kMaxStructures);
    for (const cases::Structure& tube : tubes) {
      fuzz::require(tube.radius_mm > 0 && tube.course.size() >= 2);
      fuzz::require(tube.course.size() <= cases::kMaxStructurePoints);
      for (const cases::StructurePoint& point : tube.course) fuzz::require(is_finite(point.at));
    }
    fuzz::require(case_io::parse_structures(case_io::structures_text(tubes), "structures.json") ==
                  tubes);
  });
  return 0;
}
