// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "fluoroscopy/composed_renderer.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "fluoroscopy/bone_phantom_test_support.hpp"
#include "fluoroscopy/ct_projector.hpp"

namespace carpus::fluoroscopy {
namespace {

using BodyPose = Pose<frame::Patient, frame::Bone>;

constexpr std::array<BodyLabel, 2> kBodies{{{1, 0}, {2, 1}}};

const test::Phantom& limb() {
  static const test::Phantom phantom =
      test::make_phantom(81, 0.6, {test::ball({-8, 0, 0}, 6), test::ball({8, 0, 0}, 6)}, 900,
                         test::box({0, 0, 0}, {20, 16, 12}), 40);
  return phantom;
}

ComposedRenderer renderer() { return {limb().ct.view(), limb().labels.view(), kBodies}; }

CArmPose c_arm(double rotation_deg = 0) {
  CArmGeometry geometry;
  geometry.pixels = 128;
  return make_c_arm_pose({rotation_deg, 0}, {{0, 0, 0}}, {}, {{0, 1, 0}}, geometry);
}

const std::array<BodyPose, 2> kStill{};
const std::array<BodyPose, 2> kBent{BodyPose{}, BodyPose{rotation_about({0, 1, 0}, 0.5), {}}};
const MetalCylinder kWire = make_wire({-12, -9, 1}, {11, 10, -1}, 1.14);

/// A canal of 3 mm along z through the first ball.
Grid<std::uint8_t> canal() {
  GridGeometry g;
  g.size = {41, 41, 41};
  g.spacing = {0.4, 0.4, 0.4};
  g.origin = {-16, -8, -8};
  Grid<std::uint8_t> share(g);
  for (std::size_t i = 0; i < g.voxel_count(); ++i) {
    const VoxelIndex v = g.index_of(i);
    if (std::hypot(v.x - 20, v.y - 20) * 0.4 < 1.5) share[i] = 255;
  }
  return share;
}

TEST(ComposedRenderer, KeepsWhatRestsAndShowsTheSameBytesAsAFreshOne) {
  ComposedRenderer kept = renderer();
  const auto expect_same_as_fresh = [&](const BeamScene& scene, std::size_t redone) {
    const Image image = kept.render(scene, {});
    EXPECT_EQ(kept.redone(), redone);
    ComposedRenderer fresh = renderer();
    EXPECT_EQ(image.grey, fresh.render(scene, {}).grey);
  };
  expect_same_as_fresh({c_arm(), kStill, {}}, 3);
  expect_same_as_fresh({c_arm(), kStill, {}}, 0);
  expect_same_as_fresh({c_arm(), kStill, {&kWire, 1}}, 0);
  expect_same_as_fresh({c_arm(), kStill, {}}, 0);
  expect_same_as_fresh({c_arm(), kBent, {}}, 2);  // soft tissue and the body that moved
  expect_same_as_fresh({c_arm(30), kBent, {&kWire, 1}}, 3);
}

TEST(ComposedRenderer, TakesInWhatWasDrilledWithoutTheRestAnew) {
  ComposedRenderer taker = renderer();
  const BeamScene scene{c_arm(), kStill, {}};
  const AttenuationMap before = taker.project(scene);
  const Grid<std::uint8_t> share = canal();
  taker.set_removed(0, {share.geometry(), share.values()}, whole_of(share.geometry()));
  const AttenuationMap after = taker.project(scene);
  EXPECT_EQ(taker.redone(), 1U);
  // Along the canal the ray loses the ball's diameter, above soft tissue.
  const double lost = 12 * (attenuation_per_mm(900) - attenuation_per_mm(40));
  const PixelPosition axis = *project_point(scene.pose, {{-8, 0, 0}});
  const auto at = [](int i, int j) { return static_cast<std::size_t>(j * 128 + i); };
  const int i = static_cast<int>(std::lround(axis.x));
  const int j = static_cast<int>(std::lround(axis.y));
  EXPECT_NEAR(before.values[at(i, j)] - after.values[at(i, j)], lost, 0.05 * lost);
  const PixelPosition beside = *project_point(scene.pose, {{-8 + 3.0, 0, 0}});
  const std::size_t edge = at(static_cast<int>(beside.x), static_cast<int>(beside.y));
  EXPECT_EQ(before.values[edge], after.values[edge]);
  taker.restore(0);
  const AttenuationMap whole = taker.project(scene);
  for (std::size_t k = 0; k < whole.values.size(); ++k) {
    if (std::isnan(whole.values[k])) continue;
    ASSERT_EQ(whole.values[k], before.values[k]);
  }
}

TEST(ComposedRenderer, GivesTheSameBytesForASeedHoweverRowsAreShared) {
  const BeamScene scene{c_arm(20), kBent, {&kWire, 1}};
  Exposure exposure;
  ComposedRenderer serial = renderer();
  const Image once = serial.render(scene, exposure);
  install_parallel_executor([](std::size_t count, std::size_t, const auto& body) {
    for (std::size_t i = count; i-- > 0;) body(i, i + 1);  // one at a time, backwards
  });
  ComposedRenderer shared = renderer();
  const Image again = shared.render(scene, exposure);
  install_parallel_executor({});
  EXPECT_EQ(once.grey, again.grey);
  exposure.seed = 2;
  EXPECT_NE(once.grey, serial.render(scene, exposure).grey);
}

TEST(ComposedRenderer, RefusesPosesThatDoNotMatchAndTakesTheNextSceneWell) {
  ComposedRenderer taker = renderer();
  const BeamScene good{c_arm(), kStill, {}};
  const Image before = taker.render(good, {});
  EXPECT_THROW((void)taker.render({c_arm(), {kStill.data(), 1}, {}}, {}), InvalidInput);
  EXPECT_EQ(taker.render(good, {}).grey, before.grey);
}

}  // namespace
}  // namespace carpus::fluoroscopy
