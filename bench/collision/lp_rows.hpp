// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The thesis's program for general solvers, (5.6)-(5.7) with equality because X is free: three
// rows, one column a facet of either hull, min b'pi with A'pi = (1, 1, 1), pi >= 0. Unbounded: the
// bodies have no common point. The last tick's basis is kept. Three rows are the form in which a
// general solver is fastest; max (5.2)-(5.3) has a row a facet.
#pragma once

#include <cstddef>
#include <vector>

#include "convex/convex_body.hpp"
#include "convex/pair_query.hpp"

namespace carpus::bench {

class LpRows {
 public:
  LpRows(const convex::ConvexBody& first, const convex::ConvexBody& second)
      : first_(&first), second_(&second) {
    for (std::size_t f = 0; f < first.faces().size(); ++f) {
      planes.push_back(first.face_plane(static_cast<std::uint32_t>(f)));
    }
    second_start = planes.size();
    planes.resize(planes.size() + second.faces().size());
  }
  void place(const convex::PairPose& pose) noexcept {
    for (std::size_t f = second_start; f < planes.size(); ++f) {
      const Plane& p = second_->face_plane(static_cast<std::uint32_t>(f - second_start));
      const Vec3 n = pose.rotation * p.normal;
      planes[f] = {n, p.offset + dot(n, pose.translation)};
    }
  }

  std::vector<Plane> planes;     ///< all in the first's frame
  std::size_t second_start = 0;  ///< before it the first's, which do not move

 private:
  const convex::ConvexBody* first_;
  const convex::ConvexBody* second_;
};

}  // namespace carpus::bench
