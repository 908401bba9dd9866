// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Cut fields against what is truly left: points of a fine grid that lie in the triangles' surface
// and in no tool.
#include "fields/cut_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "core/amount_test_support.hpp"
#include "fields/cut_bone.hpp"
#include "fields/cut_tissue.hpp"
#include "fields/distance_field.hpp"
#include "fields/exact_surface.hpp"
#include "fields/surface_test_support.hpp"

namespace carpus::fields {
namespace {

using carpus::test::amount;

struct Body {
  explicit Body(const TriangleMesh& surface)
      : mesh(surface),
        bone{ContactField(build_distance_field(mesh, {.spacing_mm = 0.4, .band_mm = 4}), mesh)},
        exact(mesh) {}
  TriangleMesh mesh;
  std::vector<ContactField> bone;
  ExactSurface exact;
};

/// Drills through a body near its vertices, as tools do that are pushed in along their own axis.
std::vector<SweptTool> drill(CutTissue& tissue, const Body& body, int count, Rng& rng) {
  const InstrumentShape wire(ConeTipShape{0.57, 1.5, 30});
  const InstrumentShape reamer(CapsuleShape{1.65, 30});
  std::vector<SweptTool> tools;
  for (int i = 0; i < count; ++i) {
    const Vec3 shaft = test::random_direction(rng);
    const Vec3 vertex = body.mesh.vertices[rng.below(body.mesh.vertices.size())];
    const Vec3 tip = vertex + test::random_shift(rng, 3);
    tools.push_back(SweptTool::whole(i % 2 == 0 ? wire : reamer, {test::turned_to(shaft), tip}, 2));
    EXPECT_EQ(tissue.remove(0, tools.back()).outcome, RemovalOutcome::Removed);
  }
  return tools;
}

double depth_in(const std::vector<SweptTool>& tools, const Vec3& p) {
  double depth = -std::numeric_limits<double>::infinity();
  for (const SweptTool& tool : tools) depth = std::max(depth, -tool.signed_distance(p));
  return depth;
}

TEST(CutField, HoldsTheToolsDepthWithinItsBound) {
  const Body body(test::bowl(24));
  CutTissue tissue(body.bone);
  EXPECT_FALSE(tissue.field(0).is_cut());
  EXPECT_EQ(tissue.field(0).sample({0, 0, -4}), -kCutDepthMm);
  Rng rng(1);
  const auto tools = drill(tissue, body, 4, rng);
  const CutField& cut = tissue.field(0);
  EXPECT_TRUE(cut.is_cut());
  EXPECT_NEAR(cut.error_mm(), 0.1736, 1e-4);
  int near = 0;
  const int count = amount(4000, 20000, 400000);
  for (int i = 0; i < count; ++i) {
    const Vec3 p{rng.uniform(-11, 11), rng.uniform(-11, 11), rng.uniform(-9, 5)};
    const double bone = body.bone[0].sample(p);
    const double c = std::clamp(depth_in(tools, p), -kCutDepthMm, kCutReachMm);
    if (c > -kCutDepthMm) ++near;
    // Where a brick was left out the bone is farther than any tool is deep.
    const double error = bone > c + cut.error_mm() ? 0 : std::abs(cut.sample(p) - c);
    ASSERT_LE(error, cut.error_mm());
    if (bone > c + cut.error_mm()) continue;
    ASSERT_LE(c, std::max(cut.highest_distance(cut.sample(p)), -kCutDepthMm));
  }
  EXPECT_GT(near, count / 20);
}

TEST(CutField, HasASecondBoundThatTightensWithDistance) {
  const Body body(test::box({8, 8, 8}));
  CutTissue tissue(body.bone);
  Rng rng(5);
  const SweptTool tool = SweptTool::bar({-3, 1, 0.3}, 2, {4, -1, 1}, 1.5);
  (void)tissue.remove(0, tool);
  const CutField& cut = tissue.field(0);
  EXPECT_GT(cut.lowest_distance(0.5), 0.46);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 p{rng.uniform(-7, 7), rng.uniform(-7, 7), rng.uniform(-7, 7)};
    const double c = -tool.signed_distance(p);
    if (c < -kCutDepthMm) continue;
    ASSERT_GE(c, cut.lowest_distance(cut.sample(p)));
    ASSERT_LE(c, std::max(cut.highest_distance(cut.sample(p)), -kCutDepthMm));
  }
}

TEST(CutField, TellsWhatIsTrulyLeft) {
  constexpr double kFine = 0.125;
  const double slack = 0.5 * std::sqrt(3.0) * kFine;
  Rng rng(2);
  for (const TriangleMesh& mesh : {test::box({5, 4, 3}), test::torus(5, 2, 16)}) {
    const Body body(mesh);
    CutTissue tissue(body.bone);
    const auto tools = drill(tissue, body, 3, rng);
    const CutBone left{body.bone[0], tissue.field(0)};
    for (int i = 0; i < amount(5, 25, 1500); ++i) {
      // Near a tool's wall or anywhere.
      const Vec3 p =
          body.mesh.vertices[rng.below(body.mesh.vertices.size())] + test::random_shift(rng, 3.5);
      const double reach = 2.0;
      const bool is_bone = body.exact.signed_distance(p) < 0 && depth_in(tools, p) < 0;
      double nearest_other = std::numeric_limits<double>::infinity();
      const int steps = static_cast<int>(reach / kFine);
      for (int z = -steps; z <= steps; ++z) {
        for (int y = -steps; y <= steps; ++y) {
          for (int x = -steps; x <= steps; ++x) {
            const Vec3 way{x * kFine, y * kFine, z * kFine};
            const double far = length(way);
            if (far >= nearest_other || far > reach) continue;
            const Vec3 q = p + way;
            const bool q_bone = depth_in(tools, q) < 0 && body.bone[0].sample(q) < 0.35 &&
                                body.exact.signed_distance(q) < 0;
            if (q_bone != is_bone) nearest_other = far;
          }
        }
      }
      const double highest = left.highest_if_bone(p);
      const double lowest = left.lowest_distance(p);
      if (is_bone) {
        const double depth = std::min(nearest_other, kCutDepthMm);
        ASSERT_LE(lowest, -std::max(depth - slack, 0.0) + 1e-9);
        ASSERT_GE(std::max(highest, -kCutDepthMm), -depth - 1e-9);
      } else {
        ASSERT_LE(lowest, nearest_other + 1e-9);
        ASSERT_GE(highest, 0);
      }
    }
  }
}

TEST(CutField, IsFreeWhereTheSameToolWent) {
  const Body body(test::box({8, 8, 8}));
  Rng rng(3);
  double least = 1;
  for (int i = 0; i < 40; ++i) {
    CutTissue tissue(body.bone);
    const Vec3 shaft = test::random_direction(rng);
    const Vec3 tip = test::random_shift(rng, 3);
    const InstrumentShape wire(CapsuleShape{0.57, 40});
    (void)tissue.remove(0, SweptTool::whole(wire, {test::turned_to(shaft), tip}, 1));
    const CutBone left{body.bone[0], tissue.field(0)};
    for (double z = 0.57; z < 12; z += 0.01) {
      least = std::min(least, left.sample(tip + shaft * z) - 0.57);
    }
  }
  std::printf("wire of 0.57 mm in its own track: deepest false contact %.3f mm (proved %.3f)\n",
              -least, CutTissue(body.bone).field(0).error_mm());
  EXPECT_GE(least, -CutTissue(body.bone).field(0).error_mm());
}

TEST(CutField, ChangesNoFasterThanItSays) {
  const Body body(test::bowl(24));
  CutTissue tissue(body.bone);
  Rng rng(4);
  (void)drill(tissue, body, 4, rng);
  const CutBone left{body.bone[0], tissue.field(0)};
  const double steepest = std::max(body.bone[0].steepest(), tissue.field(0).steepest());
  EXPECT_LE(tissue.field(0).steepest(), 1.005);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 p{rng.uniform(-11, 11), rng.uniform(-11, 11), rng.uniform(-9, 5)};
    const Vec3 d = test::random_shift(rng, 1);
    const double way = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
    ASSERT_LE(std::abs(left.sample(p + d) - left.sample(p)), steepest * way + 1e-9);
  }
}

TEST(CutField, LeavesUncutPlacesAtNothingToTheBit) {
  const Body body(test::box({8, 8, 8}));
  CutTissue tissue(body.bone);
  EXPECT_EQ(tissue.field(0).removed_share({1, 2, 3}, 0.4), 0.0);
  (void)tissue.remove(0, SweptTool::bar({0, 0, 0}, 1, {0, 0, 9}, 1));
  EXPECT_EQ(tissue.field(0).removed_share({4, 2, 3}, 0.4), 0.0);
  EXPECT_EQ(tissue.field(0).removed_share({0, 0, 3}, 0.4), 1.0);
  EXPECT_NEAR(tissue.field(0).removed_share({1, 0, 3}, 0.4), 0.5, 0.1);
  EXPECT_EQ(tissue.field(0).removed_share({1e300, 0, 3}, 0.4), 0.0);
}

}  // namespace
}  // namespace carpus::fields
