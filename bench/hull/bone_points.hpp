// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Bones as point sets: of the parametric wrist at any resolution, or of a folder of surfaces.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "anatomy/bone_id.hpp"
#include "bench/hull/point_sets.hpp"

namespace carpus::bench {

/// Vertices of a marching-cubes surface of a bone of the parametric wrist (simulated), on a grid
/// like a CT's (slices 5/3 as thick as the pixels), its resolution chosen so that about `count`
/// vertices result.
[[nodiscard]] PointSet model_bone(BoneId bone, std::size_t count);

/// @throws IoError, saying what to do, when there is no such folder.
void check_bones_folder(const std::filesystem::path& folder);

/// Every <bone>.ply of a folder, e.g. a case's bones/, at full resolution.
/// @throws IoError when there is no such folder, or it holds none.
[[nodiscard]] std::vector<PointSet> bones_in(const std::filesystem::path& folder);

/// One bone of a folder, simplified to at most `count` vertices; fewer where it has no more.
[[nodiscard]] PointSet thinned_bone(const std::filesystem::path& file, std::size_t count);

}  // namespace carpus::bench
