// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh/label_surfaces.hpp"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/error.hpp"
#include "core/rng.hpp"
#include "mesh/marching_cubes.hpp"

namespace carpus::mesh {
namespace {

/// Corners of all facets, each facet turned so that its least corner is first, in rising order.
std::vector<std::array<std::array<double, 3>, 3>> sorted_facets(const TriangleMesh& mesh) {
  std::vector<std::array<std::array<double, 3>, 3>> facets;
  for (const Triangle& t : mesh.facets) {
    std::array<std::array<double, 3>, 3> f{};
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3& p = mesh.vertices[t[c]];
      // Centres of loops are sums in another order.
      for (std::size_t a = 0; a < 3; ++a) f[c][a] = std::round(p[a] * 1e6);
    }
    std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
    facets.push_back(f);
  }
  std::sort(facets.begin(), facets.end());
  return facets;
}

RC_GTEST_PROP(LabelSurfaces, AreThoseOfEachLabelForItself, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  GridGeometry g;
  for (int& n : g.size) n = static_cast<int>(1 + rng.below(9));
  g.spacing = {0.3, 0.5, 0.7};
  if (rng.uniform() < 0.5) g.direction = Mat3::from_columns({0, 1, 0}, {1, 0, 0}, {0, 0, 1});
  Grid<std::uint16_t> labels(g);
  const std::uint64_t kinds = 1 + rng.below(4);
  const double filled = rng.uniform();
  for (std::uint16_t& label : labels.values()) {
    if (rng.uniform() < filled) label = static_cast<std::uint16_t>(1000 * rng.below(kinds + 1));
  }
  const auto surfaces = extract_label_surfaces(std::as_const(labels).view());
  std::size_t found = 0;
  for (std::uint64_t kind = 1; kind <= kinds; ++kind) {
    const auto label = static_cast<std::uint16_t>(1000 * kind);
    Grid<float> alone(g);
    for (std::size_t i = 0; i < alone.values().size(); ++i) alone[i] = labels[i] == label ? 1 : 0;
    const TriangleMesh expected = extract_isosurface(std::as_const(alone).view(), 0.5);
    if (expected.facets.empty()) continue;
    RC_ASSERT(found < surfaces.size());
    const LabelSurface& surface = surfaces[found++];
    RC_ASSERT(surface.label == label);
    RC_ASSERT(check_surface(surface.mesh) == SurfaceStatus::Ok);
    RC_ASSERT(surface.mesh.vertices.size() == expected.vertices.size());
    RC_ASSERT(sorted_facets(surface.mesh) == sorted_facets(expected));
  }
  RC_ASSERT(found == surfaces.size());
}

TEST(LabelSurfaces, OfNothingAreNone) {
  GridGeometry g;
  g.size = {4, 5, 6};
  const Grid<std::uint16_t> nothing(g);
  EXPECT_TRUE(extract_label_surfaces(nothing.view()).empty());
  EXPECT_THROW((void)extract_label_surfaces(Grid<std::uint16_t>(GridGeometry{}).view()),
               InvalidInput);
}

}  // namespace
}  // namespace carpus::mesh
