// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Bullet's GJK and EPA (btGjkEpa3.h, double precision) with our warm support points and the last
// ray as its guess. Its accuracy of 1e-4 is built in.
//
// btGjkEpaSolver3_Distance and _Penetration, which are followed here, ask a second time for the
// support points in the directions of the last simplex and add them up to witness points. Where a
// facet or an edge lies across such a direction, a climb from elsewhere ends on another of its
// corners, equally high, and the sum is off by as much as the edge is long (13 mm on a radius). So
// each side recalls what it answered; Bullet keeps only the difference of the two points.
//
// What remains is its own, with full scans for support points too: bodies nearer than 1e-4 mm are
// called meeting, and its GJK ends where a point comes again within 0.01 mm, which may be early:
// a distance is then too long (from a far guess by up to 0.2 mm), or bodies that meet are apart.
#include <BulletCollision/NarrowPhaseCollision/btGjkEpa3.h>

#include <array>
#include <cstddef>

#include "bench/collision/climbing_pair.hpp"
#include "bench/collision/peers.hpp"

namespace carpus::bench {
namespace {

using convex::Closest;
using convex::PairPose;
using convex::Penetration;
using convex::Verdict;

Vec3 vector_of(const btVector3& v) { return {v.x(), v.y(), v.z()}; }
btVector3 bullet_of(const Vec3& v) { return {v.x, v.y, v.z}; }

/// What one side answered during one query.
class Answers {
 public:
  void clear() noexcept { count_ = 0; }
  void add(const btVector3& direction, const btVector3& point) noexcept {
    if (count_ < answers_.size()) answers_[count_++] = {direction, point};
  }
  /// Nothing where it was not asked.
  [[nodiscard]] const btVector3* find(const btVector3& direction) const noexcept {
    for (std::size_t i = 0; i < count_; ++i) {
      if (answers_[i].direction == direction) return &answers_[i].point;
    }
    return nullptr;
  }

 private:
  struct Answer {
    btVector3 direction;
    btVector3 point;
  };
  /// GJK's 128 steps and EPA's 64 vertices, and what is asked to enclose the origin.
  std::array<Answer, 256> answers_;
  std::size_t count_ = 0;
};

/// A convex shape as Bullet's templates want it.
struct Side {
  ClimbingPair* pair = nullptr;
  Answers* answers = nullptr;
  bool is_second = false;
  btTransform placed = btTransform::getIdentity();

  [[nodiscard]] btVector3 getLocalSupportWithMargin(const btVector3& d) const {
    const Vec3 v = vector_of(d);
    const btVector3 point =
        bullet_of(is_second ? pair->second_local_support(v) : pair->first_support(v));
    answers->add(d, point);
    return point;
  }
  [[nodiscard]] btVector3 recalled(const btVector3& d) const {
    const btVector3* known = answers->find(d);
    return known != nullptr ? *known : getLocalSupportWithMargin(d);
  }
  [[nodiscard]] const btTransform& getWorldTransform() const { return placed; }
};

class BulletQuery final : public convex::PairQuery {
 public:
  BulletQuery(const convex::ConvexBody& first, const convex::ConvexBody& second)
      : pair_(first, second) {}
  Verdict meets(const PairPose& pose) noexcept override {
    place(pose);
    if (pair_.last_axis_separates()) return Verdict::Apart;
    GJK<Side> gjk(first_, second_);
    const eGjkStatus status = gjk.Evaluate(difference(), guess());
    guess_ = gjk.m_ray;
    return status == eGjkFailed ? Verdict::Unknown : pair_.answered(status == eGjkInside);
  }
  std::optional<Closest> closest(const PairPose& pose) noexcept override {
    place(pose);
    const Difference difference = this->difference();
    GJK<Side> gjk(first_, second_);
    if (gjk.Evaluate(difference, guess()) != eGjkValid) return std::nullopt;
    const btVector3 on_first = point_of_first(*gjk.m_simplex);
    const btVector3 on_second = point_of_second(*gjk.m_simplex, difference);
    guess_ = on_first - on_second;
    const double distance = guess_.length();
    return Closest{distance, vector_of(on_first), vector_of(on_second),
                   -vector_of(distance > 0 ? guess_ / distance : guess_)};
  }
  std::optional<Penetration> penetration(const PairPose& pose) noexcept override {
    place(pose);
    GJK<Side> gjk(first_, second_);
    if (gjk.Evaluate(difference(), -guess()) != eGjkInside) return std::nullopt;
    EPA<Side> epa;
    if (epa.Evaluate(gjk, -guess()) == eEpaFailed) return std::nullopt;
    const btVector3 on_first = point_of_first(epa.m_result);
    return Penetration{epa.m_depth, vector_of(epa.m_normal), vector_of(on_first),
                       vector_of(on_first - epa.m_normal * epa.m_depth)};
  }
  void forget() noexcept override {
    pair_.forget();
    guess_ = btVector3(0, 0, 0);
  }

 private:
  using Difference = MinkowskiDiff<Side>;
  using Simplex = GJK<Side>::sSimplex;

  [[nodiscard]] Difference difference() const {
    Difference shapes(first_, second_);
    btGjkEpaSolver3::sResults unused;
    Initialize(first_, second_, unused, shapes);
    return shapes;
  }
  [[nodiscard]] btVector3 point_of_first(const Simplex& simplex) const {
    btVector3 sum(0, 0, 0);
    for (U i = 0; i < simplex.rank; ++i) sum += first_.recalled(simplex.c[i]->d) * simplex.p[i];
    return sum;
  }
  [[nodiscard]] btVector3 point_of_second(const Simplex& simplex, const Difference& shapes) const {
    btVector3 sum(0, 0, 0);
    for (U i = 0; i < simplex.rank; ++i) {
      sum += second_.recalled(shapes.m_toshape1 * -simplex.c[i]->d) * simplex.p[i];
    }
    return shapes.m_toshape0 * sum;
  }
  [[nodiscard]] btVector3 guess() const {
    return guess_.length2() > 0 ? guess_ : bullet_of(pair_.first_centre() - pair_.second_centre());
  }
  void place(const PairPose& pose) noexcept {
    pair_.place(pose);
    first_answers_.clear();
    second_answers_.clear();
    const auto& r = pose.rotation.rows;
    second_.placed.getBasis().setValue(r[0].x, r[0].y, r[0].z, r[1].x, r[1].y, r[1].z, r[2].x,
                                       r[2].y, r[2].z);
    second_.placed.setOrigin(bullet_of(pose.translation));
  }
  ClimbingPair pair_;
  Answers first_answers_;
  Answers second_answers_;
  Side first_{&pair_, &first_answers_, false};
  Side second_{&pair_, &second_answers_, true};
  btVector3 guess_{0, 0, 0};
};

}  // namespace

std::vector<PairEngine> bullet_engines() {
  return {
      {"bullet", true, true, true, [](const convex::ConvexBody& a, const convex::ConvexBody& b) {
         return std::make_unique<BulletQuery>(a, b);
       }}};
}

}  // namespace carpus::bench
