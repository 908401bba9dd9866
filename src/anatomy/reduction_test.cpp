// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "anatomy/reduction.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace carpus::anatomy {
namespace {

/// A rounded bar along z from `low` to `high`, one end a flat fracture face, the other a cap.
MeshIn<frame::Bone> stump(double flat_z, double cap_z) {
  constexpr int kAround = 48;
  constexpr int kRings = 24;
  TriangleMesh mesh;
  const double way = cap_z - flat_z;
  const auto ring = [&](int r) {
    const double t = static_cast<double>(r) / kRings;
    return std::pair(flat_z + way * std::sin(0.5 * 3.14159265 * t),
                     5.0 * std::cos(0.5 * 3.14159265 * t));
  };
  for (int r = 0; r < kRings; ++r) {
    const auto [z, radius] = ring(r);
    for (int i = 0; i < kAround; ++i) {
      const double angle = 2 * 3.14159265 * i / kAround;
      mesh.vertices.push_back({radius * std::cos(angle), 1.3 * radius * std::sin(angle), z});
    }
  }
  const auto index = [&](int r, int i) {
    return static_cast<std::uint32_t>(r * kAround + (i % kAround));
  };
  const auto cap = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back({0, 0, cap_z});
  const auto flat = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back({0, 0, flat_z});
  const bool is_up = way > 0;
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (is_up) {
      mesh.facets.push_back({a, b, c});
    } else {
      mesh.facets.push_back({a, c, b});
    }
  };
  for (int i = 0; i < kAround; ++i) {
    for (int r = 0; r + 1 < kRings; ++r) {
      add(index(r, i), index(r, i + 1), index(r + 1, i));
      add(index(r + 1, i), index(r, i + 1), index(r + 1, i + 1));
    }
    add(index(kRings - 1, i), index(kRings - 1, i + 1), cap);
    add(index(0, i + 1), index(0, i), flat);
  }
  return MeshIn<frame::Bone>(std::move(mesh));
}

MeshIn<frame::Bone> moved(MeshIn<frame::Bone> mesh, const Mat3& rotation, const Vec3& shift) {
  return Pose<frame::Bone, frame::Bone>{rotation, shift} * std::move(mesh);
}

TEST(Reduction, FindsTheFacesOfFragmentsAndHowFarTheyLieApart) {
  const auto first = stump(0.0, -12.0);
  const auto second = moved(stump(0.0, 13.0), Mat3::identity(), {1.8, -0.5, 1.5});
  const auto found = reduction_of(first, second);
  ASSERT_TRUE(found.has_value());
  const FractureOffset as_scanned = found->offset({});
  EXPECT_NEAR(as_scanned.gap_mm, 1.5, 0.02);
  EXPECT_NEAR(as_scanned.step_mm, std::hypot(1.8, 0.5), 0.02);
  EXPECT_NEAR(as_scanned.cosine_angle, 1.0, 1e-3);
  const FractureOffset reduced = found->offset({Mat3::identity(), {-1.8, 0.5, -1.5}});
  EXPECT_NEAR(reduced.gap_mm, 0.0, 0.02);
  EXPECT_NEAR(reduced.step_mm, 0.0, 0.02);
}

TEST(Reduction, TellsTheAngleOfAFlexedFragment) {
  const Mat3 flexed = rotation_about({1, 0, 0}, 0.35);
  const auto found = reduction_of(stump(0.0, -12.0), moved(stump(0.0, 13.0), flexed, {0, 0, 2.5}));
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(std::acos(found->offset({}).cosine_angle), 0.35, 0.02);
  const auto back = flexed.transposed();
  EXPECT_NEAR(found->offset({back, back * Vec3{0, 0, -2.5}}).cosine_angle, 1.0, 2e-4);
}

/// The bar runs 30 degrees off the normal of its fracture.
MeshIn<frame::Bone> sheared(MeshIn<frame::Bone> mesh) {
  for (Vec3& v : mesh.vertices) v.x += 0.577 * v.z;
  return mesh;
}

TEST(Reduction, FacesThatWereOneMeetAgainAcrossAnObliqueBone) {
  const auto first = sheared(stump(0.0, -12.0));
  const auto second = sheared(stump(0.0, 12.0));
  const auto apart = reduction_of(first, moved(second, Mat3::identity(), {0, 0, 2}));
  ASSERT_TRUE(apart.has_value());
  EXPECT_NEAR(apart->offset({}).gap_mm, 2.0, 0.02);
  EXPECT_NEAR(apart->offset({}).step_mm, 0.0, 0.1);
  const auto stepped = reduction_of(first, moved(second, Mat3::identity(), {1.2, 1.8, 2}));
  ASSERT_TRUE(stepped.has_value());
  EXPECT_NEAR(stepped->offset({}).step_mm, std::hypot(1.2, 1.8), 0.1);
}

TEST(Reduction, RimsThatAScanRoundsOffMakeNoStep) {
  // Under an oblique fracture bone runs out sharply on one side of either fragment, and a scan
  // loses it there: the faces' own middles move apart by more than a millimetre.
  const auto bevelled = [](MeshIn<frame::Bone> mesh, double side) {
    for (Vec3& v : mesh.vertices) {
      const double beyond = side * v.x - 2.0;
      if (beyond > 0) v.z = side * std::min(side * v.z, -0.7 * beyond);
    }
    return mesh;
  };
  const auto first = bevelled(sheared(stump(0.0, -12.0)), 1.0);
  const auto second = bevelled(sheared(stump(0.0, 12.0)), -1.0);
  const auto found = reduction_of(first, moved(second, Mat3::identity(), {0, 0, 1.5}));
  ASSERT_TRUE(found.has_value());
  EXPECT_LT(found->offset({}).step_mm, 0.5);
  EXPECT_GT(found->offset({}).cosine_angle, std::cos(0.05));
}

TEST(Reduction, FindsNothingWhereThereIsNoFace) {
  TriangleMesh splinter;
  splinter.vertices = {{0, 0, 20}, {0.5, 0, 20}, {0, 0.5, 20}, {0, 0, 21}};
  splinter.facets = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  EXPECT_FALSE(reduction_of(stump(0.0, -12.0), MeshIn<frame::Bone>(splinter)).has_value());
}

}  // namespace
}  // namespace carpus::anatomy
