// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "geometry/triangle_mesh.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace carpus {
namespace {

TriangleMesh tetrahedron(const Vec3& offset = {}) {
  return {{offset, offset + Vec3{1, 0, 0}, offset + Vec3{0, 1, 0}, offset + Vec3{0, 0, 1}},
          {Triangle{0, 2, 1}, Triangle{0, 1, 3}, Triangle{0, 3, 2}, Triangle{1, 2, 3}}};
}

TEST(TriangleMesh, MeasuresATetrahedron) {
  const TriangleMesh mesh = tetrahedron({100, -50, 7});
  EXPECT_EQ(check_surface(mesh), SurfaceStatus::Ok);
  EXPECT_NEAR(volume_of(mesh), 1.0 / 6.0, 1e-15);
  EXPECT_NEAR(area_of(mesh), 1.5 + 0.5 * std::sqrt(3.0), 1e-14);
  EXPECT_NEAR(distance(centroid_of(mesh), {100.25, -49.75, 7.25}), 0.0, 1e-13);
}

TEST(TriangleMesh, NamesWhatIsWrongWithASurface) {
  EXPECT_EQ(check_surface({}), SurfaceStatus::Empty);

  TriangleMesh open = tetrahedron();
  open.facets.pop_back();
  EXPECT_EQ(check_surface(open), SurfaceStatus::OpenOrNonManifold);

  TriangleMesh flipped = tetrahedron();
  std::swap(flipped.facets[0][0], flipped.facets[0][1]);
  EXPECT_EQ(check_surface(flipped), SurfaceStatus::OpenOrNonManifold);

  TriangleMesh bad_index = tetrahedron();
  bad_index.facets[0][0] = 9;
  EXPECT_EQ(check_surface(bad_index), SurfaceStatus::IndexOutOfRange);

  TriangleMesh not_finite = tetrahedron();
  not_finite.vertices[2].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(check_surface(not_finite), SurfaceStatus::NotFinite);
}

TEST(TriangleMesh, FindsTwoBodiesThatShareOneVertex) {
  TriangleMesh two = tetrahedron();
  two.vertices.insert(two.vertices.end(), {Vec3{-1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, -1}});
  two.facets.insert(two.facets.end(),
                    {Triangle{0, 4, 5}, Triangle{0, 6, 4}, Triangle{0, 5, 6}, Triangle{4, 6, 5}});
  EXPECT_EQ(check_surface(two), SurfaceStatus::PinchedVertex);
}

}  // namespace
}  // namespace carpus
