// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How far a reconstructed bone's surface lies from its true one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "geometry/pose.hpp"
#include "geometry/triangle_mesh.hpp"
#include "reconstruct/reconstruct_case.hpp"

namespace carpus::reconstruct {

/// The true surface of a label (anatomy/bone_id.hpp).
struct TrueSurface {
  std::uint8_t label = 0;
  MeshIn<frame::Patient> surface;  ///< [mm]
};

/// Every surface of `folder` whose name is a bone's (radius.ply, scaphoid_distal.stl ...; formats
/// of case_io/surface_file.hpp), in the scan's frame: LPS [mm]. "scaphoid" beside a distal part is
/// the proximal one. Other files are passed over.
/// @throws IoError, InvalidInput naming the file; InvalidInput where no name is a bone's.
[[nodiscard]] std::vector<TrueSurface> read_true_surfaces(const std::filesystem::path& folder);

/// Distances between two surfaces, both ways: from the vertices of each, weighed by the area about
/// them, to the nearest point of the other.
struct SurfaceDistance {
  std::uint8_t label = 0;
  double mean_mm = 0;
  double p95_mm = 0;   ///< 95 % of the area is nearer
  double most_mm = 0;  ///< the Hausdorff distance of the vertices
};

/// Where the truth was cut flat, as shafts are, the bone goes on in the scan: what lies beyond the
/// cut, or within 1.5 mm of it, is compared with nothing.
[[nodiscard]] SurfaceDistance distance_between(const TriangleMesh& found,
                                               const TriangleMesh& truth);

/// For each true surface whose bone was found, in the order of `truth`.
[[nodiscard]] std::vector<SurfaceDistance> compare_surfaces(const cases::CaseData& found,
                                                            std::span<const TrueSurface> truth);

}  // namespace carpus::reconstruct
