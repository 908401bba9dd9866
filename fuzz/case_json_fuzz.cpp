// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Any bytes as case.json: refused in words that name the file, or a case without its volumes.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "case_io/detail/case_json.hpp"
#include "refusals.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace carpus;
  fuzz::reads_or_refuses("case.json", [&] {
    const case_io::CaseHeader header =
        case_io::parse_case_json({reinterpret_cast<const char*>(data), size}, "case.json");
    fuzz::require(header.data.bones.size() <= 16);
    for (const cases::Bone& bone : header.data.bones) {
      fuzz::require(std::abs(bone.patient_from_bone.rotation.determinant() - 1) < 1e-5);
      fuzz::require(is_finite(bone.patient_from_bone.translation));
    }
    for (const auto& [name, grid] : header.grids) {
      for (std::size_t i = 0; i < 3; ++i) fuzz::require(grid.size[i] >= 1 && grid.spacing[i] > 0);
      fuzz::require(is_finite(grid.origin));
    }
  });
  return 0;
}
