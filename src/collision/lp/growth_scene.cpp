// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. Every body: where its origin is, and at most how far any of its points has moved since the
//    last update; the sums of these are its path.
// 2. Every pair whose two paths have not yet used up its last proof's margin keeps its verdict.
// 3. Others: spheres, the last proof, the growth program, exact arithmetic; then a new margin.
#include "collision/lp/growth_scene.hpp"

#include <algorithm>
#include <cmath>

#include "collision/lp/exact_meeting.hpp"

namespace carpus::collision {
namespace {

/// A rotation's matrix may be this far from orthonormal for proofs in doubles.
constexpr double kMostRigidityError = 1e-3;
/// What a margin loses to rounding and to matrices that are nearly rotations, as a share.
constexpr double kMarginShare = 1 - 4 * kMostRigidityError;

/// A bound of the norm of R'R - 1.
double rigidity_error_of(const Mat3& r) noexcept {
  const double xx = squared_length(r.rows[0]) - 1;
  const double yy = squared_length(r.rows[1]) - 1;
  const double zz = squared_length(r.rows[2]) - 1;
  const double xy = dot(r.rows[0], r.rows[1]);
  const double yz = dot(r.rows[1], r.rows[2]);
  const double zx = dot(r.rows[2], r.rows[0]);
  // The norm of RR' - 1 is that of R'R - 1, and at most the sum of magnitudes.
  return std::abs(xx) + std::abs(yy) + std::abs(zz) +
         2 * (std::abs(xy) + std::abs(yz) + std::abs(zx)) + 64 * kRoundoff;
}

}  // namespace

GrowthScene::GrowthScene(std::span<const ConvexBody* const> bodies, bool uses_budget)
    : uses_budget_(uses_budget) {
  for (const ConvexBody* body : bodies) {
    Body placed;
    placed.body = body;
    placed.proofs = ProofBody(*body);
    bodies_.push_back(placed);
  }
  for (std::uint32_t i = 0; i < bodies.size(); ++i) {
    for (std::uint32_t j = i + 1; j < bodies.size(); ++j) {
      Pair pair;
      pair.bodies = {i, j};
      pairs_.push_back(pair);
    }
  }
  verdicts_.assign(pairs_.size(), Verdict::Unknown);
}

void GrowthScene::forget() noexcept {
  for (Pair& pair : pairs_) {
    pair.memory = {};
    pair.ready = {};
    pair.limit_mm = -1;
  }
}

void GrowthScene::place(Body& body, const BodyPose& pose) const noexcept {
  const Vec3& origin = body.proofs.facets->origin();
  const Vec3 centre = pose.rotation * origin + pose.translation;
  const double error = 16 * kRoundoff * (taxicab(origin) + taxicab(pose.translation));
  const double rigidity = rigidity_error_of(pose.rotation);
  const bool is_ordinary = body.proofs.facets->is_usable() && rigidity <= kMostRigidityError &&
                           taxicab(pose.translation) <= kMostTranslation;
  if (is_ordinary && body.is_ordinary && body.has_moved) {
    const Mat3& r = pose.rotation;
    const Mat3& q = body.pose.rotation;
    const double turn =
        std::sqrt(squared_length(r.rows[0] - q.rows[0]) + squared_length(r.rows[1] - q.rows[1]) +
                  squared_length(r.rows[2] - q.rows[2]));
    const double motion = distance(centre, body.centre) +
                          turn * body.proofs.facets->outer_radius_mm() + error +
                          body.centre_error_mm;
    body.path_mm = (body.path_mm + motion) * (1 + 16 * kRoundoff);
  } else {
    body.path_mm = HUGE_VAL;  // unknown motion: every proof must be tried anew
  }
  body.pose = pose;
  body.centre = centre;
  body.centre_error_mm = error;
  body.rigidity_error = rigidity;
  body.is_ordinary = is_ordinary;
  body.has_moved = true;
}

SceneTick GrowthScene::update(std::span<const BodyPose> world_from_body) noexcept {
  SceneTick tick;
  bool is_path_lost = false;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    place(bodies_[i], world_from_body[i]);
    is_path_lost = is_path_lost || !(bodies_[i].path_mm < HUGE_VAL);
  }
  if (is_path_lost) {
    for (Body& body : bodies_) body.path_mm = 0;
    for (Pair& pair : pairs_) pair.limit_mm = -1;
  }
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    Pair& pair = pairs_[i];
    const double used = bodies_[pair.bodies.first].path_mm + bodies_[pair.bodies.second].path_mm;
    if (used < pair.limit_mm) {
      ++counts_.by_budget;
    } else {
      verdicts_[i] = decide(pair);
      ++tick.queries;
    }
    tick.meeting += verdicts_[i] == Verdict::Meet ? 1U : 0U;
    tick.unknown += verdicts_[i] == Verdict::Unknown ? 1U : 0U;
  }
  return tick;
}

RelativePose GrowthScene::relative(const Body& first, const Body& second) noexcept {
  const auto& a = first.pose.rotation.rows;
  const auto& b = second.pose.rotation.rows;
  const Vec3 d = second.centre - first.centre;
  RelativePose pose;
  for (std::size_t i = 0; i < 3; ++i) {
    pose.rotation.rows[i] = b[0] * a[0][i] + b[1] * a[1][i] + b[2] * a[2][i];
  }
  pose.offset = a[0] * d.x + a[1] * d.y + a[2] * d.z;
  // The transpose differs from the inverse by no more than 1.1 times the rigidity error.
  pose.rotation_error = 16 * kRoundoff + 1.2 * first.rigidity_error;
  pose.offset_error_mm = 1.01 * (first.centre_error_mm + second.centre_error_mm) +
                         (16 * kRoundoff + 1.2 * first.rigidity_error) * taxicab(d);
  return pose;
}

Verdict GrowthScene::decide(Pair& pair) noexcept {
  const Body& first = bodies_[pair.bodies.first];
  const Body& second = bodies_[pair.bodies.second];
  pair.limit_mm = -1;
  if (!first.is_ordinary || !second.is_ordinary) return decide_exactly(pair);
  const double used = first.path_mm + second.path_mm;
  const auto grant = [&](double margin_mm) {
    if (uses_budget_) {
      pair.limit_mm = (used + margin_mm * kMarginShare) * (1 - 8 * kRoundoff);
    }
  };

  const double reach =
      (first.proofs.facets->outer_radius_mm() + second.proofs.facets->outer_radius_mm()) *
      (1 + kMostRigidityError);
  const double gap = distance(first.centre, second.centre) * (1 - 8 * kRoundoff) -
                     first.centre_error_mm - second.centre_error_mm - reach;
  if (gap > 0) {
    ++counts_.by_spheres;
    grant(gap);
    return Verdict::Apart;
  }

  ++counts_.pairs.queries;
  const RelativePose pose = relative(first, second);
  const Vec3& second_origin = second.proofs.facets->origin();
  const PairPose in_first{
      pose.rotation, pose.offset + first.proofs.facets->origin() - pose.rotation * second_origin};
  const double slack_mm =
      pose.offset_error_mm + pose.rotation_error * second.proofs.facets->outer_radius_mm() +
      16 * kRoundoff *
          (taxicab(pose.offset) + taxicab(second_origin) + taxicab(first.proofs.facets->origin()));
  Verdict verdict = pair.ready.again(in_first, slack_mm);
  if (verdict != Verdict::Unknown) {
    ++counts_.pairs.by_last_proof;
  } else {
    verdict = pair.ready.from_last(first.proofs, second.proofs, in_first, slack_mm);
    if (verdict != Verdict::Unknown) ++counts_.pairs.by_walking;
  }
  if (verdict == Verdict::Unknown) {
    verdict = GrowthProgram(first.proofs, second.proofs).decide(pose, pair.memory, counts_.pairs);
    if (verdict == Verdict::Unknown) return decide_exactly(pair);
    if (verdict == Verdict::Apart) {
      pair.ready.set(pair.memory.separation, first.proofs, second.proofs, in_first.translation);
    } else {
      pair.ready.set(pair.memory.ball, first.proofs, second.proofs, in_first.translation);
    }
  }
  grant(pair.ready.margin_mm(in_first, slack_mm));
  return verdict;
}

Verdict GrowthScene::decide_exactly(Pair& pair) noexcept {
  const Body& first = bodies_[pair.bodies.first];
  const Body& second = bodies_[pair.bodies.second];
  ExactHint hint;
  if (first.is_ordinary && second.is_ordinary) {
    hint = GrowthProgram(first.proofs, second.proofs).hint(*first.body, *second.body, pair.memory);
    hint.direction = first.pose.rotation * hint.direction;
  }
  const ExactAnswer answer =
      exactly_meet({first.body, first.pose.rotation, first.pose.translation},
                   {second.body, second.pose.rotation, second.pose.translation}, hint);
  ++counts_.pairs.exact;
  counts_.pairs.exact_rounds += answer.rounds;
  pair.ready.set_unknown();
  return answer.verdict;
}

}  // namespace carpus::collision
