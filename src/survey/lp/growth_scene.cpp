// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. Every body: where its origin is, and at most how far any of its points has moved since the
//    last update; the sums of these are its path.
// 2. Every pair whose two paths have not yet used up its last proof's margin keeps its verdict.
// 3. Others: spheres, the last proof, the growth program, exact arithmetic; then a new margin.
#include "survey/lp/growth_scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "convex/growth/growth_decision.hpp"

namespace carpus::survey {
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

GrowthScene::GrowthScene(std::span<const convex::ConvexBody* const> bodies, bool uses_budget)
    : uses_budget_(uses_budget) {
  for (const convex::ConvexBody* body : bodies) {
    Body placed;
    placed.body = body;
    placed.proofs = convex::ProofBody(*body);
    placed.origin = placed.proofs.facets->origin();
    placed.radius_mm = placed.proofs.facets->outer_radius_mm();
    placed.is_usable = placed.proofs.facets->is_usable();
    bodies_.push_back(placed);
  }
  for (std::uint32_t i = 0; i < bodies.size(); ++i) {
    for (std::uint32_t j = i + 1; j < bodies.size(); ++j) {
      Pair pair;
      pair.bodies = {i, j};
      pairs_.push_back(pair);
    }
  }
  limits_mm_.assign(pairs_.size(), -1);
  asked_.reserve(pairs_.size());
  verdicts_.assign(pairs_.size(), convex::Verdict::Unknown);
}

void GrowthScene::forget() noexcept {
  for (Pair& pair : pairs_) {
    pair.memory = {};
    pair.ready = {};
  }
  std::fill(limits_mm_.begin(), limits_mm_.end(), -1);
}

void GrowthScene::place(Body& body, const BodyPose& pose) const noexcept {
  const Vec3& origin = body.origin;
  const Vec3 centre = pose.rotation * origin + pose.translation;
  const double error =
      16 * kRoundoff * (convex::taxicab(origin) + convex::taxicab(pose.translation));
  const double rigidity = rigidity_error_of(pose.rotation);
  const bool is_ordinary = body.is_usable && rigidity <= kMostRigidityError &&
                           convex::taxicab(pose.translation) <= convex::kMostTranslation;
  if (is_ordinary && body.is_ordinary && body.has_moved) {
    const Mat3& r = pose.rotation;
    const Mat3& q = body.pose.rotation;
    const double turn =
        std::sqrt(squared_length(r.rows[0] - q.rows[0]) + squared_length(r.rows[1] - q.rows[1]) +
                  squared_length(r.rows[2] - q.rows[2]));
    const double motion =
        distance(centre, body.centre) + turn * body.radius_mm + error + body.centre_error_mm;
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
    std::fill(limits_mm_.begin(), limits_mm_.end(), -1);
  }
  find_asked();
  counts_.by_budget += pairs_.size() - asked_.size();
  tick.queries = asked_.size();
  for (std::size_t k = 0; k < asked_.size(); ++k) {
    if (k + 2 < asked_.size()) fetch(asked_[k + 2]);
    verdicts_[asked_[k]] = decide(asked_[k]);
  }
  for (const convex::Verdict verdict : verdicts_) {
    tick.meeting += verdict == convex::Verdict::Meet ? 1U : 0U;
    tick.unknown += verdict == convex::Verdict::Unknown ? 1U : 0U;
  }
  return tick;
}

void GrowthScene::find_asked() noexcept {
  asked_.clear();
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    for (std::size_t j = i + 1; j < bodies_.size(); ++j, ++number) {
      const bool is_spared = bodies_[i].path_mm + bodies_[j].path_mm < limits_mm_[number];
      if (!is_spared) asked_.push_back(number);
    }
  }
}

/// Asks for a pair's memory, which takes longer to come than a proof to try.
void GrowthScene::fetch(std::size_t number) const noexcept {
  const auto* bytes = reinterpret_cast<const char*>(&pairs_[number]);
  for (std::size_t at = 0; at < offsetof(Pair, memory); at += 64) __builtin_prefetch(bytes + at);
}

convex::RelativePose GrowthScene::relative(const Body& first, const Body& second) noexcept {
  const auto& a = first.pose.rotation.rows;
  const auto& b = second.pose.rotation.rows;
  const Vec3 d = second.centre - first.centre;
  convex::RelativePose pose;
  for (std::size_t i = 0; i < 3; ++i) {
    pose.rotation.rows[i] = b[0] * a[0][i] + b[1] * a[1][i] + b[2] * a[2][i];
  }
  pose.offset = a[0] * d.x + a[1] * d.y + a[2] * d.z;
  // The transpose differs from the inverse by no more than 1.1 times the rigidity error.
  pose.rotation_error = 16 * kRoundoff + 1.2 * first.rigidity_error;
  pose.offset_error_mm = 1.01 * (first.centre_error_mm + second.centre_error_mm) +
                         (16 * kRoundoff + 1.2 * first.rigidity_error) * convex::taxicab(d);
  return pose;
}

convex::Verdict GrowthScene::decide(std::size_t number) noexcept {
  Pair& pair = pairs_[number];
  const Body& first = bodies_[pair.bodies.first];
  const Body& second = bodies_[pair.bodies.second];
  limits_mm_[number] = -1;
  const auto placed = [&] {
    return convex::PlacedPair{{first.body, first.pose.rotation, first.pose.translation},
                              {second.body, second.pose.rotation, second.pose.translation}};
  };
  if (!first.is_ordinary || !second.is_ordinary) {
    return convex::decide_exactly({}, placed, pair.ready, counts_.pairs);
  }
  const double used = first.path_mm + second.path_mm;
  const auto grant = [&](double margin_mm) {
    if (uses_budget_) {
      limits_mm_[number] = (used + margin_mm * kMarginShare) * (1 - 8 * kRoundoff);
    }
  };

  const double reach = (first.radius_mm + second.radius_mm) * (1 + kMostRigidityError);
  const double gap = distance(first.centre, second.centre) * (1 - 8 * kRoundoff) -
                     first.centre_error_mm - second.centre_error_mm - reach;
  if (gap > 0) {
    ++counts_.by_spheres;
    grant(gap);
    return convex::Verdict::Apart;
  }

  ++counts_.pairs.queries;
  const convex::RelativePose pose = relative(first, second);
  const Vec3& second_origin = second.origin;
  const convex::PairPose in_first{pose.rotation,
                                  pose.offset + first.origin - pose.rotation * second_origin};
  const double slack_mm = pose.offset_error_mm + pose.rotation_error * second.radius_mm +
                          16 * kRoundoff *
                              (convex::taxicab(pose.offset) + convex::taxicab(second_origin) +
                               convex::taxicab(first.origin));
  convex::Verdict verdict = pair.ready.again(in_first, slack_mm);
  if (verdict != convex::Verdict::Unknown) {
    ++counts_.pairs.by_last_proof;
  } else {
    verdict = convex::walk_last_proofs(first.proofs, second.proofs, in_first, slack_mm, pair.ready,
                                       counts_.pairs);
  }
  if (verdict == convex::Verdict::Unknown) {
    verdict = convex::decide_pair(first.proofs, second.proofs, {in_first, pose, slack_mm}, placed,
                                  pair.ready, pair.memory, counts_.pairs);
  }
  if (pair.ready.last() != convex::Verdict::Unknown)
    grant(pair.ready.margin_mm(in_first, slack_mm));
  return verdict;
}

}  // namespace carpus::survey
