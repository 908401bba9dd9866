// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// libccd's GJK (with its EPA for depth) and MPR, in double precision, with its own tolerances.
#include <ccd/ccd.h>

#include "bench/collision/climbing_pair.hpp"
#include "bench/collision/peers.hpp"

namespace carpus::bench {
namespace {

using convex::Penetration;
using convex::Verdict;

void support(const void* side, const ccd_vec3_t* d, ccd_vec3_t* out) {
  const Vec3 v = static_cast<const ClimbingSide*>(side)->support({d->v[0], d->v[1], d->v[2]});
  ccdVec3Set(out, v.x, v.y, v.z);
}
void centre(const void* side, ccd_vec3_t* out) {
  const Vec3 v = static_cast<const ClimbingSide*>(side)->centre();
  ccdVec3Set(out, v.x, v.y, v.z);
}
void first_direction(const void* first, const void* /*second*/, ccd_vec3_t* out) {
  const ClimbingPair& pair = *static_cast<const ClimbingSide*>(first)->pair;
  const Vec3 d = pair.has_axis() ? pair.axis() : pair.second_centre() - pair.first_centre();
  ccdVec3Set(out, d.x, d.y, d.z);
}

class LibccdQuery final : public convex::PairQuery {
 public:
  LibccdQuery(const convex::ConvexBody& first, const convex::ConvexBody& second, bool is_mpr)
      : pair_(first, second), is_mpr_(is_mpr) {
    CCD_INIT(&ccd_);
    ccd_.first_dir = first_direction;
    ccd_.support1 = ccd_.support2 = support;
    ccd_.center1 = ccd_.center2 = centre;
    ccd_.max_iterations = 200;
  }
  Verdict meets(const convex::PairPose& pose) noexcept override {
    pair_.place(pose);
    if (pair_.last_axis_separates()) return Verdict::Apart;
    const int meet = is_mpr_ ? ccdMPRIntersect(&first_, &second_, &ccd_)
                             : ccdGJKIntersect(&first_, &second_, &ccd_);
    return pair_.answered(meet != 0);
  }
  std::optional<Penetration> penetration(const convex::PairPose& pose) noexcept override {
    pair_.place(pose);
    ccd_real_t depth = 0;
    ccd_vec3_t direction;
    ccd_vec3_t position;
    const int failed =
        is_mpr_ ? ccdMPRPenetration(&first_, &second_, &ccd_, &depth, &direction, &position)
                : ccdGJKPenetration(&first_, &second_, &ccd_, &depth, &direction, &position);
    if (failed != 0) return std::nullopt;
    return Penetration{depth, {direction.v[0], direction.v[1], direction.v[2]}, {}, {}};
  }
  void forget() noexcept override { pair_.forget(); }

 private:
  ClimbingPair pair_;
  ClimbingSide first_{&pair_, false};
  ClimbingSide second_{&pair_, true};
  bool is_mpr_;
  ccd_t ccd_{};
};

PairEngine engine(std::string name, bool is_mpr) {
  return {std::move(name), true, false, true,
          [is_mpr](const convex::ConvexBody& a, const convex::ConvexBody& b) {
            return std::make_unique<LibccdQuery>(a, b, is_mpr);
          }};
}

}  // namespace

std::vector<PairEngine> libccd_engines() {
  return {engine("libccd_gjk", false), engine("libccd_mpr", true)};
}

}  // namespace carpus::bench
