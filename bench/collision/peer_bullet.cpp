// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Bullet's GJK and EPA (btGjkEpa3.h, double precision) with our warm support points and the last
// ray as its guess. Its accuracy of 1e-4 is built in.
#include <BulletCollision/NarrowPhaseCollision/btGjkEpa3.h>

#include "bench/collision/climbing_pair.hpp"
#include "bench/collision/peers.hpp"

namespace carpus::bench {
namespace {

using collision::Closest;
using collision::PairPose;
using collision::Penetration;
using collision::Verdict;

Vec3 vector_of(const btVector3& v) { return {v.x(), v.y(), v.z()}; }
btVector3 bullet_of(const Vec3& v) { return {v.x, v.y, v.z}; }

/// A convex shape as Bullet's templates want it.
struct Side {
  ClimbingPair* pair = nullptr;
  bool is_second = false;
  btTransform placed = btTransform::getIdentity();

  [[nodiscard]] btVector3 getLocalSupportWithMargin(const btVector3& d) const {
    const Vec3 v = vector_of(d);
    return bullet_of(is_second ? pair->second_local_support(v) : pair->first_support(v));
  }
  [[nodiscard]] const btTransform& getWorldTransform() const { return placed; }
};

class BulletQuery final : public collision::PairQuery {
 public:
  BulletQuery(const collision::ConvexBody& first, const collision::ConvexBody& second)
      : pair_(first, second) {}
  Verdict meets(const PairPose& pose) noexcept override {
    place(pose);
    if (pair_.last_axis_separates()) return Verdict::Apart;
    MinkowskiDiff<Side> difference(first_, second_);
    btGjkEpaSolver3::sResults results;
    Initialize(first_, second_, results, difference);
    GJK<Side> gjk(first_, second_);
    const eGjkStatus status = gjk.Evaluate(difference, guess());
    guess_ = gjk.m_ray;
    return status == eGjkFailed ? Verdict::Unknown : pair_.answered(status == eGjkInside);
  }
  std::optional<Closest> closest(const PairPose& pose) noexcept override {
    place(pose);
    btGjkEpaSolver3::sResults results;
    if (!btGjkEpaSolver3_Distance(first_, second_, guess(), results)) return std::nullopt;
    guess_ = results.witnesses[0] - results.witnesses[1];
    return Closest{results.distance, vector_of(results.witnesses[0]),
                   vector_of(results.witnesses[1]), -vector_of(results.normal)};
  }
  std::optional<Penetration> penetration(const PairPose& pose) noexcept override {
    place(pose);
    btGjkEpaSolver3::sResults results;
    if (!btGjkEpaSolver3_Penetration(first_, second_, guess(), results)) return std::nullopt;
    return Penetration{-results.distance, -vector_of(results.normal),
                       vector_of(results.witnesses[0]), vector_of(results.witnesses[1])};
  }
  void forget() noexcept override {
    pair_.forget();
    guess_ = btVector3(0, 0, 0);
  }

 private:
  [[nodiscard]] btVector3 guess() const {
    return guess_.length2() > 0 ? guess_ : bullet_of(pair_.first_centre() - pair_.second_centre());
  }
  void place(const PairPose& pose) noexcept {
    pair_.place(pose);
    const auto& r = pose.rotation.rows;
    second_.placed.getBasis().setValue(r[0].x, r[0].y, r[0].z, r[1].x, r[1].y, r[1].z, r[2].x,
                                       r[2].y, r[2].z);
    second_.placed.setOrigin(bullet_of(pose.translation));
  }
  ClimbingPair pair_;
  Side first_{&pair_, false};
  Side second_{&pair_, true};
  btVector3 guess_{0, 0, 0};
};

}  // namespace

std::vector<PairEngine> bullet_engines() {
  return {{"bullet", true, true, true,
           [](const collision::ConvexBody& a, const collision::ConvexBody& b) {
             return std::make_unique<BulletQuery>(a, b);
           }}};
}

}  // namespace carpus::bench
