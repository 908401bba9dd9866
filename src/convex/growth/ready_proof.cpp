// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "convex/growth/ready_proof.hpp"

namespace carpus::convex {

void ReadySeparation::set(const SeparationProof& proof,
                          const ProofBody& first,
                          const ProofBody& second,
                          const Vec3& translation) noexcept {
  const Vec3& first_origin = first.facets->origin();
  const double radius = second.facets->outer_radius_mm();
  n_ = proof.n;
  m_ = proof.m;
  size_ = proof.size;
  second_origin_ = second.facets->origin();
  most_translation_ = 2 * taxicab(translation) + 1;
  squared_radius_ = radius * radius * (1 + 64 * kRoundoff);
  first_reach_ = proof.first_reach;
  // q is off by under 6 u size, as the matrix's norm is below 1.77; its product with the origin and
  // the turn's with the radius inherit that; sums lose 8 u of what enters, reaches that are
  // measured later among it: no reach exceeds 2 size times a radius.
  const double radii = radius + first.facets->outer_radius_mm();
  const double rounding =
      proof.size * kRoundoff *
          (32 * (taxicab(first_origin) + taxicab(second_origin_) + most_translation_) +
           64 * radii) +
      16 * kRoundoff * (first_reach_ + proof.second_reach);
  base_ = dot(n_, first_origin) + rounding;
  threshold_ = threshold(proof.second_reach);
  has_second_corner_ = false;
}

bool ReadySeparation::walk(const ProofBody& second,
                           const PairPose& pose,
                           double slack_mm) noexcept {
  if (!is_covered(pose, most_translation_)) return false;
  const Vec3 q = turned(pose);
  const SupportGraph& corners = *second.corners;
  if (!has_second_corner_) second_corner_ = corners.near(-q);
  has_second_corner_ = true;
  // A corner beyond the plane ends the matter; often the last one still is.
  const double least_reach = -dot(q, corners.corner(second_corner_));
  if (!(gap_before_turn(pose, q, threshold(least_reach)) > 0)) return false;
  const CertainTop top = corners.certain_climb(-q, second_corner_);
  second_corner_ = top.corner;
  if (!top.is_certain) return false;
  m_ = -q;
  threshold_ = threshold(top.reach);
  return gap_before_turn(pose, q, threshold_) > slack_mm * size_;
}

void ReadyBall::set(const CommonBallProof& proof,
                    const ProofBody& first,
                    const ProofBody& second,
                    const Vec3& translation) noexcept {
  const Vec3& first_origin = first.facets->origin();
  const Vec3& second_origin = second.facets->origin();
  in_second_ = proof.in_second + second_origin;
  in_first_ = proof.in_first + first_origin;
  most_translation_ = 2 * taxicab(translation) + 1;
  // 8 u of all that enters, times the matrix's norm; the first body's ball may move within it.
  rounding_mm_ = 32 * kRoundoff *
                 (taxicab(proof.in_second) + taxicab(second_origin) +
                  first.facets->outer_radius_mm() + taxicab(first_origin) + most_translation_);
  first_radius_mm_ = proof.first_radius_mm - rounding_mm_;
  second_radius_mm_ = proof.second_radius_mm * kLeastStretch;
  both_radii_mm_ = first_radius_mm_ + second_radius_mm_;
  has_face_ = false;
}

bool ReadyBall::walk(const ProofBody& first, const PairPose& pose, double slack_mm) noexcept {
  if (!is_covered(pose, most_translation_)) return false;
  const PolarGraph& graph = *first.facets;
  const Vec3 in_first = pose.rotation * in_second_ + pose.translation;
  const Vec3 d = in_first - graph.origin();
  if (!has_face_) face_ = graph.start_for(d);
  has_face_ = true;
  // The face of the last walk may already lie before the point.
  if (graph.row(face_).gauge(d) > 1) return false;
  face_ = graph.climb(face_, d).face;
  const double radius =
      (1 - graph.gauge_bound(face_, d)) * graph.inner_radius_mm() * (1 - 4 * kRoundoff) -
      rounding_mm_;
  if (!(radius >= slack_mm)) return false;
  in_first_ = in_first;
  first_radius_mm_ = radius;
  both_radii_mm_ = radius + second_radius_mm_;
  return true;
}

}  // namespace carpus::convex
