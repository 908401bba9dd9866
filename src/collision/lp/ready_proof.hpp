// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The last proofs of a pair in the form in which they are tried at the next pose: nearly every
// query of a moving wrist is answered here. What does not depend on the pose is summed up
// beforehand, and what is read lies in two cache lines.
#pragma once

#include <cstdint>

#include "collision/lp/pair_proofs.hpp"
#include "collision/lp/polar_graph.hpp"
#include "collision/lp/relative_pose.hpp"
#include "collision/pair_query.hpp"
#include "geometry/tolerance.hpp"
#include "geometry/vec3.hpp"

namespace carpus::collision {

/// A SeparationProof. With q = R'n, which -m was at the proof's pose, and both bodies' origins o,
/// the gap along n is  q . o2 + n . t - n . o1 - reaches - |q + m| r2 - rounding.
class ReadySeparation {
 public:
  /// @param translation  of the pose of the proof.
  void set(const SeparationProof& proof,
           const PolarGraph& first,
           const PolarGraph& second,
           const Vec3& translation) noexcept {
    n_ = proof.n;
    m_ = proof.m;
    second_origin_ = second.origin();
    most_translation_ = 2 * taxicab(translation) + 1;
    squared_radius_ = second.outer_radius_mm() * second.outer_radius_mm() * (1 + 64 * kRoundoff);
    const double reach = proof.first_reach + proof.second_reach;
    // q is off by under 6 u size, as the matrix's norm is below 1.77; its product with the origin
    // and the turn's with the radius inherit that; sums lose 4 u of what enters.
    const double rounding =
        proof.size * (32 * kRoundoff *
                          (taxicab(first.origin()) + taxicab(second.origin()) + most_translation_) +
                      16 * kRoundoff * second.outer_radius_mm()) +
        16 * kRoundoff * reach;
    threshold_ = dot(n_, first.origin()) + reach + rounding;
  }
  [[nodiscard]] bool holds(const PairPose& pose) const noexcept {
    const auto& r = pose.rotation.rows;
    const Vec3& t = pose.translation;
    const Vec3 q = r[0] * n_.x + r[1] * n_.y + r[2] * n_.z;
    const double gap = dot(q, second_origin_) + dot(n_, t) - threshold_;
    return gap > 0 && gap * gap > squared_length(q + m_) * squared_radius_ &&
           taxicab(t) <= most_translation_ && squared_norm(pose.rotation) <= kMostSquaredNorm;
  }

 private:
  Vec3 n_;
  Vec3 m_;
  Vec3 second_origin_;
  double threshold_ = HUGE_VAL;
  double squared_radius_ = 0;
  double most_translation_ = 0;
};

/// A CommonBallProof, its centres in the bodies' own frames.
class ReadyBall {
 public:
  void set(const CommonBallProof& proof,
           const PolarGraph& first,
           const PolarGraph& second,
           const Vec3& translation) noexcept {
    in_second_ = proof.in_second + second.origin();
    in_first_ = proof.in_first + first.origin();
    most_translation_ = 2 * taxicab(translation) + 1;
    const double rounding = 32 * kRoundoff *
                            (taxicab(proof.in_second) + taxicab(second.origin()) +
                             taxicab(proof.in_first) + taxicab(first.origin()) + most_translation_);
    first_radius_mm_ = proof.first_radius_mm - rounding;
    both_radii_mm_ = first_radius_mm_ + proof.second_radius_mm * kLeastStretch;
  }
  [[nodiscard]] bool holds(const PairPose& pose) const noexcept {
    const Vec3 d = pose.rotation * in_second_ + (pose.translation - in_first_);
    const double squared = squared_length(d) * (1 + 32 * kRoundoff);
    const bool is_within =
        (first_radius_mm_ >= 0 && squared <= first_radius_mm_ * first_radius_mm_) ||
        (both_radii_mm_ >= 0 && squared <= both_radii_mm_ * both_radii_mm_ &&
         is_rigid(pose.rotation));
    return is_within && taxicab(pose.translation) <= most_translation_ &&
           squared_norm(pose.rotation) <= kMostSquaredNorm;
  }

 private:
  Vec3 in_second_;
  Vec3 in_first_;
  double first_radius_mm_ = -1;
  double both_radii_mm_ = -1;
  double most_translation_ = 0;
};

/// The last proof of each verdict. Bodies about to touch go back and forth: where the last one
/// fails the other is tried.
class ReadyProof {
 public:
  [[nodiscard]] Verdict last() const noexcept { return last_; }

  /// Unknown where neither proof holds; last() stays then.
  [[nodiscard]] Verdict again(const PairPose& pose) noexcept {
    if (last_ == Verdict::Unknown) return Verdict::Unknown;
    if (last_ == Verdict::Apart ? separation_.holds(pose) : ball_.holds(pose)) return last_;
    if (last_ == Verdict::Apart ? !ball_.holds(pose) : !separation_.holds(pose)) {
      return Verdict::Unknown;
    }
    last_ = last_ == Verdict::Apart ? Verdict::Meet : Verdict::Apart;
    return last_;
  }

  void set(const SeparationProof& proof,
           const PolarGraph& first,
           const PolarGraph& second,
           const Vec3& translation) noexcept {
    separation_.set(proof, first, second, translation);
    last_ = Verdict::Apart;
  }
  void set(const CommonBallProof& proof,
           const PolarGraph& first,
           const PolarGraph& second,
           const Vec3& translation) noexcept {
    ball_.set(proof, first, second, translation);
    last_ = Verdict::Meet;
  }
  /// Where exact numbers decided.
  void set_unknown() noexcept { last_ = Verdict::Unknown; }

 private:
  Verdict last_ = Verdict::Unknown;
  ReadySeparation separation_;
  ReadyBall ball_;
};

}  // namespace carpus::collision
