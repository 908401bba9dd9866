// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Contact of instruments with bones of the reference wrist, against the triangles themselves.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "collision/surface/distance_field.hpp"
#include "collision/surface/exact_surface.hpp"
#include "collision/surface/instrument_contact.hpp"
#include "collision/surface/surface_test_support.hpp"

namespace carpus::collision {
namespace {

using test::amount;

/// A bone of the reference wrist as 32-bit floats give it; empty where that is absent
/// ($CARPUS_REFERENCE_WRIST, default ../shared/reference-wrist). Reads what those files hold and no
/// other PLY.
TriangleMesh reference_bone(const std::string& name) {
  const char* set = std::getenv("CARPUS_REFERENCE_WRIST");  // NOLINT(concurrency-mt-unsafe)
  const std::string folder = set != nullptr ? set : "../shared/reference-wrist";
  std::ifstream file(folder + "/meshes/" + name + ".ply", std::ios::binary);
  std::size_t vertices = 0;
  std::size_t facets = 0;
  for (std::string line; std::getline(file, line) && line != "end_header";) {
    if (line.starts_with("element vertex ")) vertices = std::stoul(line.substr(15));
    if (line.starts_with("element face ")) facets = std::stoul(line.substr(13));
  }
  TriangleMesh mesh;
  for (std::size_t i = 0; i < vertices; ++i) {
    std::array<float, 3> v{};
    file.read(reinterpret_cast<char*>(v.data()), sizeof v);
    mesh.vertices.push_back({v[0], v[1], v[2]});
  }
  for (std::size_t i = 0; i < facets; ++i) {
    std::array<std::int32_t, 3> t{};
    file.get();
    file.read(reinterpret_cast<char*>(t.data()), sizeof t);
    mesh.facets.push_back({static_cast<std::uint32_t>(t[0]), static_cast<std::uint32_t>(t[1]),
                           static_cast<std::uint32_t>(t[2])});
  }
  return mesh;
}

struct Worst {
  double error_mm = 0;       ///< of the gap
  double normal_cosine = 1;  ///< where one part of the surface is nearest
  double point_off_mm = 0;   ///< of the contact point from the surface, likewise
};

/// One instrument near a random vertex, against the triangles.
void compare(const ContactField& field,
             const ExactSurface& exact,
             const InstrumentShape& shape,
             Rng& rng,
             Worst& worst) {
  const auto& vertices = exact.surface().vertices;
  const Vec3 shaft = test::random_direction(rng);
  const Vec3 centre = vertices[rng.below(vertices.size())] +
                      test::random_direction(rng) * rng.uniform(0, 2 * shape.greatest_radius_mm());
  const double z = rng.uniform(shape.front_z_mm(), shape.back_z_mm());
  const Pose<frame::Bone, frame::Tool> pose{test::turned_to(shaft), centre - shaft * z};
  const SurfaceContact contact = find_contact(field, shape, pose, 1.0);
  constexpr double kTolerance = 1e-3;
  const double truth = exact.gap_of(shape, pose, kTolerance).gap_mm;
  ASSERT_NE(contact.outcome, ContactOutcome::NotKnown);
  ASSERT_GE(truth, contact.lowest_gap_mm - 1e-6);
  ASSERT_LE(truth, contact.highest_gap_mm + kTolerance);
  if (contact.outcome == ContactOutcome::Far || contact.outcome == ContactOutcome::Buried) return;
  worst.error_mm = std::max(worst.error_mm, std::abs(contact.gap_mm - truth));
  const Vec3 ball = (pose * Point<frame::Tool>{{0, 0, contact.z_mm}}).v;
  const double distance = exact.signed_distance(ball);
  const auto nearest = TriangleTree(exact.surface()).nearest(ball);
  if (contact.steepness < 0.95 || !nearest) return;
  worst.point_off_mm =
      std::max(worst.point_off_mm, std::abs(exact.signed_distance(contact.point.v)));
  if (std::abs(distance) < 0.3) return;
  const Vec3 normal = (ball - nearest->point) / distance;
  worst.normal_cosine = std::min(worst.normal_cosine, dot(normal, contact.normal.v));
}

TEST(SurfaceContactOracle, AgreesWithTheTrianglesOfReferenceBones) {
  const std::vector<InstrumentShape> shapes{
      InstrumentShape(SphereShape{1.5}), InstrumentShape(CapsuleShape{1.0, 30}),
      InstrumentShape(ConeTipShape{0.57, 1.5, 40}),
      InstrumentShape(ThreadedCylinderShape{1.0, 1.5, 0.8, 24})};
  Rng rng(8);
  std::vector<std::string> names{"scaphoid"};
  if (amount(0, 0, 1) == 1) names = {"scaphoid", "hamate", "radius", "trapezium"};
  for (const std::string& name : names) {
    const TriangleMesh mesh = reference_bone(name);
    if (mesh.facets.empty()) {
      GTEST_SKIP() << "no reference wrist; set CARPUS_REFERENCE_WRIST to its folder";
    }
    const ContactField field(build_distance_field(mesh), mesh);
    const ExactSurface exact(mesh);
    Worst worst;
    for (const InstrumentShape& shape : shapes) {
      for (int i = 0; i < amount(2, 10, 150); ++i) compare(field, exact, shape, rng, worst);
    }
    std::printf("%s: gap off by at most %.4f mm (proved %.3f), point %.4f mm, normal cosine %.4f\n",
                name.c_str(), worst.error_mm, field.error_mm(), worst.point_off_mm,
                worst.normal_cosine);
    EXPECT_LT(worst.error_mm, 0.25);
    EXPECT_LT(worst.point_off_mm, 0.2);
    EXPECT_GT(worst.normal_cosine, 0.9);
  }
}

}  // namespace
}  // namespace carpus::collision
