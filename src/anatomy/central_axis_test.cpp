// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "anatomy/central_axis.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "core/units.hpp"
#include "geometry/mat3.hpp"

namespace carpus {
namespace {

/// Subdivided octahedron, about 0.02 rad between vertices at level 6.
TriangleMesh unit_sphere(int levels) {
  TriangleMesh mesh{
      {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
      {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle;
    std::vector<Triangle> facets;
    const auto split = [&](std::uint32_t a, std::uint32_t b) {
      const auto key = std::minmax(a, b);
      const auto [it, is_new] =
          middle.try_emplace(key, static_cast<std::uint32_t>(mesh.vertices.size()));
      if (is_new) {
        mesh.vertices.push_back(normalized_or(mesh.vertices[a] + mesh.vertices[b], {0, 0, 1}));
      }
      return it->second;
    };
    for (const auto& [a, b, c] : mesh.facets) {
      const auto ab = split(a, b), bc = split(b, c), ca = split(c, a);
      facets.insert(facets.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.facets = std::move(facets);
  }
  return mesh;
}

TriangleMesh mapped(TriangleMesh mesh, const std::function<Vec3(const Vec3&)>& map) {
  for (Vec3& v : mesh.vertices) v = map(v);
  return mesh;
}

/// Cylinder along z with hemispherical caps.
TriangleMesh capsule(double radius, double half_length) {
  return mapped(unit_sphere(5), [=](const Vec3& v) {
    // Stretches the equator into the wall, so that wall and caps both have vertices.
    const double latitude = std::asin(std::clamp(v.z, -1.0, 1.0)) / (std::numbers::pi / 2);
    const double wall = 0.5;
    const Vec3 ring = normalized_or({v.x, v.y, 0}, {1, 0, 0});
    if (std::abs(latitude) <= wall) {
      return ring * radius + Vec3{0, 0, latitude / wall * half_length};
    }
    const double cap = (std::abs(latitude) - wall) / (1 - wall) * std::numbers::pi / 2;
    const double sign = latitude > 0 ? 1 : -1;
    return ring * (radius * std::cos(cap)) +
           Vec3{0, 0, sign * (half_length + radius * std::sin(cap))};
  });
}

CentralAxis axis_of(std::initializer_list<TriangleMesh> parts, const Vec3& towards_start) {
  std::vector<MeshIn<frame::Bone>> fragments;
  for (const TriangleMesh& part : parts) fragments.emplace_back(part);
  std::vector<const MeshIn<frame::Bone>*> pointers;
  for (const auto& fragment : fragments) pointers.push_back(&fragment);
  const BoneSolid solid(pointers);
  const auto axis = find_central_axis(solid, towards_start);
  EXPECT_TRUE(axis.has_value());
  return axis.value_or(CentralAxis{});
}

double angle_deg(const BoneLine& line, const Vec3& direction) {
  const Vec3 u = normalized_or(line.end - line.start, {});
  return degrees_from_radians(std::atan2(length(cross(u, direction)), dot(u, direction)));
}

double distance_to_line(const Vec3& p, const Vec3& on_line, const Vec3& unit) {
  return length(cross(p - on_line, unit));
}

TEST(CentralAxis, IsTheAxisOfACappedCylinder) {
  const CentralAxis found = axis_of({capsule(4.5, 9.0)}, {0, 0, -1});
  EXPECT_NEAR(found.radius_mm, 4.5, 0.08) << "its ends reach 0.45 mm into the caps";
  EXPECT_LT(angle_deg(found.axis, {0, 0, 1}), 1.0);
  EXPECT_NEAR(found.axis.start.z, -13.5, 0.1);
  EXPECT_NEAR(found.axis.end.z, 13.5, 0.1);
  EXPECT_LT(distance_to_line({0, 0, 0}, found.axis.start, {0, 0, 1}), 0.1);
  EXPECT_LT(distance(found.waist, {0, 0, 0}), 0.1) << "a cylinder has no waist: its middle";
  EXPECT_NEAR(distance(found.longest_line.start, found.longest_line.end), 27.0, 0.1);
}

TEST(CentralAxis, IsTheLongAxisOfAnEllipsoidWithUnequalWidths) {
  const TriangleMesh ellipsoid = mapped(unit_sphere(5), [](const Vec3& v) {
    return Vec3{5.65 * v.x, 4.35 * v.y, 13.5 * v.z};
  });
  const CentralAxis found = axis_of({ellipsoid}, {0, 0, 1});
  EXPECT_NEAR(found.radius_mm, 4.35 * std::sqrt(1 - kCylinderLengthShare * kCylinderLengthShare),
              0.05);
  EXPECT_LT(angle_deg(found.axis, {0, 0, -1}), 1.0) << "start is where towards_start points";
  EXPECT_LT(distance(found.axis.start, {0, 0, 13.5}), 0.15);
  EXPECT_LT(distance(found.axis.end, {0, 0, -13.5}), 0.15);
}

/// Largest clearance over lines parallel to z in the plane y = 0, and where: tried one by one.
std::pair<double, double> widest_upright(const TriangleMesh& mesh, double half_length) {
  double best = 0;
  double best_x = 0;
  for (double x = -3; x <= 3; x += 0.01) {
    double smallest = 1e9;
    for (const Vec3& v : mesh.vertices) {
      if (std::abs(v.z) <= half_length) smallest = std::min(smallest, std::hypot(v.x - x, v.y));
    }
    if (smallest > best) {
      best = smallest;
      best_x = x;
    }
  }
  return {best, best_x};
}

TEST(CentralAxis, OfABentSpindleHalvesItsBend) {
  constexpr double kBendRadius = 40.0;
  const TriangleMesh bent = mapped(unit_sphere(6), [](const Vec3& v) {
    const double angle = 13.5 * v.z / kBendRadius;
    const double radius = kBendRadius + 5.0 * v.x;
    return Vec3{radius * std::cos(angle) - kBendRadius, 5.0 * v.y, radius * std::sin(angle)};
  });
  const CentralAxis found = axis_of({bent}, {0, 0, -1});
  const double half =
      0.5 * kCylinderLengthShare * distance(found.longest_line.start, found.longest_line.end);
  const auto [radius, x] = widest_upright(bent, half);
  EXPECT_LT(angle_deg(found.axis, {0, 0, 1}), 1.0) << "by symmetry";
  EXPECT_NEAR(found.axis.start.y, 0.0, 0.1);
  EXPECT_NEAR(found.radius_mm, radius, 0.05);
  EXPECT_NEAR(0.5 * (found.axis.start.x + found.axis.end.x), x, 0.1);
}

/// An hourglass: radius 5.5 at +-9, waist 4 at z = 1.5.
Vec3 hourglass(const Vec3& v) {
  const double z = 13.5 * v.z;
  const double waist = 4.0 + 1.5 * std::min(1.0, (z - 1.5) * (z - 1.5) / 81.0);
  const double cap = std::sqrt(std::max(0.0, 1 - v.z * v.z * v.z * v.z));
  const Vec3 ring = normalized_or({v.x, v.y, 0}, {1, 0, 0});
  return ring * (waist * cap) + Vec3{0, 0, z};
}

TEST(CentralAxis, FindsTheWaist) {
  const CentralAxis found = axis_of({mapped(unit_sphere(5), hourglass)}, {0, 0, -1});
  EXPECT_LT(angle_deg(found.axis, {0, 0, 1}), 1.0);
  EXPECT_NEAR(found.waist.z, 1.5, 0.6);
  EXPECT_NEAR(found.radius_mm, 4.0, 0.1);
}

/// The part of a capsule beyond z = cut, its face flat: vertices below are drawn up to the cut.
TriangleMesh half_capsule(double cut, double sign) {
  return mapped(capsule(4.5, 9.0), [=](const Vec3& v) {
    if (sign * (v.z - cut) >= 0) return v;
    const double depth = std::clamp((sign * (cut - v.z) - 0.7) / 8.0, 0.0, 1.0);
    return Vec3{v.x * (1 - depth), v.y * (1 - depth), cut};
  });
}

TEST(CentralAxis, BridgesTheGapBetweenTwoFragments) {
  const CentralAxis found = axis_of({half_capsule(-1.2, -1), half_capsule(1.2, 1)}, {0, 0, -1});
  EXPECT_NEAR(found.radius_mm, 4.5, 0.25) << "the rims of the test body are bevelled by 0.2 mm";
  EXPECT_LT(angle_deg(found.axis, {0, 0, 1}), 1.0);
  EXPECT_LT(distance_to_line({0, 0, 0}, found.axis.start, {0, 0, 1}), 0.1);
  EXPECT_NEAR(distance(found.axis.start, found.axis.end), 27.0, 0.1);
  EXPECT_NEAR(distance(found.longest_line.start, found.longest_line.end), 27.0, 0.1);
}

TEST(CentralAxis, MovesWithTheBone) {
  const TriangleMesh bone = mapped(unit_sphere(5), [](const Vec3& v) {
    const Vec3 h = hourglass(v);
    return Vec3{h.x + 0.02 * h.z * h.z, 1.2 * h.y, h.z};
  });
  const CentralAxis still = axis_of({bone}, {0, 0, -1});
  for (const double angle : {0.7, 2.1, 4.4}) {
    const Mat3 turn = rotation_about(normalized_or({1, -2, 0.5}, {}), angle);
    const Vec3 shift{31.7, -12.3, 201.9};
    const CentralAxis moved = axis_of(
        {mapped(bone, [&](const Vec3& v) { return turn * v + shift; })}, turn * Vec3{0, 0, -1});
    EXPECT_NEAR(moved.radius_mm, still.radius_mm, 0.02);
    EXPECT_LT(distance(moved.axis.start, turn * still.axis.start + shift), 0.15);
    EXPECT_LT(distance(moved.axis.end, turn * still.axis.end + shift), 0.15);
  }
}

TEST(CentralAxis, IsTheSameEachTime) {
  const TriangleMesh bone = mapped(unit_sphere(4), hourglass);
  const CentralAxis a = axis_of({bone}, {0, 0, 1});
  const CentralAxis b = axis_of({bone}, {0, 0, 1});
  EXPECT_EQ(a.axis.start, b.axis.start);
  EXPECT_EQ(a.axis.end, b.axis.end);
}

}  // namespace
}  // namespace carpus
