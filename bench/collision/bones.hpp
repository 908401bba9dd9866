// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The bones that the collision tables move: hulls of 300 to 1300 facets, all in one frame.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "convex/convex_body.hpp"
#include "geometry/triangle_mesh.hpp"

namespace carpus::bench {

struct Bone {
  std::string name;
  std::unique_ptr<convex::ConvexBody> body;
  TriangleMesh surface;  ///< empty for bones of the model
};

struct BoneSet {
  std::string source;  ///< "reference wrist", "demo case", "parametric wrist (simulated)"
  std::vector<Bone> bones;
  [[nodiscard]] double mean_facets() const;
};

/// Every <bone>.ply of the folder, or the parametric wrist where it is empty. Of each hull's
/// corners a seeded random subset is kept: 2 facets fewer than 2 corners, from 300 to 1300.
[[nodiscard]] BoneSet load_bones(const std::filesystem::path& folder);

/// The hull of a random `count` of the points' own corners; of all where there are fewer.
[[nodiscard]] std::unique_ptr<convex::ConvexBody> body_of(const std::vector<Vec3>& points,
                                                          std::size_t count,
                                                          std::uint64_t seed);

/// Pairs whose boxes, grown by `reach_mm`, overlap.
[[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> near_pairs(const BoneSet& set,
                                                                          double reach_mm);

}  // namespace carpus::bench
