// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The collision question as the thesis asks it [yaacoub2008] chapter 5: the rows of two hulls, one
// linear program, at every step anew. Here a probe's tip and a bone with a flat face.
#pragma once

#include <memory>

#include "convex/convex_body.hpp"
#include "convex/pair_query.hpp"
#include "haptics/local_planes.hpp"

namespace carpus::device_bench {

class CollisionQuestion {
 public:
  /// @param wall  face of the bone, about `middle` [mm].
  CollisionQuestion(const haptics::SurfacePlane& wall, const Vec3& middle);
  [[nodiscard]] bool meets(const Vec3& tip);

 private:
  convex::ConvexBody bone_;
  convex::ConvexBody tool_;
  std::unique_ptr<convex::PairQuery> query_;
};

}  // namespace carpus::device_bench
