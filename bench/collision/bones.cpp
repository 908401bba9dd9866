// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/collision/bones.hpp"

#include <algorithm>

#include "anatomy/bone_id.hpp"
#include "bench/hull/bone_points.hpp"
#include "case_io/ply.hpp"
#include "core/error.hpp"
#include "core/rng.hpp"
#include "hull/fast_hull.hpp"

namespace carpus::bench {
namespace {

constexpr std::size_t kFewestFacets = 300;
constexpr std::size_t kMostFacets = 1300;
constexpr std::size_t kModelVertices = 9000;

ConvexPolytope hull_of(const std::vector<Vec3>& points) {
  hull::HullResult result = hull::build_fast_hull(points);
  if (result.status != hull::HullStatus::Ok) throw InvalidInput("a bone's surface has no hull");
  return std::move(result.polytope);
}

}  // namespace

std::unique_ptr<convex::ConvexBody> body_of(const std::vector<Vec3>& points,
                                            std::size_t count,
                                            std::uint64_t seed) {
  ConvexPolytope hull = hull_of(points);
  if (hull.vertices.size() > count) {
    Rng rng(seed);
    for (std::size_t i = 0; i < count; ++i) {
      std::swap(hull.vertices[i], hull.vertices[i + rng.below(hull.vertices.size() - i)]);
    }
    hull.vertices.resize(count);
    hull = hull_of(hull.vertices);
  }
  return std::make_unique<convex::ConvexBody>(std::move(hull));
}

double BoneSet::mean_facets() const {
  double sum = 0;
  for (const Bone& b : bones) sum += static_cast<double>(b.body->polytope().facets.size());
  return bones.empty() ? 0 : sum / static_cast<double>(bones.size());
}

BoneSet load_bones(const std::filesystem::path& folder) {
  if (!folder.empty()) check_bones_folder(folder);
  BoneSet set;
  set.source = folder.empty() ? "parametric wrist (simulated)" : folder.filename().string();
  for (const BoneId id : kAllBones) {
    Bone bone;
    bone.name = name_of(id);
    if (folder.empty()) {
      bone.surface.vertices = model_bone(id, kModelVertices).points;
    } else {
      const std::filesystem::path file = folder / (bone.name + ".ply");
      if (!std::filesystem::exists(file)) continue;
      bone.surface = case_io::read_ply(file);
    }
    const std::size_t facets =
        kFewestFacets + (kMostFacets - kFewestFacets) * set.bones.size() / (kAllBones.size() - 1);
    bone.body = body_of(bone.surface.vertices, facets / 2 + 2, set.bones.size());
    set.bones.push_back(std::move(bone));
  }
  if (set.bones.size() < 2) {
    throw IoError(folder.string() + ": holds fewer than two <bone>.ply; give a case's bones");
  }
  return set;
}

std::vector<std::pair<std::size_t, std::size_t>> near_pairs(const BoneSet& set, double reach_mm) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < set.bones.size(); ++i) {
    for (std::size_t j = i + 1; j < set.bones.size(); ++j) {
      const Aabb a = set.bones[i].body->box().grown(reach_mm);
      const Aabb& b = set.bones[j].body->box();
      bool overlap = true;
      for (std::size_t k = 0; k < 3; ++k) {
        overlap = overlap && a.low[k] <= b.high[k] && b.low[k] <= a.high[k];
      }
      if (overlap) pairs.emplace_back(i, j);
    }
  }
  return pairs;
}

}  // namespace carpus::bench
