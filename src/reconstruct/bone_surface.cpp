// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. A scalar field: +1/2 inside, -1/2 outside, and the CT's own half-maximum measure in the two
// layers of voxels on either side of the label's border, with the label's sign. 2. A slight
// Gaussian.
// 3. Marching cubes at 0. 4. Taubin smoothing. 5. Simplification.
#include "reconstruct/bone_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <optional>
#include <vector>

#include "fields/triangle_tree.hpp"
#include "imaging/binary_mask.hpp"
#include "imaging/gaussian.hpp"
#include "mesh/marching_cubes.hpp"
#include "mesh/self_intersection.hpp"
#include "mesh/simplify.hpp"
#include "mesh/smooth.hpp"

namespace carpus::reconstruct {
namespace {

using Labels = GridView<const std::uint8_t>;

constexpr float kFar = 0.5F;
/// A border voxel is at least this far on its label's side, so that the label's topology holds.
constexpr float kLeast = 0.05F;
/// Voxels around the bone: the field's kernel reaches four sigmas.
constexpr int kMargin = 5;

imaging::VoxelBox box_of(const Labels& labels, std::uint8_t label) {
  const GridGeometry& g = labels.geometry();
  imaging::VoxelBox box{{g.size[0], g.size[1], g.size[2]}, {-1, -1, -1}};
  const auto nx = static_cast<std::size_t>(g.size[0]);
  const std::uint8_t* row = labels.values().data();
  for (int z = 0; z < g.size[2]; ++z) {
    for (int y = 0; y < g.size[1]; ++y, row += nx) {
      const void* const found = std::memchr(row, label, nx);
      if (found == nullptr) continue;
      const auto first = static_cast<int>(static_cast<const std::uint8_t*>(found) - row);
      int last = g.size[0] - 1;
      while (row[last] != label) --last;
      box.low = {std::min(box.low.x, first), std::min(box.low.y, y), std::min(box.low.z, z)};
      box.high = {std::max(box.high.x, last), std::max(box.high.y, y), std::max(box.high.z, z)};
    }
  }
  if (box.high.x < 0) return box;
  box.low = {std::max(0, box.low.x - kMargin), std::max(0, box.low.y - kMargin),
             std::max(0, box.low.z - kMargin)};
  box.high = {std::min(g.size[0] - 1, box.high.x + kMargin),
              std::min(g.size[1] - 1, box.high.y + kMargin),
              std::min(g.size[2] - 1, box.high.z + kMargin)};
  return box;
}

/// @param field  the edge's excess, in whose place the field comes.
Grid<float> scalar_field(const Labels& labels, std::uint8_t label, Grid<float> field) {
  const auto [nx, ny, nz] = labels.geometry().size;
  const auto dy = static_cast<std::size_t>(nx);
  const std::size_t dz = dy * static_cast<std::size_t>(ny);
  std::size_t i = 0;
  for (int z = 0; z < nz; ++z) {
    for (int y = 0; y < ny; ++y) {
      for (int x = 0; x < nx; ++x, ++i) {
        const bool inside = labels[i] == label;
        // A face neighbour is on the other side of the label's border.
        const auto differs = [&](std::size_t j) { return (labels[j] == label) != inside; };
        const bool border = (x > 0 && differs(i - 1)) || (x + 1 < nx && differs(i + 1)) ||
                            (y > 0 && differs(i - dy)) || (y + 1 < ny && differs(i + dy)) ||
                            (z > 0 && differs(i - dz)) || (z + 1 < nz && differs(i + dz));
        if (inside) {
          field[i] = border ? std::clamp(field[i], kLeast, kFar) : kFar;
        } else {
          field[i] = border && labels[i] == 0 ? std::clamp(field[i], -kFar, -kLeast) : -kFar;
        }
      }
    }
  }
  return field;
}

/// A collapse that would leave the manifolds makes simplify stop early; another target takes
/// another way round it. Tried in this order until one arrives near its target.
constexpr std::array<double, 6> kTargets{1.0, 0.93, 1.08, 0.85, 1.2, 0.75};
constexpr double kNearTarget = 1.3;

TriangleMesh simplified(const TriangleMesh& mesh, const BoneSurfaceOptions& options) {
  const double wanted =
      std::clamp(area_of(mesh) * options.facets_per_mm2, static_cast<double>(options.least_facets),
                 static_cast<double>(options.most_facets));
  TriangleMesh best = mesh;
  for (const double factor : kTargets) {
    TriangleMesh candidate =
        mesh::simplify(mesh, {static_cast<std::size_t>(wanted * factor), options.max_error_mm})
            .mesh;
    if (candidate.facets.size() < best.facets.size() &&
        mesh::count_self_intersections(candidate) == 0) {
      best = std::move(candidate);
    }
    if (static_cast<double>(best.facets.size()) < kNearTarget * wanted) break;
  }
  return best;
}

/// Of the vertices of `before` from the surface `after`. Its own vertices are some of those, so
/// that nothing is farther the other way round but in the middle of a facet.
double farthest_mm(const TriangleMesh& before, const TriangleMesh& after) {
  const fields::TriangleTree tree(after);
  double squared = 0;
  std::optional<std::uint32_t> hint;
  for (const Vec3& vertex : before.vertices) {
    if (hint) {
      // No farther than another was: that the facet beside it tells.
      const auto& [a, b, c] = after.facets[*hint];
      const Vec3 beside = fields::nearest_point_on_triangle(vertex, after.vertices[a],
                                                            after.vertices[b], after.vertices[c]);
      if (squared_length(vertex - beside) <= squared) continue;
    }
    const auto found = tree.nearest(vertex, std::numeric_limits<double>::infinity(), hint);
    if (!found) continue;
    hint = found->facet;
    squared = std::max(squared, found->squared_distance);
  }
  return std::sqrt(squared);
}

/// Piece number of each facet; pieces share no vertex.
std::vector<std::uint32_t> pieces_of(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&](std::uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (const Triangle& t : mesh.facets) {
    for (const std::uint32_t v : {t[1], t[2]}) {
      const std::uint32_t a = root(t[0]);
      const std::uint32_t b = root(v);
      parent[std::max(a, b)] = std::min(a, b);
    }
  }
  std::vector<std::uint32_t> result;
  for (const Triangle& t : mesh.facets) result.push_back(root(t[0]));
  return result;
}

}  // namespace

TriangleMesh largest_piece(const TriangleMesh& mesh) {
  if (mesh.facets.empty()) return {};
  const auto pieces = pieces_of(mesh);
  std::vector<double> six_volumes(mesh.vertices.size(), 0.0);
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    const auto& [a, b, c] = mesh.facets[f];
    six_volumes[pieces[f]] += dot(mesh.vertices[a], cross(mesh.vertices[b], mesh.vertices[c]));
  }
  const auto largest = static_cast<std::uint32_t>(
      std::max_element(six_volumes.begin(), six_volumes.end()) - six_volumes.begin());
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number(mesh.vertices.size(), kUnused);
  TriangleMesh piece;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    if (pieces[f] != largest) continue;
    Triangle t = mesh.facets[f];
    for (std::uint32_t& v : t) {
      if (number[v] == kUnused) {
        number[v] = static_cast<std::uint32_t>(piece.vertices.size());
        piece.vertices.push_back(mesh.vertices[v]);
      }
      v = number[v];
    }
    piece.facets.push_back(t);
  }
  return piece;
}

BoneField build_bone_field(const Labels& labels,
                           std::uint8_t label,
                           const GridView<const float>& edge_excess,
                           const BoneSurfaceOptions& options) {
  const imaging::VoxelBox box = box_of(labels, label);
  if (box.high.x < 0) return {};
  const Grid<float> sharp =
      scalar_field(imaging::crop(labels, box).view(), label, imaging::crop(edge_excess, box));
  return {imaging::gaussian_smooth(sharp.view(), options.field_sigma_mm), box.low};
}

MeshIn<frame::Bone> build_bone_surface(const BoneField& field,
                                       const BoneSurfaceOptions& options,
                                       double* simplification_error_mm) {
  if (simplification_error_mm != nullptr) *simplification_error_mm = 0;
  if (field.values.values().empty()) return {};
  TriangleMesh surface = largest_piece(mesh::extract_isosurface(field.values.view(), 0.0));
  if (surface.facets.empty()) return {};
  mesh::SmoothOptions smoothing;
  smoothing.iterations = options.smoothing_pairs;
  smoothing.max_displacement_mm = options.max_smoothing_mm;
  TriangleMesh smoothed = mesh::smooth(surface, smoothing);
  // Marching cubes does not cross itself; what smoothing did to a thin place is not worth a
  // crossing.
  if (mesh::count_self_intersections(smoothed) > 0) smoothed = std::move(surface);
  TriangleMesh fewer = simplified(smoothed, options);
  if (simplification_error_mm != nullptr) *simplification_error_mm = farthest_mm(smoothed, fewer);
  return MeshIn<frame::Bone>(std::move(fewer));
}

void label_by_fields(std::span<const BoneField> fields,
                     std::span<const std::uint8_t> label_of,
                     const GridView<std::uint8_t>& labels) {
  CARPUS_CHECK(fields.size() == label_of.size());
  std::fill(labels.values().begin(), labels.values().end(), std::uint8_t{0});
  // Where two claim a voxel the one is asked that has it: a volume of depths would be the largest.
  const auto depth_of = [&](std::uint8_t label, const VoxelIndex& v) {
    for (std::size_t b = 0; b < fields.size(); ++b) {
      const VoxelIndex& low = fields[b].offset;
      if (label_of[b] == label) return fields[b].values[{v.x - low.x, v.y - low.y, v.z - low.z}];
    }
    return 0.0F;
  };
  for (std::size_t b = 0; b < fields.size(); ++b) {
    const Grid<float>& field = fields[b].values;
    for (std::size_t i = 0; i < field.values().size(); ++i) {
      if (!(field[i] > 0)) continue;
      VoxelIndex v = field.geometry().index_of(i);
      v = {v.x + fields[b].offset.x, v.y + fields[b].offset.y, v.z + fields[b].offset.z};
      const std::size_t j = labels.geometry().offset_of(v);
      if (labels[j] == 0 || field[i] > depth_of(labels[j], v)) labels[j] = label_of[b];
    }
  }
}

}  // namespace carpus::reconstruct
