// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A ball of bone in a simulated CT, its surface of few facets: the CT knows the ball, the facets do
// not. Beside another bone the CT says nothing, and the facets stand.
#include "case_io/bone_normals.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "case_io/surface_file.hpp"
#include "mesh/marching_cubes.hpp"
#include "mesh/normals.hpp"
#include "mesh/simplify.hpp"

namespace carpus::case_io {
namespace {

constexpr double kRadius = 8;

struct Ball {
  Grid<std::int16_t> ct;
  TriangleMesh surface;

  Ball() {
    GridGeometry g;
    g.size = {48, 48, 40};
    g.spacing = {0.5, 0.5, 0.6};
    g.origin = {-11.75, -11.75, -11.7};
    ct = Grid<std::int16_t>(g);
    Grid<float> field(g);
    for (std::size_t i = 0; i < field.values().size(); ++i) {
      const VoxelIndex v = g.index_of(i);
      const Vec3 p = g.patient_from_voxel(
          {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)});
      const double inside = kRadius - length(p);
      field[i] = static_cast<float>(inside);
      ct[i] = static_cast<std::int16_t>(45 + 1000 * std::clamp(0.5 + inside / 1.5, 0.0, 1.0));
    }
    surface = mesh::simplify(mesh::extract_isosurface(field.view(), 0), {160, 2}).mesh;
  }
};

double worst_angle(const TriangleMesh& surface, const std::vector<Vec3>& normals) {
  double worst = 0;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const Vec3 outward = surface.vertices[i] / length(surface.vertices[i]);
    worst = std::max(worst, std::acos(std::min(1.0, dot(normals[i], outward))));
  }
  return worst * 180 / 3.14159265;
}

TEST(BoneNormals, AreTheCtsWhereTheFacetsAreCoarse) {
  const Ball ball;
  const std::vector<Vec3> normals = bone_normals(ball.surface, {}, ball.ct.view());
  EXPECT_LT(worst_angle(ball.surface, normals), 4);
  EXPECT_LT(worst_angle(ball.surface, normals),
            0.5 * worst_angle(ball.surface, mesh::vertex_normals(ball.surface)));
}

TEST(BoneNormals, AreTheFacetsWhereTheCtShowsAnotherEdgeOrNothing) {
  Ball ball;
  for (std::int16_t& value : ball.ct.values()) value = static_cast<std::int16_t>(1100 - value);
  const std::vector<Vec3> of_facets = mesh::vertex_normals(ball.surface);
  const auto expect_facets = [&](const std::vector<Vec3>& normals) {
    for (std::size_t i = 0; i < normals.size(); ++i)
      EXPECT_GT(dot(normals[i], of_facets[i]), 0.9999);
  };
  expect_facets(bone_normals(ball.surface, {}, ball.ct.view()));
  std::fill(ball.ct.values().begin(), ball.ct.values().end(), std::int16_t{45});
  expect_facets(bone_normals(ball.surface, {}, ball.ct.view()));
}

TEST(BoneNormals, StandInTheFilesThatHoldThemAndSurfacesComeBack) {
  const Ball ball;
  const std::vector<Vec3> normals = bone_normals(ball.surface, {}, ball.ct.view());
  const std::filesystem::path folder = ::testing::TempDir();
  for (const char* name : {"normals.ply", "normals.obj"}) {
    write_surface(folder / name, ball.surface, normals);
    const TriangleMesh back = read_surface(folder / name);
    EXPECT_EQ(back.facets, ball.surface.facets) << name;
    ASSERT_EQ(back.vertices.size(), ball.surface.vertices.size());
    EXPECT_EQ(back.vertices[7].x, ball.surface.vertices[7].x);
    std::ifstream stream(folder / name, std::ios::binary);
    const std::string text(std::istreambuf_iterator<char>(stream), {});
    EXPECT_NE(text.find(name == std::string("normals.ply") ? "property float nz" : "\nvn "),
              std::string::npos);
  }
}

}  // namespace
}  // namespace carpus::case_io
