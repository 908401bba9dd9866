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

#include "contact/instrument_contact.hpp"
#include "fields/distance_field.hpp"
#include "fields/exact_surface.hpp"
#include "fields/surface_test_support.hpp"

namespace carpus::contact {
namespace {

using fields::test::amount;

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

/// How far contacts are off the triangles', of shapes that touch or nearly so.
struct Errors {
  std::vector<double> gap_mm;
  std::vector<double> point_mm;     ///< the contact point's distance from the surface
  std::vector<double> normal_sine;  ///< from outside, where one part of the surface is nearest
};

double quantile(std::vector<double>& values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

/// One instrument near a random vertex, against the triangles.
void compare(const fields::ContactField& field,
             const fields::ExactSurface& exact,
             const InstrumentShape& shape,
             Rng& rng,
             Errors& errors) {
  const auto& vertices = exact.surface().vertices;
  const Vec3 shaft = fields::test::random_direction(rng);
  const Vec3 centre =
      vertices[rng.below(vertices.size())] +
      fields::test::random_direction(rng) * rng.uniform(0, 2 * shape.greatest_radius_mm());
  const double z = rng.uniform(shape.front_z_mm(), shape.back_z_mm());
  const Pose<frame::Bone, frame::Tool> pose{fields::test::turned_to(shaft), centre - shaft * z};
  const SurfaceContact contact = find_contact(field, shape, pose, 1.0);
  constexpr double kTolerance = 1e-3;
  const double truth = exact.gap_of(shape, pose, kTolerance).gap_mm;
  ASSERT_NE(contact.outcome, ContactOutcome::NotKnown);
  ASSERT_GE(truth, contact.lowest_gap_mm - 1e-6);
  ASSERT_LE(truth, contact.highest_gap_mm + kTolerance);
  if (contact.outcome == ContactOutcome::Far || contact.outcome == ContactOutcome::Buried) return;
  errors.gap_mm.push_back(std::abs(contact.gap_mm - truth));
  const Vec3 ball = (pose * Point<frame::Tool>{{0, 0, contact.z_mm}}).v;
  const double distance = exact.signed_distance(ball);
  const auto nearest = exact.tree().nearest(ball);
  if (std::abs(contact.steepness - 1) > 0.03 || distance < 0.3 || !nearest) return;
  errors.point_mm.push_back(std::abs(exact.signed_distance(contact.point.v)));
  errors.normal_sine.push_back(length(cross((ball - nearest->point) / distance, contact.normal.v)));
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
    const fields::ContactField field(fields::build_distance_field(mesh), mesh);
    const fields::ExactSurface exact(mesh);
    Errors errors;
    for (const InstrumentShape& shape : shapes) {
      for (int i = 0; i < amount(2, 10, 100); ++i) compare(field, exact, shape, rng, errors);
    }
    std::printf(
        "%s, half and 95 %% of gaps off by at most %.4f and %.4f mm, all %.4f (proved %.3f);"
        " points %.4f, %.4f mm; normals' sines %.4f, %.4f\n",
        name.c_str(), quantile(errors.gap_mm, 0.5), quantile(errors.gap_mm, 0.95),
        quantile(errors.gap_mm, 1), field.error_mm(), quantile(errors.point_mm, 0.5),
        quantile(errors.point_mm, 0.95), quantile(errors.normal_sine, 0.5),
        quantile(errors.normal_sine, 0.95));
    EXPECT_LE(quantile(errors.gap_mm, 1), field.error_mm() + 1e-3);
    EXPECT_LT(quantile(errors.gap_mm, 0.5), 0.05);
    EXPECT_LT(quantile(errors.point_mm, 0.5), 0.03);
    EXPECT_LT(quantile(errors.normal_sine, 0.5), 0.1);
  }
}

}  // namespace
}  // namespace carpus::contact
