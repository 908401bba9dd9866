// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "anatomy/bone_solid.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "core/units.hpp"

namespace carpus {
namespace {

/// A closed tube of 12 sides, or any number, of this radius, from z = 0 to its length.
MeshIn<frame::Bone> prism(const Vec3& foot, double radius, double length, std::uint32_t sides) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double angle = 2 * kPi * i / sides;
    const Vec3 rim{radius * std::cos(angle), radius * std::sin(angle), 0};
    mesh.vertices.push_back(foot + rim);
    mesh.vertices.push_back(foot + rim + Vec3{0, 0, length});
  }
  const std::uint32_t bottom = 2 * sides;
  mesh.vertices.push_back(foot);
  mesh.vertices.push_back(foot + Vec3{0, 0, length});
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t a = 2 * i;
    const std::uint32_t b = 2 * ((i + 1) % sides);
    mesh.facets.push_back({a, b, b + 1});
    mesh.facets.push_back({a, b + 1, a + 1});
    mesh.facets.push_back({b, a, bottom});
    mesh.facets.push_back({a + 1, b + 1, bottom + 1});
  }
  return MeshIn<frame::Bone>(std::move(mesh));
}

double area_of_polygon(double radius, int sides) {
  return 0.5 * sides * radius * radius * std::sin(2 * kPi / sides);
}

TEST(BoneSolid, ASectionOfAWholeBoneIsThatOfItsTriangles) {
  const auto mesh = prism({3, -2, 1}, 5.0, 20.0, 12);
  const std::array fragments{&mesh};
  const BoneSolid solid(fragments);
  const BoneSection across = solid.section_at({4, -1, 8}, {0, 0, 1});
  EXPECT_NEAR(across.area_mm2, area_of_polygon(5, 12), 1e-9);
  EXPECT_NEAR(distance(across.centroid, {3, -2, 8}), 0.0, 1e-9);
  // Slanted, the same outline is stretched.
  const Vec3 slanted = normalized_or({0, 0.6, 0.8}, {});
  const BoneSection oblique = solid.section_at({3, -2, 11}, slanted);
  EXPECT_NEAR(oblique.area_mm2, area_of_polygon(5, 12) / 0.8, 1e-9);
  EXPECT_NEAR(distance(oblique.centroid, {3, -2, 11}), 0.0, 1e-9);
  EXPECT_EQ(solid.section_at({3, -2, 30}, {0, 0, 1}).area_mm2, 0.0) << "the plane misses it";
}

TEST(BoneSolid, OfSeveralOutlinesItTakesTheOneAroundThePoint) {
  MeshIn<frame::Bone> both = prism({0, 0, 0}, 3.0, 10.0, 16);
  const auto other = prism({20, 0, 0}, 4.0, 10.0, 16);
  const auto first = static_cast<std::uint32_t>(both.vertices.size());
  both.vertices.insert(both.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const Triangle& f : other.facets) {
    both.facets.push_back({first + f[0], first + f[1], first + f[2]});
  }
  const std::array fragments{&both};
  const BoneSolid solid(fragments);
  EXPECT_NEAR(solid.section_at({1, 0, 5}, {0, 0, 1}).area_mm2, area_of_polygon(3, 16), 1e-9);
  EXPECT_NEAR(solid.section_at({21, 0, 5}, {0, 0, 1}).area_mm2, area_of_polygon(4, 16), 1e-9);
  EXPECT_NEAR(solid.section_at({14, 0, 5}, {0, 0, 1}).area_mm2, area_of_polygon(4, 16), 1e-9)
      << "outside both: the nearer";
}

TEST(BoneSolid, AGapBelongsToTheSectionAndItsFacesAreNoOutside) {
  const auto near = prism({0, 0, 0}, 5.0, 10.0, 24);
  const auto far = prism({0, 0, 12}, 5.0, 10.0, 24);
  const std::array fragments{&near, &far};
  const BoneSolid solid(fragments);
  const double whole = area_of_polygon(5, 24);
  EXPECT_NEAR(solid.section_at({0, 0, 11}, {0, 0, 1}).area_mm2, whole, 0.25 * whole)
      << "the closing leaves a groove";
  EXPECT_TRUE(solid.encloses({0, 0, 11}));
  EXPECT_TRUE(solid.encloses({0, 0, 5}));
  EXPECT_FALSE(solid.encloses({5.2, 0, 5}));
  EXPECT_FALSE(solid.encloses({0, 0, 22.5}));
  for (const Triangle& f : solid.outer_surface().facets) {
    const Vec3 middle =
        (solid.outer_surface().vertices[f[0]] + solid.outer_surface().vertices[f[1]] +
         solid.outer_surface().vertices[f[2]]) /
        3.0;
    EXPECT_FALSE(std::hypot(middle.x, middle.y) < 2.0 && middle.z > 9.0 && middle.z < 13.0)
        << "a face of the fracture";
  }
}

}  // namespace
}  // namespace carpus
