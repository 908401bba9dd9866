// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/skin_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/parallel.hpp"
#include "imaging/gaussian.hpp"
#include "mesh/clip.hpp"
#include "mesh/marching_cubes.hpp"
#include "mesh/simplify.hpp"
#include "reconstruct/bone_surface.hpp"

namespace carpus::reconstruct {
namespace {

constexpr double kSkinHu =
    -480;  // half-way between air (-1000) and soft tissue: where blur leaves the edge
constexpr double kCoarseVoxelMm = 0.9;
constexpr double kSigmaMm = 0.9;
constexpr std::size_t kMostFacets = 12000;
constexpr double kMaxErrorMm = 0.3;
/// Facets that close the limb where it leaves the volume lie half a voxel beyond it.
constexpr double kCapMargin = 0.25;  // voxels
/// Deeper than the bevel of a cap's rim: two coarse voxels.
constexpr double kTrimMm = 2 * kCoarseVoxelMm;

/// Means over blocks of voxels of about kCoarseVoxelMm.
Grid<float> coarsened(const GridView<const std::int16_t>& ct) {
  const GridGeometry& g = ct.geometry();
  std::array<int, 3> block{};
  GridGeometry coarse = g;
  Vec3 first;
  for (std::size_t a = 0; a < 3; ++a) {
    block[a] = std::clamp(static_cast<int>(std::lround(kCoarseVoxelMm / g.spacing[a])), 1,
                          std::max(g.size[a], 1));
    coarse.size[a] = g.size[a] / block[a];
    coarse.spacing[a] = g.spacing[a] * block[a];
    first[a] = (block[a] - 1) / 2.0;
  }
  coarse.origin = g.patient_from_voxel(first);
  Grid<float> result(coarse);
  const double per_block = 1.0 / (block[0] * block[1] * block[2]);
  const auto plane =
      static_cast<std::size_t>(coarse.size[0]) * static_cast<std::size_t>(coarse.size[1]);
  parallel_for(
      static_cast<std::size_t>(coarse.size[2]), 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin * plane; i < end * plane; ++i) {
          const VoxelIndex v = coarse.index_of(i);
          double sum = 0;
          for (int z = 0; z < block[2]; ++z) {
            for (int y = 0; y < block[1]; ++y) {
              for (int x = 0; x < block[0]; ++x) {
                sum += ct[VoxelIndex{v.x * block[0] + x, v.y * block[1] + y, v.z * block[2] + z}];
              }
            }
          }
          result[i] = static_cast<float>(sum * per_block);
        }
      });
  return result;
}

/// Without the facets that lie beyond the same face of the volume with all their corners.
TriangleMesh without_caps(const TriangleMesh& mesh, const GridGeometry& g) {
  const auto beyond = [&](const Vec3& voxel, std::size_t axis, bool high) {
    return high ? voxel[axis] > g.size[axis] - 1 + kCapMargin : voxel[axis] < -kCapMargin;
  };
  TriangleMesh open;
  open.vertices = mesh.vertices;
  for (const Triangle& t : mesh.facets) {
    std::array<Vec3, 3> voxels;
    for (std::size_t k = 0; k < 3; ++k) voxels[k] = g.voxel_from_patient(mesh.vertices[t[k]]);
    bool is_cap = false;
    for (std::size_t axis = 0; axis < 3 && !is_cap; ++axis) {
      for (const bool high : {false, true}) {
        is_cap = is_cap || std::all_of(voxels.begin(), voxels.end(),
                                       [&](const Vec3& v) { return beyond(v, axis, high); });
      }
    }
    if (!is_cap) open.facets.push_back(t);
  }
  return largest_piece(open);
}

}  // namespace

MeshIn<frame::Patient> build_skin_surface(const GridView<const std::int16_t>& ct) {
  const Grid<float> coarse = coarsened(ct);
  if (coarse.values().empty()) return {};
  const Grid<float> smoothed = imaging::gaussian_smooth(coarse.view(), kSigmaMm);
  TriangleMesh skin = largest_piece(mesh::extract_isosurface(smoothed.view(), kSkinHu));
  if (skin.facets.empty()) return {};
  // The Gaussian is smoothing enough; Taubin's filter would round the rims of the caps.
  skin = mesh::simplify(skin, {kMostFacets, kMaxErrorMm}).mesh;
  return MeshIn<frame::Patient>(without_caps(skin, coarse.geometry()));
}

MeshIn<frame::Patient> trimmed_skin(const MeshIn<frame::Patient>& skin,
                                    const GridGeometry& volume) {
  TriangleMesh result = skin;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Vec3 last;
    last[axis] = volume.size[axis] - 1;
    const Vec3 low = volume.patient_from_voxel({});
    const Vec3 high = volume.patient_from_voxel(last);
    const Vec3 inwards = normalized_or(high - low, {});
    if (distance(low, high) <= 2 * kTrimMm) continue;
    result = mesh::clipped(result, low + inwards * kTrimMm, inwards);
    result = mesh::clipped(result, high - inwards * kTrimMm, -inwards);
  }
  return MeshIn<frame::Patient>(largest_piece(result));
}

}  // namespace carpus::reconstruct
