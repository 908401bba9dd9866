// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "fields/contact_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/amount_test_support.hpp"
#include "core/error.hpp"
#include "fields/distance_field.hpp"
#include "fields/exact_surface.hpp"
#include "fields/surface_test_support.hpp"

namespace carpus::fields {
namespace {

using carpus::test::amount;

ContactField contact_field(const TriangleMesh& mesh, const DistanceFieldOptions& options) {
  return {build_distance_field(mesh, options), mesh};
}
constexpr DistanceFieldOptions kCoarse{.spacing_mm = 0.8, .band_mm = 4};

TEST(ContactField, SaysWhatTheGridSaysUpToItsRounding) {
  const TriangleMesh mesh = test::bowl(24);
  const Grid<float> grid = build_distance_field(mesh, kCoarse);
  const ContactField field(grid, mesh);
  Rng rng(1);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 p{rng.uniform(-14.3, 14.3), rng.uniform(-14.3, 14.3), rng.uniform(-12.3, 7.8)};
    const DistanceSample sample = sample_distance(grid, p);
    if (!sample.is_inside_grid) continue;
    ASSERT_NEAR(field.sample(p), sample.distance_mm, 1e-4);
  }
  EXPECT_EQ(field.sample({100, 0, 0}), field.reach_mm());
  EXPECT_EQ(field.sample({std::numeric_limits<double>::quiet_NaN(), 0, 0}), field.reach_mm());
}

/// The worst error of samples around the surface, relative to the first bound; each sample keeps
/// both bounds.
double worst_error(const TriangleMesh& mesh, double spacing_mm) {
  const ContactField field = contact_field(mesh, {.spacing_mm = spacing_mm, .band_mm = 4});
  const ExactSurface exact(mesh);
  Rng rng(2);
  double worst = 0;
  for (int i = 0; i < amount(200, 1000, 40000); ++i) {
    const Vec3 p{rng.uniform(-14, 14), rng.uniform(-14, 14), rng.uniform(-12, 8)};
    const double truth = exact.signed_distance(p);
    const double sample = field.sample(p);
    if (sample == field.reach_mm()) {  // outside the grid
      EXPECT_GE(truth, field.reach_mm());
      continue;
    }
    const double clamped = std::clamp(truth, -field.band_mm(), field.band_mm());
    worst = std::max(worst, std::abs(sample - clamped));
    EXPECT_GE(clamped, field.lowest_distance(sample));
    EXPECT_LE(clamped, field.highest_distance(sample));
  }
  EXPECT_LE(worst, field.error_mm());
  return worst / field.error_mm();
}

TEST(ContactField, KeepsBothBoundsOfItsErrorEverywhere) {
  for (const double spacing : {0.5, 1.0}) {
    for (const TriangleMesh& mesh : {test::torus(8, 3, 24), test::bowl(24), test::box({5, 3, 1})}) {
      EXPECT_LT(worst_error(mesh, spacing), 0.75);  // only the distance to a point attains it
    }
  }
}

TEST(ContactField, HasABoundThatIsAttained) {
  // Four nodes and four: the distance to a small body in the middle of a cell. What remains of the
  // bound is the body's own size.
  const TriangleMesh speck = test::box({0.01, 0.01, 0.01});
  const ContactField field = contact_field(speck, {.spacing_mm = 1.6, .band_mm = 4});
  double worst = 0;
  const ExactSurface exact(speck);
  for (int i = 0; i < 125; ++i) {
    const Vec3 p{0.4 * (i % 5 - 2), 0.4 * (i / 5 % 5 - 2), 0.4 * (i / 25 - 2)};
    worst = std::max(worst, std::abs(field.sample(p) - exact.signed_distance(p)));
  }
  EXPECT_LE(worst, field.error_mm());
  EXPECT_GT(worst, 0.2 * field.error_mm());
}

TEST(ContactField, HasASecondBoundThatTightensWithDistance) {
  const ContactField field =
      contact_field(test::torus(3, 1, 16), {.spacing_mm = 0.4, .band_mm = 4});
  EXPECT_NEAR(field.error_mm(), 0.3464, 1e-3);
  EXPECT_LT(field.lowest_distance(0.1), -0.2);
  EXPECT_NEAR(field.lowest_distance(1.0), std::sqrt(1 - 0.12), 1e-3);
  EXPECT_NEAR(field.lowest_distance(3.0), 2.98, 1e-2);
  double last = -1e9;
  for (int i = -400; i <= 400; ++i) {
    const double f = 0.01 * i;
    ASSERT_GE(field.lowest_distance(f), last);
    ASSERT_LE(field.lowest_distance(f), f);
    ASSERT_GE(field.highest_distance(f), f);
    last = field.lowest_distance(f);
  }
}

TEST(ContactField, ChangesNoFasterThanItSays) {
  const ContactField field = contact_field(test::bowl(24), kCoarse);
  EXPECT_LE(field.steepest(), 1.0015);
  Rng rng(3);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 p{rng.uniform(-12, 12), rng.uniform(-12, 12), rng.uniform(-10, 6)};
    const Vec3 d{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)};
    const double way = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
    ASSERT_LE(std::abs(field.sample(p + d) - field.sample(p)), field.steepest() * way + 1e-12);
  }
}

TEST(ContactField, TakesLessMemoryThanItsGrid) {
  const TriangleMesh mesh = test::bowl(24);
  const Grid<float> grid = build_distance_field(mesh, kCoarse);
  const ContactField field(grid, mesh);
  EXPECT_LT(field.byte_count(), grid.values().size() * sizeof(float));
}

TEST(ContactField, RefusesWhatIsNotAFieldOfTheSurface) {
  const TriangleMesh mesh = test::torus(6, 2, 16);
  const Grid<float> good = build_distance_field(mesh, {.spacing_mm = 0.8, .band_mm = 3});
  EXPECT_NO_THROW(ContactField(good, mesh));
  EXPECT_THROW(ContactField({}, mesh), InvalidInput);
  EXPECT_THROW(ContactField(good, TriangleMesh{}), InvalidInput);
  EXPECT_THROW(ContactField(good, test::torus(6, 1, 16)), InvalidInput);  // another surface
  EXPECT_THROW(ContactField(good, test::torus(9, 2, 16)), InvalidInput);  // not around it

  GridGeometry stretched = good.geometry();
  stretched.spacing.z = 0.9;
  EXPECT_THROW(ContactField({stretched, {good.values().begin(), good.values().end()}}, mesh),
               InvalidInput);
  GridGeometry turned = good.geometry();
  turned.direction = rotation_about({0, 0, 1}, 0.5);
  EXPECT_THROW(ContactField({turned, {good.values().begin(), good.values().end()}}, mesh),
               InvalidInput);
  Grid<float> steep = good;
  for (float& v : steep.values()) v *= 1.01F;
  EXPECT_THROW(ContactField(steep, mesh), InvalidInput);
  Grid<float> holed = good;
  holed[good.values().size() / 2] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(ContactField(holed, mesh), InvalidInput);
}

}  // namespace
}  // namespace carpus::fields
