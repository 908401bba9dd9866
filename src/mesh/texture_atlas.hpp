// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Texture coordinates for a closed surface, and a bitmap painted through them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace carpus::mesh {

/// A surface cut into charts that lie flat in a square bitmap. Each facet lies in one chart; a
/// vertex at the border of charts stands once for each.
struct TextureAtlas {
  int side = 0;                           ///< texels of the bitmap's side
  std::vector<std::uint32_t> sources;     ///< by atlas vertex: the vertex of the surface
  std::vector<std::array<double, 2>> uv;  ///< by atlas vertex: to the right and down, 0 to 1
  std::vector<Triangle> facets;           ///< of atlas vertices, as the surface's facets
  std::size_t charts = 0;
  double texels_per_mm = 0;
};

/// Facets that look along the same of six directions and hang together make a chart, which is
/// projected along that direction; a few facets by themselves go with their neighbours where they
/// are seen from there too. Charts lie in rows, the tallest first, as large as fits.
/// Lengths shrink by at most the cosine of a facet's slope (0.2).
/// @param gap  texels between charts at least, so that a bitmap may be smoothed by so much.
/// @throws InvalidInput for a surface without facets, and where the bitmap is too small for as many
/// charts.
[[nodiscard]] TextureAtlas make_texture_atlas(const TriangleMesh& surface, int side, int gap = 4);

/// Paints what a function of the place says, so that no seam shows where charts meet: both sides
/// are painted by the same function. Texels beside a chart take their neighbour's value, the rest
/// the mean.
/// @param value  of a point of the surface and the facet's unit normal.
/// @return side * side values, row by row from the top.
[[nodiscard]] std::vector<std::uint8_t> paint_texture(
    const TextureAtlas& atlas,
    const TriangleMesh& surface,
    const std::function<std::uint8_t(const Vec3& point, const Vec3& normal)>& value);

}  // namespace carpus::mesh
