// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The interval between two bones from its distal side: two blocks over a box of a joint, level and
// touching by their cartilage, and the ligament between them at its far end.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "arthroscopy/pathology_table.hpp"
#include "fields/distance_field.hpp"
#include "simulation/box_joint_test_support.hpp"
#include "simulation/operation_test_support.hpp"
#include "simulation/world.hpp"

namespace carpus::simulation {
namespace {

using namespace box_joint;  // NOLINT(google-build-using-namespace)

constexpr std::size_t kLigament = 1;
constexpr double kHighMm = 8;         // of the blocks: +z is proximal here
constexpr double kHalfWideMm = 0.35;  // of the interval, between bones
constexpr double kMouthZ = kHalfHigh;
constexpr double kPullN = 69;

TriangleMesh block(double side) {
  TriangleMesh mesh;
  for (const double z : {kHalfHigh, kHalfHigh + kHighMm}) {
    for (const double y : {kHalfWideMm, 6.0}) {
      for (const double x : {-8.0, 8.0}) mesh.vertices.push_back(kMiddle + Vec3{x, side * y, z});
    }
  }
  mesh.facets = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                 {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  if (side < 0) {
    for (auto& facet : mesh.facets) std::swap(facet[1], facet[2]);
  }
  return mesh;
}

void make_block(cases::CaseData& data, BoneId id, double side) {
  cases::Bone& bone = data.bones[test::body_of(id)];
  static_cast<TriangleMesh&>(bone.surface) = block(side);
  bone.distance_field = fields::build_distance_field(bone.surface, {0.25, 4.0});
}

const cases::CaseData& wrist_with_interval() {
  static const cases::CaseData data = [] {
    cases::CaseData made = box_wrist_with_ligament();
    const std::uint8_t scaphoid = test::body_of(BoneId::Scaphoid);
    const std::uint8_t lunate = test::body_of(BoneId::Lunate);
    make_block(made, BoneId::Scaphoid, -1);
    make_block(made, BoneId::Lunate, 1);
    auto map = std::make_shared<cases::ArthroscopicMap>(*made.arthroscopy);
    const Vec3 up{0, 0, 2 * kHalfHigh + kHighMm + 1};
    map->joints = {{"radiocarpal", "radiocarpal joint", box(kMiddle + up), lunate, lunate},
                   {"midcarpal", "midcarpal joint", box(), lunate, lunate}};
    map->disc_sheet = {};
    map->distal = {0, 0, -1};
    map->portals.front().joint = 1;
    map->portals.front().body = lunate;
    cases::LigamentBand& band = map->bands.front();
    band.first = scaphoid;
    band.second = lunate;
    for (Vec3& at : band.at) at.z = kHalfHigh + kHighMm + 0.5;
    for (Vec3& inwards : band.inwards) inwards = {0, 0, 1};
    map->points.clear();
    for (const bool is_distal : {false, true}) {
      cases::TourPoint point;
      point.number = is_distal ? 20 : 7;
      point.id = is_distal ? "sl_gap" : "sl_ligament";
      point.at = kMiddle + Vec3{0, 0, is_distal ? kMouthZ : kMouthZ + kHighMm + 1};
      point.body = lunate;
      point.joint = is_distal ? 1 : 0;
      map->points.push_back(point);
    }
    made.arthroscopy = map;
    return made;
  }();
  return data;
}

procedure::Procedure examination_by(const char* instrument) {
  procedure::Procedure made = probing(true);
  made.tray = {*instruments::instrument_of(instrument)};
  return made;
}

/// A hand in the joint, under the interval's mouth, the scapholunate ligament of that grade.
class InJoint {
 public:
  InJoint(std::uint8_t grade, const char* instrument)
      : procedure_(examination_by(instrument)), world_(made(procedure_, grade)), hand_(world_) {
    hand_.pull(kPullN);
    enter(hand_);
  }
  /// Led so far beyond the mouth. @returns how far the tip has come
  double goes_in(double deep_mm, double x = 0) {
    hand_.go(kMiddle + Vec3{x, 0, 0}, 100);
    hand_.go(kMiddle + Vec3{x, 0, kMouthZ + deep_mm}, 400);
    return hand_.tip().z - kMouthZ;
  }
  [[nodiscard]] const Snapshot& now() const { return world_.now(); }

 private:
  static World made(const procedure::Procedure& procedure, std::uint8_t grade) {
    cases::PreparedPathology wrong;
    wrong.grades[0] = grade;
    wrong.seed = 1;
    return {wrist_with_interval(), procedure, 1, procedure::Mode::Practice, wrong};
  }
  procedure::Procedure procedure_;
  World world_;
  Hand hand_;
};

/// Geissler [K, B9]: closed when whole, level at I, narrower than a probe at II.
TEST(IntervalInJoint, UpToGeisslerTwoNoProbeGoesIn) {
  for (std::uint8_t grade = 0; grade <= 2; ++grade) {
    InJoint joint(grade, "hook_probe");
    EXPECT_LT(joint.goes_in(4), 1.0) << int{grade};
    EXPECT_LT(joint.now().hands[0].force_in_patient.z, -3) << int{grade};
    EXPECT_TRUE(joint.now().sheets[kLigament].is_still) << "the ligament is out of reach";
  }
}

TEST(IntervalInJoint, AtGeisslerThreeAProbePassesAndAtFourTheScope) {
  EXPECT_GT(InJoint(3, "hook_probe").goes_in(kHighMm + 2), kHighMm + 1.5) << "through the tear";
  EXPECT_LT(InJoint(3, "arthroscope_2_7_30").goes_in(5), 1.0);
  EXPECT_GT(InJoint(4, "hook_probe").goes_in(kHighMm + 2), kHighMm + 1.5);
  EXPECT_GT(InJoint(4, "arthroscope_2_7_30").goes_in(kHighMm - 1), kHighMm - 1.5);
}

TEST(IntervalInJoint, NothingHoldsAProbeInAnOpenOneAndItsSidesDo) {
  InJoint joint(3, "hook_probe");
  joint.goes_in(4);
  EXPECT_LT(length(joint.now().hands[0].force_in_patient), 0.2);
}

/// Beside the tear the membrane is there: the same sheet that the other joint shows.
TEST(IntervalInJoint, AtItsFarEndTheLigamentYieldsFromBehind) {
  InJoint joint(3, "hook_probe");
  const double deep = joint.goes_in(kHighMm + 4, -4.5);
  EXPECT_GT(deep, kHighMm - 0.5);
  EXPECT_FALSE(joint.now().sheets[kLigament].is_still);
  double most = 0;
  for (std::size_t i = 0; i < joint.now().sheets[kLigament].count; ++i) {
    most = std::max(most, static_cast<double>(joint.now().sheets[kLigament].off[i][2]));
  }
  EXPECT_GT(most, 0.3) << "into the other joint";
  EXPECT_LT(joint.now().hands[0].force_in_patient.z, -0.3) << "and bears it";
}

}  // namespace
}  // namespace carpus::simulation
