// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/collision/poses.hpp"

#include <cmath>

#include "core/error.hpp"
#include "oracles/exact_meet.hpp"

namespace carpus::bench {
namespace {

using convex::ConvexBody;
using convex::PairPose;

constexpr double kDegree = 3.14159265358979323846 / 180;
constexpr double kTurnAtStart = 2 * kDegree;

PairPose stepped(const PairPose& pose, const ConvexBody& second, Rng& rng) {
  const Vec3 centre = pose.rotation * second.interior_point() + pose.translation;
  return moved(pose, centre, rotation_about(random_direction(rng), kStepRad),
               random_direction(rng) * kStepMm);
}

/// Turned a little from where the bones lie, and moved until they touch.
struct Contact {
  PairPose pose;
  Vec3 normal;
};
Contact contact_of(oracles::ExactMeet& exact, const ConvexBody& second, Rng& rng) {
  PairPose pose = moved({}, second.interior_point(),
                        rotation_about(random_direction(rng), rng.uniform(0, kTurnAtStart)), {});
  const auto touching = exact.touching(pose.rotation, pose.translation);
  pose.translation = touching.translation;
  return {pose, touching.normal};
}

void add(PoseScript& script,
         oracles::ExactMeet& exact,
         const PairPose& before,
         const PairPose& at) {
  const auto answer = exact.query(at.rotation, at.translation);
  script.poses.push_back({before, at, answer.meet, answer.needed_integers});
}

/// In and out of contact, sliding and turning, never more than a step a tick.
PoseScript trajectory(const ConvexBody& first,
                      const ConvexBody& second,
                      std::size_t count,
                      std::uint64_t seed) {
  Rng rng(seed);
  oracles::ExactMeet exact(first.vertices(), second.vertices());
  const Contact contact = contact_of(exact, second, rng);
  const Vec3 slide = any_perpendicular(contact.normal);
  const Vec3 axis = random_direction(rng);
  const Vec3 centre = contact.pose.rotation * second.interior_point() + contact.pose.translation;
  PoseScript script;
  script.is_trajectory = true;
  PairPose before = contact.pose;
  for (std::size_t k = 0; k < count; ++k) {
    const double phase = static_cast<double>(k) * 0.02;
    const Vec3 shift =
        contact.normal * (0.75 + 2.2 * std::cos(phase)) + slide * (1.2 * std::sin(0.7 * phase));
    const PairPose at = moved(contact.pose, centre,
                              rotation_about(axis, 5 * kDegree * std::sin(0.9 * phase)), shift);
    add(script, exact, before, at);
    before = at;
  }
  return script;
}

}  // namespace

Vec3 random_direction(Rng& rng) {
  return normalized_or({rng.normal(), rng.normal(), rng.normal()}, {1, 0, 0});
}

PairPose moved(const PairPose& pose, const Vec3& centre, const Mat3& rotation, const Vec3& shift) {
  return {rotation * pose.rotation, rotation * (pose.translation - centre) + centre + shift};
}

const std::vector<std::string>& pose_cases() {
  static const std::vector<std::string> kCases{"apart_5mm", "gap_0.01mm", "gap_1e-9mm",
                                               "touching",  "deep_1mm",   "trajectory"};
  return kCases;
}

PoseScript poses_at_gap(double gap_mm,
                        const ConvexBody& first,
                        const ConvexBody& second,
                        std::size_t count,
                        std::uint64_t seed) {
  Rng rng(seed);
  oracles::ExactMeet exact(first.vertices(), second.vertices());
  PoseScript script;
  for (std::size_t k = 0; k < count; ++k) {
    const Contact contact = contact_of(exact, second, rng);
    PairPose at = contact.pose;
    at.translation += contact.normal * gap_mm;
    add(script, exact, stepped(stepped(at, second, rng), second, rng), at);
  }
  return script;
}

PoseScript make_poses(const std::string& pose_case,
                      const ConvexBody& first,
                      const ConvexBody& second,
                      std::size_t count,
                      std::uint64_t seed) {
  if (pose_case == "trajectory") return trajectory(first, second, 4 * count, seed);
  if (pose_case == "apart_5mm") return poses_at_gap(5, first, second, count, seed);
  if (pose_case == "gap_0.01mm") return poses_at_gap(0.01, first, second, count, seed);
  if (pose_case == "gap_1e-9mm") return poses_at_gap(1e-9, first, second, count, seed);
  if (pose_case == "touching") return poses_at_gap(0, first, second, count, seed);
  if (pose_case == "deep_1mm") return poses_at_gap(-1, first, second, count, seed);
  throw InvalidInput("no case of poses is called " + pose_case);
}

}  // namespace carpus::bench
