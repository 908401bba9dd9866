// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// FCL in its three ways: `fcl`, its libccd solver with our warm support points through the same
// hooks that its own shapes use; `fcl_convex`, the same solver with FCL's own convex shape (which
// climbs from vertex 0 each time); `fcl_indep`, its GJK and EPA, which scan all vertices and take
// the last direction as a guess.
#include <fcl/geometry/shape/convex.h>
#include <fcl/narrowphase/detail/gjk_solver_indep.h>
#include <fcl/narrowphase/detail/gjk_solver_libccd.h>

#include <map>

#include "bench/collision/climbing_pair.hpp"
#include "bench/collision/peers.hpp"

namespace carpus::bench {
namespace {

using convex::Closest;
using convex::ConvexBody;
using convex::PairPose;
using convex::Penetration;
using convex::Verdict;
using FclVector = fcl::Vector3d;

constexpr unsigned kMostIterations = 500;
constexpr double kTolerance = 1e-6;  // FCL's defaults

Vec3 vector_of(const FclVector& v) { return {v.x(), v.y(), v.z()}; }

void support(const void* side, const ccd_vec3_t* d, ccd_vec3_t* out) {
  const Vec3 v = static_cast<const ClimbingSide*>(side)->support({d->v[0], d->v[1], d->v[2]});
  ccdVec3Set(out, v.x, v.y, v.z);
}
void centre(const void* side, ccd_vec3_t* out) {
  const Vec3 v = static_cast<const ClimbingSide*>(side)->centre();
  ccdVec3Set(out, v.x, v.y, v.z);
}

std::optional<Closest> closest_of(bool apart, double d, const FclVector& p, const FclVector& q) {
  if (!apart || !(d > 0)) return std::nullopt;
  return Closest{d, vector_of(p), vector_of(q),
                 normalized_or(vector_of(q) - vector_of(p), {1, 0, 0})};
}
std::optional<Penetration> penetration_of(double signed_distance,
                                          const FclVector& p,
                                          const FclVector& q) {
  if (!(signed_distance <= 0)) return std::nullopt;
  return Penetration{-signed_distance, normalized_or(vector_of(p) - vector_of(q), {1, 0, 0}),
                     vector_of(p), vector_of(q)};
}

class FclHookQuery final : public convex::PairQuery {
 public:
  FclHookQuery(const ConvexBody& first, const ConvexBody& second) : pair_(first, second) {}
  Verdict meets(const PairPose& pose) noexcept override {
    pair_.place(pose);
    if (pair_.last_axis_separates()) return Verdict::Apart;
    return pair_.answered(fcl::detail::GJKCollide<double>(
        &first_, support, centre, &second_, support, centre, kMostIterations, kTolerance,
        static_cast<FclVector*>(nullptr), nullptr, static_cast<FclVector*>(nullptr)));
  }
  std::optional<Closest> closest(const PairPose& pose) noexcept override {
    pair_.place(pose);
    double d = 0;
    FclVector p;
    FclVector q;
    const bool apart = fcl::detail::GJKDistance<double>(&first_, support, &second_, support,
                                                        kMostIterations, kTolerance, &d, &p, &q);
    return closest_of(apart, d, p, q);
  }
  std::optional<Penetration> penetration(const PairPose& pose) noexcept override {
    pair_.place(pose);
    double d = 0;
    FclVector p;
    FclVector q;
    fcl::detail::GJKSignedDistance<double>(&first_, support, &second_, support, kMostIterations,
                                           kTolerance, &d, &p, &q);
    return penetration_of(d, p, q);
  }
  void forget() noexcept override { pair_.forget(); }

 private:
  ClimbingPair pair_;
  ClimbingSide first_{&pair_, false};
  ClimbingSide second_{&pair_, true};
};

using Shape = fcl::Convex<double>;

/// One shape a body, shared by all pairs, as a scene of FCL's would.
std::shared_ptr<const Shape> shape_of(const ConvexBody& body) {
  static std::map<const ConvexBody*, std::weak_ptr<const Shape>> shapes;
  std::weak_ptr<const Shape>& known = shapes[&body];
  if (auto shape = known.lock()) return shape;
  auto vertices = std::make_shared<std::vector<FclVector>>();
  for (const Vec3& v : body.vertices()) vertices->emplace_back(v.x, v.y, v.z);
  auto faces = std::make_shared<std::vector<int>>();
  for (const hull::PolygonalFace& f : body.faces()) {
    faces->push_back(static_cast<int>(f.corners.size()));
    for (const std::uint32_t c : f.corners) faces->push_back(static_cast<int>(c));
  }
  auto shape =
      std::make_shared<const Shape>(vertices, static_cast<int>(body.faces().size()), faces);
  known = shape;
  return shape;
}

template <typename Solver>
class FclShapeQuery final : public convex::PairQuery {
 public:
  FclShapeQuery(const ConvexBody& first, const ConvexBody& second)
      : first_(shape_of(first)), second_(shape_of(second)) {
    forget();
  }
  Verdict meets(const PairPose& pose) noexcept override {
    place(pose);
    return solver_.shapeIntersect(*first_, still_, *second_, moved_, nullptr) ? Verdict::Meet
                                                                              : Verdict::Apart;
  }
  std::optional<Closest> closest(const PairPose& pose) noexcept override {
    place(pose);
    double d = 0;
    FclVector p;
    FclVector q;
    const bool apart = solver_.shapeDistance(*first_, still_, *second_, moved_, &d, &p, &q);
    return closest_of(apart, d, p, q);
  }
  std::optional<Penetration> penetration(const PairPose& pose) noexcept override {
    place(pose);
    double d = 0;
    FclVector p;
    FclVector q;
    solver_.shapeSignedDistance(*first_, still_, *second_, moved_, &d, &p, &q);
    return penetration_of(d, p, q);
  }
  void forget() noexcept override {
    solver_.setCachedGuess(FclVector(1, 0, 0));
    solver_.enableCachedGuess(true);
  }

 private:
  void place(const PairPose& pose) noexcept {
    for (int i = 0; i < 3; ++i) {
      const Vec3& row = pose.rotation.rows[static_cast<std::size_t>(i)];
      moved_.linear().row(i) << row.x, row.y, row.z;
      moved_.translation()[i] = pose.translation[static_cast<std::size_t>(i)];
    }
  }
  std::shared_ptr<const Shape> first_;
  std::shared_ptr<const Shape> second_;
  fcl::Transform3d still_ = fcl::Transform3d::Identity();
  fcl::Transform3d moved_ = fcl::Transform3d::Identity();
  Solver solver_;
};

template <typename Query>
PairEngine engine(std::string name) {
  return {std::move(name), true, true, true,
          [](const ConvexBody& a, const ConvexBody& b) { return std::make_unique<Query>(a, b); }};
}

}  // namespace

std::vector<PairEngine> fcl_engines() {
  return {engine<FclHookQuery>("fcl"),
          engine<FclShapeQuery<fcl::detail::GJKSolver_libccd<double>>>("fcl_convex"),
          engine<FclShapeQuery<fcl::detail::GJKSolver_indep<double>>>("fcl_indep")};
}

}  // namespace carpus::bench
