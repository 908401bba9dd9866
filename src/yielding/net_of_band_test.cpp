// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "yielding/net_of_band.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "yielding/net_test_support.hpp"

namespace carpus::yielding {
namespace {

constexpr std::size_t kRows = 12;
constexpr std::size_t kColumns = 6;
constexpr BandMaterial kTaut{60, 0.3, 1.0, 0.2, 2.0, 80, 0};
constexpr BandMaterial kSlack{20, 0.3, 0.2, 0.05, 2.0, 80, 0.6};
const BandTear kTear{{0, -3, 0}, {0, 3, 0}, 0.3};

/// Fibres along x, from -2.5 to 2.5, side by side along y, in z = 0.
struct Flat {
  std::vector<Vec3> at;
  std::vector<Vec3> normals;
  Flat() {
    for (std::size_t r = 0; r < kRows; ++r) {
      for (std::size_t c = 0; c < kColumns; ++c) {
        at.push_back({static_cast<double>(c) - 2.5, 0.9 * static_cast<double>(r) - 4.95, 0});
        normals.push_back({0, 0, 1});
      }
    }
  }
  [[nodiscard]] Band band() const { return {kRows, kColumns, at, normals}; }
};

Net net_of(const BandMaterial& material, const std::optional<BandTear>& tear = std::nullopt) {
  static const Flat kFlat;
  return net_of_band(kFlat.band(), material, tear);
}

/// The second body has gone so far along the fibres, and out of line.
constexpr Pose<frame::Bone, frame::Bone> parted(double gap_mm, double step_mm) {
  return {Mat3::identity(), {gap_mm, 0, step_mm}};
}

std::unique_ptr<NetState> resting(const Net& net) {
  auto state = std::make_unique<NetState>();
  state->reset(net);
  return state;
}

TEST(BandNet, BothBodiesHoldItsEndsAndWhatIsBesideItHoldsItsRims) {
  const Net net = net_of(kTaut);
  ASSERT_EQ(net.size(), kRows * kColumns);
  EXPECT_TRUE(net.is_between_two());
  for (std::size_t i = 0; i < net.size(); ++i) {
    const std::size_t r = i / kColumns;
    const std::size_t c = i % kColumns;
    const bool is_rim = r == 0 || c == 0 || r + 1 == kRows || c + 1 == kColumns;
    EXPECT_EQ(net.is_held(i), is_rim);
    EXPECT_NEAR(net.second_share(i), static_cast<double>(c) / (kColumns - 1), 1e-12);
  }
}

TEST(BandNet, BearsAlongItsFibresWhatItIsToldAndALittleMoreByWhatJoinsThem) {
  const Flat flat;
  BandMaterial fibres = kTaut;
  fibres.aside_share = 1e-6;
  EXPECT_NEAR(along_n_per_mm(net_of_band(flat.band(), fibres), flat.band()), 60, 0.1);
  const double joined = along_n_per_mm(net_of(kTaut), flat.band());
  EXPECT_GT(joined, 60);
  EXPECT_LT(joined, 1.3 * 60);
}

TEST(BandNet, TautItGivesLessThanSlackAndBearsWhatPresses) {
  for (const double newtons : {0.5, 1.0, 2.0}) {
    const Net taut = net_of(kTaut);
    const Net slack = net_of({20, 0.3, 0.2, 0.05, 2.0, 80, 0});
    const auto state = resting(taut);
    const double little = test::depth_under(taut, {0, 0, 0}, newtons, *state);
    EXPECT_NEAR(state->force_on(0).z, newtons, 0.02 * newtons);
    state->reset(slack);
    EXPECT_GT(test::depth_under(slack, {0, 0, 0}, newtons, *state), 1.5 * little);
    EXPECT_NEAR(state->force_on(0).z, newtons, 0.02 * newtons);
  }
}

/// A trampoline gives beside what presses on it, too: springs that nothing draws give there only as
/// far as they are bent.
TEST(BandNet, UnderTensionADentIsWiderThanTheTip) {
  BandMaterial loose = kTaut;
  loose.tension_n_per_mm = 0;
  const auto beside_share = [](const Net& net) {
    const auto state = resting(net);
    (void)test::depth_under(net, {0.5, 0, 0}, 0.05, *state);
    const auto deep_at = [&](const Vec3& at) { return -state->off(state->nearest(net, at)).z; };
    return deep_at({0.5, 1.5, 0}) / deep_at({0.5, 0, 0});
  };
  const double taut = beside_share(net_of(kTaut));
  EXPECT_GT(taut, 0.1);
  EXPECT_GT(taut, 2 * std::abs(beside_share(net_of(loose))));
}

TEST(BandNet, LiesBetweenItsBodiesAsTheyPartAndIsAsLongAsItLies) {
  const Net net = net_of(kTaut);
  const auto state = resting(net);
  state->lay(net, parted(1.0, 0.5));
  EXPECT_EQ(state->energy_n_mm(net), 0);
  for (std::size_t i = 0; i < net.size(); ++i) {
    const double share = net.second_share(i);
    EXPECT_NEAR(state->at(i).x, net.scanned()[i].x + share, 1e-12);
    EXPECT_NEAR(state->at(i).z, 0.5 * share, 1e-12);
  }
}

TEST(BandNet, AttenuatedItBulgesTowardsTheJointAndRestsThere) {
  const Net net = net_of(kSlack);
  const auto state = resting(net);
  EXPECT_EQ(state->energy_n_mm(net), 0);
  double most = 0;
  for (std::size_t i = 0; i < net.size(); ++i) {
    const double high = net.rest()[i].z - net.scanned()[i].z;
    EXPECT_GE(high, 0);
    EXPECT_EQ(net.is_held(i) ? high : 0.0, 0);
    most = std::max(most, high);
  }
  EXPECT_NEAR(most, 0.6, 0.05);
}

TEST(BandNet, TornItsEdgesGoWithTheirBodiesAndNothingDrawsThemTogether) {
  const Net net = net_of(kTaut, kTear);
  const auto state = resting(net);
  state->lay(net, parted(2.0, 0));
  bool has_torn = false;
  for (std::size_t r = 1; r + 1 < kRows; ++r) {
    const double y = net.scanned()[r * kColumns].y;
    const Vec3 left = state->at(r * kColumns + 2);
    const Vec3 right = state->at(r * kColumns + 3);
    if (std::abs(y) > 3) continue;
    has_torn = true;
    EXPECT_NEAR(right.x - left.x, 3.0, 1e-12) << "a gap of two beside the millimetre of a cell";
  }
  EXPECT_TRUE(has_torn);
  for (const Net::Spring& spring : net.springs()) {
    const Vec3 a = net.scanned()[spring.a];
    const Vec3 b = net.scanned()[spring.b];
    const bool is_torn = std::abs(a.y) <= 3 && std::abs(b.y) <= 3;
    EXPECT_FALSE(is_torn && a.x * b.x < 0) << "it crosses the tear";
  }
}

TEST(BandNet, TheEdgeOfATearGivesMoreThanTheWholeBand) {
  const auto depth_at = [](const Net& net) {
    const auto state = resting(net);
    return test::depth_under(net, {-0.5, 0, 0}, 0.3, *state);
  };
  EXPECT_GT(depth_at(net_of(kTaut, kTear)), 2 * depth_at(net_of(kTaut)));
}

TEST(BandNet, LeftToItselfItOnlyLosesEnergyAndComesToRestHoweverItsBodiesLie) {
  for (const auto& bodies : {parted(0, 0), parted(1.5, 1.3)}) {
    for (const Net& net : {net_of(kTaut), net_of(kSlack), net_of(kTaut, kTear)}) {
      test::only_loses_energy_and_rests(net, bodies, 3);
    }
  }
}

TEST(BandNet, ASleepingOneStaysAsItIsWhenItsBodiesMove) {
  const Net net = net_of(kTaut);
  const auto state = resting(net);
  for (int tick = 0; tick < 50; ++tick) {
    state->lay(net, parted(0.02 * tick, 0));
    state->step(net, {});
    ASSERT_TRUE(state->is_still());
  }
  EXPECT_EQ(state->off(kColumns + 2), (Vec3{}));
}

}  // namespace
}  // namespace carpus::yielding
