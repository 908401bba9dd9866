// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The last proofs of a pair in the form in which they are tried at the next pose: nearly every
// query of a moving wrist is answered here. What does not depend on the pose is summed up
// beforehand, and what is read lies in a few cache lines.
#pragma once

#include <cmath>
#include <cstdint>

#include "convex/growth/pair_proofs.hpp"
#include "convex/growth/proof_body.hpp"
#include "convex/pair_query.hpp"
#include "convex/polar_graph.hpp"
#include "convex/relative_pose.hpp"
#include "convex/support.hpp"
#include "geometry/tolerance.hpp"
#include "geometry/vec3.hpp"

namespace carpus::convex {

/// The pose is within what the proofs' bounds of rounding cover.
[[nodiscard]] inline bool is_covered(const PairPose& pose, double most_translation) noexcept {
  return taxicab(pose.translation) <= most_translation &&
         squared_norm(pose.rotation) <= kMostSquaredNorm;
}

/// A SeparationProof. With q = R'n, which -m was at the proof's pose, and both bodies' origins o,
/// the gap along n is  q . o2 + n . t - n . o1 - reaches - |q + m| r2 - rounding.
class ReadySeparation {
 public:
  /// @param translation  of the pose of the proof.
  void set(const SeparationProof& proof,
           const ProofBody& first,
           const ProofBody& second,
           const Vec3& translation) noexcept;

  /// @param slack_mm  how far any point of the second body may be from where the pose puts it.
  [[nodiscard]] bool holds(const PairPose& pose, double slack_mm) const noexcept {
    const Vec3 q = turned(pose);
    const double gap = gap_before_turn(pose, q, threshold_) - slack_mm * size_;
    return gap > 0 && gap * gap > squared_length(q + m_) * squared_radius_ &&
           is_covered(pose, most_translation_);
  }

  /// A lower bound of the bodies' distance.
  [[nodiscard]] double margin_mm(const PairPose& pose, double slack_mm) const noexcept {
    const Vec3 q = turned(pose);
    return (gap_before_turn(pose, q, threshold_) -
            std::sqrt(squared_length(q + m_) * squared_radius_)) *
               (1 - 8 * kRoundoff) / size_ -
           slack_mm;
  }

  /// Measures how far the second body reaches against n, walking over its vertices. True where that
  /// proves the bodies apart; it is the proof then.
  [[nodiscard]] bool walk(const ProofBody& second, const PairPose& pose, double slack_mm) noexcept;

 private:
  [[nodiscard]] Vec3 turned(const PairPose& pose) const noexcept {
    const auto& r = pose.rotation.rows;
    return r[0] * n_.x + r[1] * n_.y + r[2] * n_.z;
  }
  [[nodiscard]] double gap_before_turn(const PairPose& pose,
                                       const Vec3& q,
                                       double threshold) const noexcept {
    return dot(q, second_origin_) + dot(n_, pose.translation) - threshold;
  }
  [[nodiscard]] double threshold(double second_reach) const noexcept {
    return base_ + (first_reach_ + second_reach);
  }

  Vec3 n_;
  Vec3 m_;
  Vec3 second_origin_;
  double threshold_ = HUGE_VAL;
  double squared_radius_ = 0;
  double most_translation_ = 0;
  double size_ = 1;  // at least |n|
  // For walks:
  double base_ = 0;
  double first_reach_ = 0;
  std::uint32_t second_corner_ = 0;
  bool has_second_corner_ = false;
};

/// A CommonBallProof, its centres in the bodies' own frames.
class ReadyBall {
 public:
  void set(const CommonBallProof& proof,
           const ProofBody& first,
           const ProofBody& second,
           const Vec3& translation) noexcept;

  /// @param slack_mm  how far any point of the second body may be from where the pose puts it.
  [[nodiscard]] bool holds(const PairPose& pose, double slack_mm) const noexcept {
    const Vec3 d = pose.rotation * in_second_ + (pose.translation - in_first_);
    const double squared = squared_length(d) * (1 + 32 * kRoundoff);
    const double first = first_radius_mm_ - slack_mm;
    const double both = both_radii_mm_ - slack_mm;
    const bool is_within = (first >= 0 && squared <= first * first) ||
                           (both >= 0 && squared <= both * both && is_rigid(pose.rotation));
    return is_within && is_covered(pose, most_translation_);
  }
  /// How far any point of the second body may still move.
  [[nodiscard]] double margin_mm(const PairPose& pose, double slack_mm) const noexcept {
    const Vec3 d = pose.rotation * in_second_ + (pose.translation - in_first_);
    return (is_rigid(pose.rotation) ? both_radii_mm_ : first_radius_mm_) -
           length(d) * (1 + 32 * kRoundoff) - slack_mm;
  }

  /// Is the point of the second body still in the first one? By a walk over its facets, from where
  /// the last one ended. True where it is; the ball about it is the proof then.
  [[nodiscard]] bool walk(const ProofBody& first, const PairPose& pose, double slack_mm) noexcept;

 private:
  Vec3 in_second_;
  Vec3 in_first_;
  double first_radius_mm_ = -1;
  double both_radii_mm_ = -1;
  double most_translation_ = -1;
  // For walks:
  double second_radius_mm_ = 0;
  double rounding_mm_ = 0;
  std::uint32_t face_ = 0;
  bool has_face_ = false;
};

/// The last proof of each verdict; both are kept, for bodies about to touch go back and forth.
class ReadyProof {
 public:
  [[nodiscard]] Verdict last() const noexcept { return last_; }

  /// Is the last verdict proven by the last proof as it is? Else Unknown.
  /// @param slack_mm  how far any point of the second body may be from where the pose puts it.
  [[nodiscard]] Verdict again(const PairPose& pose, double slack_mm = 0) const noexcept {
    if (last_ == Verdict::Apart ? separation_.holds(pose, slack_mm)
                                : last_ == Verdict::Meet && ball_.holds(pose, slack_mm)) {
      return last_;
    }
    return Verdict::Unknown;
  }
  /// Where that fails, by walks from where the last proofs were: is the point of the last common
  /// ball still in both bodies? True makes it the last proof.
  [[nodiscard]] bool meets(const ProofBody& first, const PairPose& pose, double slack_mm) noexcept {
    if (!ball_.walk(first, pose, slack_mm)) return false;
    last_ = Verdict::Meet;
    return true;
  }
  /// Do planes of the last separation's direction still part the bodies? Likewise.
  [[nodiscard]] bool parts(const ProofBody& second,
                           const PairPose& pose,
                           double slack_mm) noexcept {
    if (!separation_.walk(second, pose, slack_mm)) return false;
    last_ = Verdict::Apart;
    is_new_ = false;
    return true;
  }
  /// The last verdict was none of parts(), which is then likely to fail again.
  [[nodiscard]] bool is_new() const noexcept { return is_new_; }
  /// After a verdict: no point of the second body can change it by moving less, as seen from the
  /// first.
  [[nodiscard]] double margin_mm(const PairPose& pose, double slack_mm) const noexcept {
    return last_ == Verdict::Apart ? separation_.margin_mm(pose, slack_mm)
                                   : ball_.margin_mm(pose, slack_mm);
  }

  void set(const SeparationProof& proof,
           const ProofBody& first,
           const ProofBody& second,
           const Vec3& translation) noexcept {
    separation_.set(proof, first, second, translation);
    last_ = Verdict::Apart;
    is_new_ = true;
  }
  void set(const CommonBallProof& proof,
           const ProofBody& first,
           const ProofBody& second,
           const Vec3& translation) noexcept {
    ball_.set(proof, first, second, translation);
    last_ = Verdict::Meet;
    is_new_ = true;
  }
  /// Where exact numbers decided.
  void set_unknown() noexcept {
    last_ = Verdict::Unknown;
    is_new_ = true;
  }

 private:
  Verdict last_ = Verdict::Unknown;
  bool is_new_ = false;
  ReadySeparation separation_;
  ReadyBall ball_;
};

}  // namespace carpus::convex
