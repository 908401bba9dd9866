// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The printed parts as solids: closed, on the bed, within it, and without roofs that need support.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "core/units.hpp"
#include "geometry/aabb.hpp"
#include "hardware/workshop/assembly.hpp"

namespace carpus::hardware {
namespace {

constexpr double kBedMm = 200;
/// Area of what hangs over by more than 50 degrees and lies higher than the first layers: roofs of
/// small holes and insets that a printer bridges.
constexpr double kMostRoofMm2 = 320;

const Parts& parts() {
  static const Parts kept = read_parts("hardware");
  return kept;
}

double roof_area(const TriangleMesh& mesh, double floor) {
  double sum = 0;
  for (const Triangle& f : mesh.facets) {
    const Vec3& a = mesh.vertices[f[0]];
    const Vec3 n = cross(mesh.vertices[f[1]] - a, mesh.vertices[f[2]] - a);
    const double lowest = std::min({a.z, mesh.vertices[f[1]].z, mesh.vertices[f[2]].z});
    if (n.z < -std::cos(40 * kPi / 180) * length(n) && lowest > floor + 0.5) sum += length(n) / 2;
  }
  return sum;
}

TEST(Parts, AreClosedSolidsThatLieOnTheBed) {
  EXPECT_GE(parts().size(), 24U);
  for (const auto& [name, mesh] : parts()) {
    EXPECT_EQ(check_surface(mesh), SurfaceStatus::Ok) << name;
    const Aabb box = bounds_of(mesh.vertices);
    const Vec3 size = box.extent();
    EXPECT_LE(std::max(size.x, size.y), kBedMm) << name;
    EXPECT_LE(size.z, 120) << name;
    EXPECT_GT(volume_of(mesh), 100) << name;
    double bed = 0;
    for (const Triangle& f : mesh.facets) {
      const Vec3& a = mesh.vertices[f[0]];
      const Vec3 n = cross(mesh.vertices[f[1]] - a, mesh.vertices[f[2]] - a);
      if (std::abs(a.z - box.low.z) < 1e-3 && n.z < -0.999 * length(n)) bed += length(n) / 2;
    }
    EXPECT_GE(bed, 20) << name << " has nothing to stand on";
  }
}

TEST(Parts, NeedNoSupport) {
  for (const auto& [name, mesh] : parts()) {
    EXPECT_LE(roof_area(mesh, bounds_of(mesh.vertices).low.z), kMostRoofMm2) << name;
  }
}

TEST(Parts, AreAllInTheListOfWhatToPrint) {
  std::ifstream in("hardware/bill_of_materials.csv");
  std::ostringstream text;
  text << in.rdbuf();
  for (const auto& [name, mesh] : parts())
    EXPECT_NE(text.str().find(name + ".stl"), std::string::npos) << name;
}

}  // namespace
}  // namespace carpus::hardware
