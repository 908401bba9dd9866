// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Contact with what is left of a bone that was drilled, against points of a fine grid that lie in
// the bone and in no tool.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "contact/instrument_contact.hpp"
#include "contact/instrument_scene.hpp"
#include "core/allocation_test_support.hpp"
#include "core/amount_test_support.hpp"
#include "fields/cut_tissue.hpp"
#include "fields/distance_field.hpp"
#include "fields/surface_test_support.hpp"

namespace carpus::contact {
namespace {

using carpus::test::amount;
using fields::CutBone;
using fields::CutTissue;
using fields::RemovalOutcome;
using fields::test::random_direction;
using fields::test::random_shift;
using fields::test::turned_to;
using ToolPose = Pose<frame::Bone, frame::Tool>;

constexpr Vec3 kHalf{6, 5, 4};
constexpr double kFine = 0.15;

const std::vector<InstrumentShape>& instruments() {
  static const std::vector<InstrumentShape> kAll{
      InstrumentShape(SphereShape{1.0}), InstrumentShape(CapsuleShape{0.5, 14}),
      InstrumentShape(ConeTipShape{0.57, 1.5, 20}),
      InstrumentShape(ThreadedCylinderShape{1.0, 1.5, 0.8, 10})};
  return kAll;
}

/// A block about the origin; a second one, for scenes.
const std::vector<fields::ContactField>& bones() {
  static const std::vector<fields::ContactField> kBones = [] {
    std::vector<fields::ContactField> all;
    for (const Vec3& half : {kHalf, Vec3{4, 4, 4}}) {
      const TriangleMesh mesh = fields::test::box(half);
      all.emplace_back(fields::build_distance_field(mesh, {.spacing_mm = 0.4, .band_mm = 4}), mesh);
    }
    return all;
  }();
  return kBones;
}

double distance_to_block(const Vec3& p) {
  const Vec3 q{std::abs(p.x) - kHalf.x, std::abs(p.y) - kHalf.y, std::abs(p.z) - kHalf.z};
  const Vec3 out{std::max(q.x, 0.0), std::max(q.y, 0.0), std::max(q.z, 0.0)};
  return length(out) + std::min(std::max({q.x, q.y, q.z}), 0.0);
}

/// The block, what was drilled out of it, and grid points of what is left.
struct Drilled {
  explicit Drilled(std::uint64_t seed) : tissue(bones()) {
    Rng rng(seed);
    for (int i = 0; i < 3; ++i) {
      const Vec3 tip = random_shift(rng, 4);
      tools.push_back(
          SweptTool::whole(i == 0 ? InstrumentShape(CapsuleShape{1.65, 30}) : instruments()[2],
                           {turned_to(random_direction(rng)), tip}, 2));
      EXPECT_EQ(tissue.remove(0, tools.back()).outcome, RemovalOutcome::Removed);
    }
    for (double x = -kHalf.x; x <= kHalf.x; x += kFine) {
      for (double y = -kHalf.y; y <= kHalf.y; y += kFine) {
        for (double z = -kHalf.z; z <= kHalf.z; z += kFine) {
          if (depth_in_tools({x, y, z}) < 0) left.push_back({x, y, z});
        }
      }
    }
  }
  [[nodiscard]] double depth_in_tools(const Vec3& p) const {
    double depth = -std::numeric_limits<double>::infinity();
    for (const SweptTool& tool : tools) depth = std::max(depth, -tool.signed_distance(p));
    return depth;
  }
  [[nodiscard]] CutBone bone() const { return {bones()[0], tissue.field(0)}; }

  /// The true gap is at most this, and by at most the grid's step smaller.
  [[nodiscard]] double gap_of(const InstrumentShape& shape, const ToolPose& pose) const {
    double least = std::numeric_limits<double>::infinity();
    const ToolPose& p = pose;
    const Pose<frame::Tool, frame::Bone> tool_from_bone = p.inverse();
    for (const Vec3& q : left) {
      const Vec3 in_tool = (tool_from_bone * Point<frame::Bone>{q}).v;
      // Balls whose centres lie in bone come below.
      least =
          std::min(least, std::max(shape.signed_distance(in_tool), -shape.radius_at(in_tool.z)));
    }
    constexpr int kSteps = 400;
    for (int i = 0; i <= kSteps; ++i) {
      const double z = shape.front_z_mm() + (shape.back_z_mm() - shape.front_z_mm()) * i / kSteps;
      const Vec3 c = (p * Point<frame::Tool>{{0, 0, z}}).v;
      const double g = std::max(distance_to_block(c), depth_in_tools(c));
      if (g < 0) least = std::min(least, g - shape.radius_at(z));
    }
    return least;
  }

  CutTissue tissue;
  std::vector<SweptTool> tools;
  std::vector<Vec3> left;
};

/// Near the walls of tools or of the block.
ToolPose pose_near(const Drilled& drilled, const InstrumentShape& shape, Rng& rng) {
  const Vec3 shaft = random_direction(rng);
  Vec3 centre;
  if (rng.below(2) == 0) {
    const SweptTool& tool = drilled.tools[rng.below(drilled.tools.size())];
    centre = tool.origin() + tool.axis() * rng.uniform(0, 8) + random_shift(rng, 2);
  } else {
    centre = random_direction(rng) * rng.uniform(4, 9);
  }
  return {turned_to(shaft), centre - shaft * rng.uniform(shape.front_z_mm(), shape.back_z_mm())};
}

TEST(CutContact, LiesWithinItsBoundsForAnyPose) {
  Rng rng(1);
  const double slack = 0.5 * std::sqrt(3.0) * kFine + 0.03;
  int bounded = 0;
  int touching = 0;
  int unbounded = 0;
  for (int seed = 0; seed < amount(2, 3, 40); ++seed) {
    const Drilled drilled(static_cast<std::uint64_t>(seed) + 100);
    for (const InstrumentShape& shape : instruments()) {
      for (int i = 0; i < amount(10, 20, 300); ++i) {
        const ToolPose pose = pose_near(drilled, shape, rng);
        const SurfaceContact contact = find_contact(drilled.bone(), shape, pose, 1.5);
        ASSERT_NE(contact.outcome, ContactOutcome::NotKnown);
        const double truth = drilled.gap_of(shape, pose);
        ASSERT_LE(contact.lowest_gap_mm, truth + 1e-6);
        ASSERT_GE(contact.highest_gap_mm, truth - slack);
        if (contact.outcome == ContactOutcome::Far) continue;
        if (contact.outcome != ContactOutcome::Buried) {
          ASSERT_LE(contact.gap_mm, truth + drilled.bone().error_mm());
        }
        ASSERT_GE(contact.highest_gap_mm, contact.gap_mm - drilled.bone().error_mm());
        touching += contact.has_contact() ? 1 : 0;
        ++(std::isfinite(contact.highest_gap_mm) ? bounded : unbounded);
      }
    }
  }
  std::printf("%d near or touching (%d), %d of them with no upper bound\n", bounded + unbounded,
              touching, unbounded);
  EXPECT_GT(touching, amount(20, 100, 1000));
  EXPECT_GT(bounded, 3 * unbounded);
}

TEST(CutContact, FindsTheLeastGapOfTheFieldsThemselves) {
  Rng rng(2);
  for (int seed = 0; seed < amount(1, 3, 20); ++seed) {
    const Drilled drilled(static_cast<std::uint64_t>(seed) + 200);
    for (const InstrumentShape& shape : instruments()) {
      for (int i = 0; i < amount(20, 100, 1000); ++i) {
        const ToolPose pose = pose_near(drilled, shape, rng);
        const SurfaceContact contact = find_contact(drilled.bone(), shape, pose, 1.5);
        constexpr int kSteps = 1500;
        double least = 1.5;
        for (int s = 0; s <= kSteps; ++s) {
          const double z =
              shape.front_z_mm() + (shape.back_z_mm() - shape.front_z_mm()) * s / kSteps;
          const Vec3 p = pose.translation + pose.rotation.column(2) * z;
          least = std::min(least, drilled.bone().sample(p) - shape.radius_at(z));
        }
        if (contact.outcome == ContactOutcome::Far) {
          ASSERT_GE(least, 1.5 - 1e-4);
          continue;
        }
        const double step = (shape.back_z_mm() - shape.front_z_mm()) / kSteps;
        ASSERT_LE(contact.gap_mm, least + 2e-4);
        ASSERT_GE(contact.gap_mm, least - 2.5 * step - 2e-4);
      }
    }
  }
}

TEST(CutContact, LetsAToolBackIntoItsTrack) {
  Rng rng(3);
  const InstrumentShape wire(ConeTipShape{0.57, 1.5, 40});
  double worst = 0;
  for (int i = 0; i < amount(5, 20, 300); ++i) {
    const Mat3 turn = turned_to(random_direction(rng));
    const Vec3 tip = random_shift(rng, 2.5);
    CutTissue tissue(bones());
    CutTissue wide(bones());
    ASSERT_EQ(tissue.remove(0, SweptTool::whole(wire, {turn, tip}, 15)).outcome,
              RemovalOutcome::Removed);
    (void)wide.remove(0, SweptTool::whole(wire, {turn, tip}, 15).widened(0.15));
    for (double out = 0; out < 15; out += 0.4) {
      const ToolPose pose{turn, tip + turn.column(2) * out};
      EXPECT_EQ(tissue.remove(0, SweptTool::advance(wire, pose, 0.05)).outcome,
                RemovalOutcome::Nothing);
      const SurfaceContact contact =
          find_contact(CutBone{bones()[0], tissue.field(0)}, wire, pose, 0.0);
      worst = std::max(worst, contact.depth_mm());
      ASSERT_FALSE(find_contact(CutBone{bones()[0], wide.field(0)}, wire, pose, 0.0).has_contact());
    }
  }
  std::printf("a wire back in its track feels at most %.3f mm\n", worst);
  EXPECT_LE(worst, CutTissue(bones()).field(0).error_mm());
  EXPECT_GT(find_contact(bones()[0], wire, {turned_to({0, 0, 1}), {0, 0, 0}}).depth_mm(), 3);
}

TEST(CutContact, IsThatOfTheWholeBoneWhereNothingWasCut) {
  Rng rng(4);
  CutTissue tissue(bones());
  const Drilled drilled(1);
  for (const InstrumentShape& shape : instruments()) {
    for (int i = 0; i < 100; ++i) {
      const ToolPose pose = pose_near(drilled, shape, rng);
      const SurfaceContact a = find_contact(bones()[0], shape, pose, 1.0);
      const SurfaceContact b = find_contact(CutBone{bones()[0], tissue.field(0)}, shape, pose, 1.0);
      ASSERT_EQ(a.gap_mm, b.gap_mm);
      ASSERT_EQ(a.highest_gap_mm, b.highest_gap_mm);
      ASSERT_EQ(a.patch.area_mm2, b.patch.area_mm2);
    }
  }
}

TEST(CutContact, IsTheSameInASceneThatDrillsAsFromScratch) {
  Rng rng(5);
  CutTissue tissue(bones());
  const std::vector<Pose<frame::Patient, frame::Bone>> at{{Mat3::identity(), {}},
                                                          {Mat3::identity(), {12, 0, 0}}};
  InstrumentScene scene(bones(), instruments(), {.within_mm = 0.5, .look_ahead_mm = 1.0});
  scene.set_cuts(tissue.fields());
  std::vector<Pose<frame::Patient, frame::Tool>> poses(
      instruments().size(), {turned_to(normalized_or({1, 1, 2}, {})), {7, 7, 9}});
  std::uint64_t hits = 0;
  for (int tick = 0; tick < amount(100, 600, 5000); ++tick) {
    for (auto& pose : poses) pose.translation += random_shift(rng, 0.4) - pose.translation * 0.01;
    if (tick % 50 == 10) tissue.checkpoint();
    if (tick % 5 == 0) {
      const std::size_t bone = rng.below(2);
      const ToolPose pose = at[bone].inverse() * poses[2];
      (void)tissue.remove(bone, SweptTool::whole(instruments()[2], pose, 1));
    }
    if (tick % 100 == 99 && tissue.undo()) scene.forget();
    scene.update(at, poses);
    InstrumentScene fresh(bones(), instruments(), {.within_mm = 0.5, .look_ahead_mm = 1.0});
    fresh.set_cuts(tissue.fields());
    fresh.update(at, poses);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      for (std::size_t b = 0; b < 2; ++b) {
        ASSERT_EQ(scene.contact(i, b).outcome, fresh.contact(i, b).outcome);
        ASSERT_EQ(scene.contact(i, b).gap_mm, fresh.contact(i, b).gap_mm);
        ASSERT_EQ(scene.contact(i, b).normal, fresh.contact(i, b).normal);
      }
    }
    hits += scene.alerts().size();
  }
  EXPECT_GT(hits, 100);
  EXPECT_GT(scene.counts().left_alone, 20);
}

TEST(CutContact, AllocatesNothing) {
  Rng rng(6);
  const Drilled drilled(3);
  const auto& shapes = instruments();
  carpus::test::start_counting_allocations();
  for (const InstrumentShape& shape : shapes) {
    for (int i = 0; i < 50; ++i) {
      (void)find_contact(drilled.bone(), shape, pose_near(drilled, shape, rng), 1.0);
    }
  }
  EXPECT_EQ(carpus::test::stop_counting_allocations(), 0);
}

}  // namespace
}  // namespace carpus::contact
