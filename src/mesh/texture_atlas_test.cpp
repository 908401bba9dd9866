// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh/texture_atlas.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/error.hpp"
#include "geometry/grid.hpp"
#include "mesh/marching_cubes.hpp"

namespace carpus::mesh {
namespace {

/// A knobbly body of about 20 mm with a waist, as a bone.
TriangleMesh bone_like() {
  GridGeometry g;
  g.size = {48, 40, 56};
  g.spacing = {0.5, 0.5, 0.5};
  Grid<float> field(g);
  for (int z = 0; z < g.size[2]; ++z) {
    for (int y = 0; y < g.size[1]; ++y) {
      for (int x = 0; x < g.size[0]; ++x) {
        const Vec3 p = g.patient_from_voxel(
            {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
        const double a = 6 - length(p - Vec3{9, 9, 8});
        const double b = 7 - length(p - Vec3{13, 10, 18});
        const double knob = 3 - length(p - Vec3{6, 12, 14});
        field[VoxelIndex{x, y, z}] = static_cast<float>(std::max({a, b, knob}));
      }
    }
  }
  return extract_isosurface(std::as_const(field).view(), 0);
}

TEST(TextureAtlas, EveryFacetHasAPlaceWithinTheBitmapAndKeepsItsSense) {
  const TriangleMesh bone = bone_like();
  const TextureAtlas atlas = make_texture_atlas(bone, 256);
  ASSERT_EQ(atlas.facets.size(), bone.facets.size());
  for (std::size_t f = 0; f < bone.facets.size(); ++f) {
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(atlas.sources[atlas.facets[f][i]], bone.facets[f][i]);
    }
  }
  for (const auto& uv : atlas.uv) {
    for (const double c : uv) {
      EXPECT_GT(c, 0);
      EXPECT_LT(c, 1);
    }
  }
  EXPECT_LE(atlas.charts, 16U) << "few seams";
  EXPECT_LT(atlas.sources.size(), bone.vertices.size() * 5 / 4);
  EXPECT_GT(atlas.texels_per_mm, 4);
}

TEST(TextureAtlas, HardlyAnyTexelBelongsToTwoPlaces) {
  const TriangleMesh bone = bone_like();
  const TextureAtlas atlas = make_texture_atlas(bone, 256);
  std::map<std::pair<int, int>, Vec3> claimed;  // by texel, the middle of a facet that lies there
  std::size_t twice = 0;
  for (const Triangle& t : atlas.facets) {
    double u = 0;
    double v = 0;
    Vec3 middle;
    for (const std::uint32_t c : t) {
      u += atlas.uv[c][0] / 3;
      v += atlas.uv[c][1] / 3;
      middle = middle + bone.vertices[atlas.sources[c]] * (1.0 / 3);
    }
    const std::pair texel{static_cast<int>(u * 256), static_cast<int>(v * 256)};
    const auto [there, is_new] = claimed.try_emplace(texel, middle);
    if (!is_new && distance(there->second, middle) > 1.5) ++twice;
  }
  EXPECT_LT(static_cast<double>(twice), 0.005 * static_cast<double>(atlas.facets.size()));
}

TEST(TextureAtlas, MostOfTheBitmapIsUsed) {
  const TriangleMesh bone = bone_like();
  const TextureAtlas atlas = make_texture_atlas(bone, 256);
  std::size_t painted = 0;
  (void)paint_texture(atlas, bone, [&](const Vec3&, const Vec3&) {
    ++painted;
    return std::uint8_t{0};
  });
  EXPECT_GT(painted, std::size_t{256 * 256} / 3);
}

double sample(const std::vector<std::uint8_t>& texels, int side, const std::array<double, 2>& uv) {
  const double x = uv[0] * side - 0.5;
  const double y = uv[1] * side - 0.5;
  const int x0 = static_cast<int>(std::floor(x));
  const int y0 = static_cast<int>(std::floor(y));
  const auto value = [&](int i, int j) {
    i = std::clamp(i, 0, side - 1);
    j = std::clamp(j, 0, side - 1);
    return static_cast<double>(texels[static_cast<std::size_t>(j) * static_cast<std::size_t>(side) +
                                      static_cast<std::size_t>(i)]);
  };
  const double fx = x - x0;
  const double fy = y - y0;
  return (1 - fx) * (1 - fy) * value(x0, y0) + fx * (1 - fy) * value(x0 + 1, y0) +
         (1 - fx) * fy * value(x0, y0 + 1) + fx * fy * value(x0 + 1, y0 + 1);
}

TEST(TextureAtlas, NoSeamShowsWhereChartsMeet) {
  const TriangleMesh bone = bone_like();
  const TextureAtlas atlas = make_texture_atlas(bone, 256);
  // Some 25 grey levels in a mm: where a chart were out of place by a mm, one would see it.
  const auto grey = [](const Vec3& p, const Vec3&) {
    return static_cast<std::uint8_t>(128 +
                                     60 * std::sin(0.4 * p.x) * std::cos(0.4 * p.y + p.z / 3));
  };
  const auto texels = paint_texture(atlas, bone, grey);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::array<double, 2>>> edges;
  for (const Triangle& t : atlas.facets) {
    for (std::size_t e = 0; e < 3; ++e) {
      const std::uint32_t a = t[e];
      const std::uint32_t b = t[(e + 1) % 3];
      const auto key = std::minmax(atlas.sources[a], atlas.sources[b]);
      edges[{key.first, key.second}].push_back(
          {(atlas.uv[a][0] + atlas.uv[b][0]) / 2, (atlas.uv[a][1] + atlas.uv[b][1]) / 2});
    }
  }
  std::size_t seams = 0;
  double worst = 0;
  for (const auto& [vertices, places] : edges) {
    ASSERT_EQ(places.size(), 2U);
    if (std::hypot(places[0][0] - places[1][0], places[0][1] - places[1][1]) < 1e-9) continue;
    ++seams;
    worst =
        std::max(worst, std::abs(sample(texels, 256, places[0]) - sample(texels, 256, places[1])));
  }
  EXPECT_GT(seams, 50U);
  EXPECT_LT(worst, 10) << "grey levels: less than half a millimetre";
}

TEST(TextureAtlas, WhatCannotBeIsRefused) {
  EXPECT_THROW((void)make_texture_atlas({}, 256), InvalidInput);
  EXPECT_THROW((void)make_texture_atlas(bone_like(), 16), InvalidInput);
}

}  // namespace
}  // namespace carpus::mesh
