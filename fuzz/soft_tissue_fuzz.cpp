// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Any bytes for soft_tissue.json, with the same small surface behind each name that it gives:
// refused in words that name the file, or tissue whose strands are held on their courses.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "case_io/detail/soft_tissue_json.hpp"
#include "case_io/small_tissue_test_support.hpp"
#include "refusals.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace carpus;
  const auto surface = [](const std::string& name) {
    fuzz::require(name.find('/') == std::string::npos && !name.starts_with("."));
    return case_io::test::tetrahedron();
  };
  fuzz::reads_or_refuses("soft_tissue.json", [&] {
    const auto tissue = case_io::parse_soft_tissue({reinterpret_cast<const char*>(data), size},
                                                   "soft_tissue.json", surface);
    fuzz::require(tissue.size > 0 && tissue.ligaments.size() <= 128);
    for (const soft_tissue::Ligament& ligament : tissue.ligaments) {
      for (const soft_tissue::Strand& strand : ligament.strands) {
        fuzz::require(std::isfinite(strand.rest_length_mm) && strand.course.size() >= 2);
        for (const Vec3& at : strand.course) fuzz::require(is_finite(at));
        for (const soft_tissue::Anchor& anchor : strand.anchors) {
          fuzz::require(anchor.point < strand.course.size() && is_finite(anchor.at));
          fuzz::require((anchor.label > 0) == anchor.ligament.empty());
        }
      }
    }
    for (const soft_tissue::Cartilage& each : tissue.cartilage) {
      for (const float mm : each.vertex_thickness_mm) fuzz::require(mm >= 0);
    }
  });
  return 0;
}
