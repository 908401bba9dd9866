// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "anatomy/carpal_kinematics.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "core/error.hpp"
#include "core/units.hpp"

namespace carpus::anatomy {
namespace {

const CarpalKinematics& model() { return CarpalKinematics::published(); }

double flexion_of(CarpalGroup group, double flexion_deg, double deviation_deg = 0) {
  return model().rotation_vector_deg(group, flexion_deg, deviation_deg).y;
}

HandPose pose_of(double flexion_deg, double deviation_deg) {
  return {radians_from_degrees(flexion_deg), radians_from_degrees(deviation_deg), 0, 0};
}

/// An ellipsoid of 26 x 20 x 14 mm: a capitate whose axis is known.
MeshIn<frame::Wrist> capitate_along(const Vec3& distal, const Vec3& centre) {
  const Vec3 x = normalized_or(distal, {1, 0, 0});
  const Vec3 y = any_perpendicular(x);
  const Vec3 z = cross(x, y);
  MeshIn<frame::Wrist> mesh;
  constexpr int kRings = 24;
  constexpr int kSectors = 24;
  const auto put = [&](double a, double b, double c) {
    mesh.vertices.push_back(centre + x * (13 * a) + y * (10 * b) + z * (7 * c));
  };
  put(-1, 0, 0);
  for (int ring = 1; ring < kRings; ++ring) {
    const double t = kPi * ring / kRings;
    for (int s = 0; s < kSectors; ++s) {
      const double p = 2 * kPi * s / kSectors;
      put(-std::cos(t), std::sin(t) * std::cos(p), std::sin(t) * std::sin(p));
    }
  }
  put(1, 0, 0);
  const auto at = [&](int ring, int s) {
    return static_cast<std::uint32_t>(1 + (ring - 1) * kSectors + s % kSectors);
  };
  const auto last = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  for (int s = 0; s < kSectors; ++s) {
    mesh.facets.push_back({0, at(1, s + 1), at(1, s)});
    mesh.facets.push_back({last, at(kRings - 1, s), at(kRings - 1, s + 1)});
    for (int ring = 1; ring + 1 < kRings; ++ring) {
      mesh.facets.push_back({at(ring, s), at(ring, s + 1), at(ring + 1, s)});
      mesh.facets.push_back({at(ring, s + 1), at(ring + 1, s + 1), at(ring + 1, s)});
    }
  }
  return mesh;
}

TEST(CarpalKinematics, FollowsThePublishedSharesOfTheCapitateInFlexion) {
  // Active range [K, as Wolfe 2000]: 73 and 46 % in flexion, 99 and 68 % in extension; at the
  // extremes [rainbow2013extreme] 70 and 46, 74 and 42 %. Five points either way, as published
  // groups differ by that.
  EXPECT_NEAR(flexion_of(CarpalGroup::Scaphoid, 60) / 60, 0.73, 0.05);
  EXPECT_NEAR(flexion_of(CarpalGroup::Lunate, 60) / 60, 0.46, 0.05);
  EXPECT_NEAR(flexion_of(CarpalGroup::Scaphoid, -45) / -45, 0.99, 0.05);
  EXPECT_NEAR(flexion_of(CarpalGroup::Lunate, -45) / -45, 0.68, 0.05);
  EXPECT_NEAR(flexion_of(CarpalGroup::Scaphoid, 80) / 80, 0.70, 0.05);
  EXPECT_NEAR(flexion_of(CarpalGroup::Lunate, 80) / 80, 0.46, 0.05);
  EXPECT_NEAR(flexion_of(CarpalGroup::Scaphoid, -80) / -80, 0.74, 0.001);
  EXPECT_NEAR(flexion_of(CarpalGroup::Lunate, -80) / -80, 0.42, 0.001);
}

TEST(CarpalKinematics, FlexesTheProximalRowInRadialAndExtendsItInUlnarDeviation) {
  EXPECT_NEAR(flexion_of(CarpalGroup::Scaphoid, 0, 20), 15, 1);  // [wheelessndkinematics]
  for (const double ulnar_deg : {10.0, 20.0, 30.0, 40.0}) {
    for (const CarpalGroup group : {CarpalGroup::Scaphoid, CarpalGroup::Lunate}) {
      const double extension_per_degree = -flexion_of(group, 0, -ulnar_deg) / ulnar_deg;
      EXPECT_GE(extension_per_degree, 0.5);
      EXPECT_LE(extension_per_degree, 0.8);
    }
  }
}

TEST(CarpalKinematics, HardlyTurnsTheProximalRowAlongTheDartThrowersPath) {
  // From extension with radial to flexion with ulnar deviation, 45 degrees to the sagittal plane.
  for (const double along : {-20.0, -10.0, 10.0, 20.0, 30.0}) {
    EXPECT_LT(std::abs(flexion_of(CarpalGroup::Scaphoid, along, -along)), 5);
    EXPECT_LT(std::abs(flexion_of(CarpalGroup::Lunate, along, -along)), 5);
  }
}

TEST(CarpalKinematics, TurnsTheMidcarpalJointAboutItsObliqueAxisInDeviation) {
  for (const double deviation_deg : {-30.0, -15.0, 10.0, 20.0}) {
    const Vec3 row = model().rotation_vector_deg(CarpalGroup::Scaphoid, 0, deviation_deg);
    const Vec3 hand = model().rotation_vector_deg(CarpalGroup::Hand, 0, deviation_deg);
    const Vec3 axis = row - hand;
    EXPECT_NEAR(std::abs(axis.z / axis.y), std::tan(radians_from_degrees(42)), 0.05);
    EXPECT_LT(axis.z * axis.y, 0);  // it opens radially and palmarly
  }
}

TEST(CarpalKinematics, KeepsTheTriquetrumBetweenLunateAndHamate) {
  for (const double f : {-60.0, -20.0, 30.0, 70.0}) {
    for (const double r : {-30.0, 0.0, 15.0}) {
      const double lunate = flexion_of(CarpalGroup::Lunate, f, r);
      const double hand = flexion_of(CarpalGroup::Hand, f, r);
      const double triquetrum = flexion_of(CarpalGroup::Triquetrum, f, r);
      EXPECT_GE(triquetrum, std::min(lunate, hand) - 1e-9);
      EXPECT_LE(triquetrum, std::max(lunate, hand) + 1e-9);
    }
  }
}

TEST(CarpalKinematics, IsItsOwnMirrorImageOnTheOtherSide) {
  const HandPose pose = pose_of(35, -20);
  const WristLandmarks left{pose_of(-10, 5), {-18, 4, -3}, {-1, 0, 0}};
  WristLandmarks right = left;
  right.centre.y = -right.centre.y;
  for (const CarpalGroup group : kMovingGroups) {
    const auto on_left = model().motion_from_scan(group, pose, left, Side::Left);
    const auto on_right = model().motion_from_scan(group, pose, right, Side::Right);
    const Vec3 a = (on_left * Point<frame::Wrist>{{-5, 7, 2}}).v;
    const Vec3 b = (on_right * Point<frame::Wrist>{{-5, -7, 2}}).v;
    EXPECT_NEAR(a.x, b.x, 1e-9);
    EXPECT_NEAR(a.y, -b.y, 1e-9);
    EXPECT_NEAR(a.z, b.z, 1e-9);
  }
}

TEST(CarpalKinematics, MovesNothingInThePoseOfTheScanAndNeverTheForearm) {
  const WristLandmarks landmarks{pose_of(-21, -13), {-18, 4, -3}, {-1, 0, 0}};
  for (const CarpalGroup group : kMovingGroups) {
    const auto motion = model().motion_from_scan(group, landmarks.scan, landmarks, Side::Left);
    EXPECT_LT(length(motion.translation), 1e-9);
    EXPECT_NEAR(motion.rotation.rows[0].x + motion.rotation.rows[1].y + motion.rotation.rows[2].z,
                3, 1e-12);
  }
  const auto radius =
      model().motion_from_scan(CarpalGroup::Radius, pose_of(60, 10), landmarks, Side::Left);
  EXPECT_EQ(radius.rotation, Mat3::identity());
  EXPECT_LT(length(radius.translation), 1e-12);
}

TEST(CarpalKinematics, TurnsTheHandAboutTwoAxesFourMillimetresApart) {
  const WristLandmarks landmarks{{}, {-18, 4, -3}, {-1, 0, 0}};
  const auto flexed =
      model().motion_from_scan(CarpalGroup::Hand, pose_of(40, 0), landmarks, Side::Left);
  const auto deviated =
      model().motion_from_scan(CarpalGroup::Hand, pose_of(0, 20), landmarks, Side::Left);
  const Point<frame::Wrist> proximal{landmarks.centre + Vec3{1.95, 0, 0}};
  const Point<frame::Wrist> distal{landmarks.centre - Vec3{1.95, 0, 0}};
  EXPECT_LT(distance((flexed * proximal).v, proximal.v), 1e-9);
  EXPECT_LT(distance((deviated * distal).v, distal.v), 1e-9);
}

TEST(CarpalKinematics, FlexesTowardsThePalmAndDeviatesTowardsTheThumb) {
  const WristLandmarks landmarks{{}, {}, {-1, 0, 0}};
  for (const Side side : {Side::Left, Side::Right}) {
    const Direction<frame::Wrist> distal{{-1, 0, 0}};
    const Vec3 flexed =
        (model().motion_from_scan(CarpalGroup::Hand, pose_of(30, 0), landmarks, side) * distal).v;
    EXPECT_GT(flexed.z, 0.4);  // volar is +z
    const Vec3 radial =
        (model().motion_from_scan(CarpalGroup::Hand, pose_of(0, 20), landmarks, side) * distal).v;
    EXPECT_GT(side == Side::Left ? -radial.y : radial.y, 0.3);  // +y is ulnar on a left wrist
  }
}

TEST(CarpalKinematics, ReadsTheScansHandPoseOffTheCapitate) {
  // The neutral capitate lies 43 degrees dorsal and 8 degrees radial of -x; this one 20 degrees
  // further dorsal and 12 degrees further ulnar.
  const double f = radians_from_degrees(-63);
  const double r = radians_from_degrees(-4);
  for (const Side side : {Side::Left, Side::Right}) {
    const double radial_y = side == Side::Left ? -1 : 1;
    const Vec3 distal{-std::cos(f) * std::cos(r), radial_y * std::sin(r),
                      std::sin(f) * std::cos(r)};
    const WristLandmarks landmarks =
        model().landmarks_of(capitate_along(distal, {-18, 4, -3}), side);
    EXPECT_NEAR(degrees_from_radians(landmarks.scan.flexion_rad), -20, 0.1);
    EXPECT_NEAR(degrees_from_radians(landmarks.scan.radial_deviation_rad), -12, 0.1);
    EXPECT_LT(distance(landmarks.hand_axis, distal), 1e-3);
    EXPECT_LT(distance(landmarks.centre, Vec3{-18, 4, -3} - distal * (26.0 / 3)), 0.05);
  }
}

TEST(HandLimits, LeaveAPoseWithinTheirEnvelopeAndDrawOthersToIt) {
  const HandLimits& limits = model().limits();
  for (const HandPose& inside :
       {pose_of(0, 0), pose_of(80, 0), pose_of(-40, -30), pose_of(50, 15)}) {
    EXPECT_EQ(limits.clamp(inside), inside);
  }
  const HandPose corner = limits.clamp(pose_of(200, -90));
  EXPECT_NEAR(limits.reach(corner), 1, 1e-12);
  EXPECT_NEAR(corner.flexion_rad / corner.radial_deviation_rad, 80.0 / -40.0, 1e-12);
  const HandPose twisted = limits.clamp({0, 0, 9, 1e6});
  EXPECT_NEAR(degrees_from_radians(twisted.pronation_rad), 90, 1e-9);
  EXPECT_EQ(twisted.traction_n, 100);
  EXPECT_EQ(limits.clamp({0, 0, 0, -5}).traction_n, 0);
}

TEST(HandLimits, KeepClampedPosesCloseForPosesThatAreClose) {
  const HandLimits& limits = model().limits();
  HandPose last = limits.clamp(pose_of(100, -60));
  for (double step = 0; step <= 1000; ++step) {
    const HandPose next = limits.clamp(pose_of(100 - 0.2 * step, -60 + 0.1 * step));
    EXPECT_LT(std::abs(next.flexion_rad - last.flexion_rad), radians_from_degrees(0.25));
    EXPECT_LT(std::abs(next.radial_deviation_rad - last.radial_deviation_rad),
              radians_from_degrees(0.25));
    last = next;
  }
}

TEST(CarpalKinematics, RefusesACapitateWithoutALongAxisAndBrokenData) {
  EXPECT_THROW((void)model().landmarks_of(MeshIn<frame::Wrist>{}, Side::Left), InvalidInput);
  EXPECT_THROW((void)CarpalKinematics::parse("{}"), InvalidInput);
  EXPECT_THROW((void)CarpalKinematics::parse("no json"), InvalidInput);
}

Mat3 rotation_from(const nlohmann::json& json) {
  const auto r = json.get<std::array<std::array<double, 3>, 3>>();
  return {{Vec3{r[0][0], r[0][1], r[0][2]}, Vec3{r[1][0], r[1][1], r[1][2]},
           Vec3{r[2][0], r[2][1], r[2][2]}}};
}

double angle_deg(const Mat3& m) {
  const double cosine = (m.rows[0].x + m.rows[1].y + m.rows[2].z - 1) / 2;
  return degrees_from_radians(std::acos(std::max(-1.0, std::min(1.0, cosine))));
}

TEST(CarpalKinematics, TurnsBonesAsMeasuredInOneRealWristToTenDegrees) {
  // Nine positions of one wrist, to which no coefficient was fitted. Tracked trapezoid, trapezium
  // and pisiform err by more than the model (their errors in one position reach 40 degrees):
  // printed.
  const char* set = std::getenv("CARPUS_REFERENCE_WRIST");  // NOLINT(concurrency-mt-unsafe)
  const std::filesystem::path folder = set != nullptr ? set : "../shared/reference-wrist";
  std::ifstream file(folder / "kinematics.json");
  if (!file) GTEST_SKIP() << "no reference wrist; set CARPUS_REFERENCE_WRIST to its folder";
  const auto json = nlohmann::json::parse(file);
  const auto axis = json.at("capitate_inertia_axis_reference").get<std::array<double, 3>>();
  const HandPose scan =
      model()
          .landmarks_of(capitate_along({axis[0], axis[1], axis[2]}, {-18, 4, -3}), Side::Left)
          .scan;
  const Mat3 hand_scan = model().rotation_from_neutral(CarpalGroup::Hand, scan, Side::Left);
  const auto rotation_of = [](const nlohmann::json& position, const char* bone) {
    return rotation_from(position.at("bones").at(bone).at("rotation"));
  };
  ASSERT_EQ(json.at("poses").size(), 9U);
  for (const char* bone : {"scaphoid", "lunate", "triquetrum", "hamate", "capitate", "trapezium",
                           "trapezoid", "pisiform"}) {
    const CarpalGroup group = group_of(bone_of(bone)->bone);
    const Mat3 at_scan = model().rotation_from_neutral(group, scan, Side::Left);
    double mean = 0;
    for (const auto& position : json.at("poses")) {
      const Mat3 hand = rotation_of(position, "capitate") * hand_scan;
      const Vec3 skew{hand.rows[2].y - hand.rows[1].z, hand.rows[0].z - hand.rows[2].x,
                      hand.rows[1].x - hand.rows[0].y};
      const Vec3 vector_deg = normalized_or(skew, {0, 0, 0}) * angle_deg(hand);
      const HandPose pose = pose_of(vector_deg.y, vector_deg.z);
      const Mat3 turn =
          model().rotation_from_neutral(group, pose, Side::Left) * at_scan.transposed();
      mean += angle_deg(rotation_of(position, bone) * turn.transposed()) / 9;
    }
    std::printf("%-10s mean rotation error %.1f deg\n", bone, mean);
    const bool is_asked = group != CarpalGroup::Hand || std::string(bone) == "hamate";
    if (is_asked && std::string(bone) != "pisiform") {
      EXPECT_LE(mean, 10) << bone;
    }
  }
}

}  // namespace
}  // namespace carpus::anatomy
