// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Any bytes as a surface or points, in the format of CARPUS_FUZZED_FILE's extension: refused in
// words that name the file, or a mesh that others can use without looking again.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>

#include "case_io/marker_points.hpp"
#include "case_io/ply.hpp"
#include "case_io/surface_file.hpp"
#include "refusals.hpp"

namespace {

using namespace carpus;

const std::filesystem::path kFile = CARPUS_FUZZED_FILE;

void require_usable(const TriangleMesh& mesh, std::size_t bytes) {
  // Each vertex and each corner of a facet was written somewhere.
  fuzz::require(mesh.vertices.size() <= bytes && mesh.facets.size() <= bytes);
  for (const Vec3& p : mesh.vertices) fuzz::require(is_finite(p));
  for (const Triangle& t : mesh.facets) {
    for (const std::uint32_t v : t) fuzz::require(v < mesh.vertices.size());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (kFile.extension() == ".csv") {
    fuzz::reads_or_refuses(kFile.string(), [&] {
      const auto points = case_io::parse_planar_points(bytes, kFile);
      fuzz::require(points.size() <= size);
      for (const Vec2& p : points) fuzz::require(is_finite(Vec3{p.x, p.y, 0}));
    });
    fuzz::reads_or_refuses(kFile.string(), [&] {
      for (const auto& marker : case_io::parse_marker_points(bytes, kFile)) {
        fuzz::require(is_finite(marker.place) && marker.label > 0 && marker.radius_mm >= 0);
      }
    });
    return 0;
  }
  fuzz::reads_or_refuses(kFile.string(),
                         [&] { require_usable(case_io::parse_surface(bytes, kFile), size); });
  if (kFile.extension() == ".ply") {
    fuzz::reads_or_refuses(kFile.string(),
                           [&] { require_usable(case_io::parse_ply(bytes, kFile), size); });
  }
  return 0;
}
