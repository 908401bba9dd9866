// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// tests/oracles compares these methods with exact arithmetic; here, what poses there do not have.
#include "collision/volumes/tree_methods.hpp"

#include <gtest/gtest.h>

#include "collision/lp/test_bodies.hpp"
#include "collision/pair_query.hpp"

namespace carpus::collision {
namespace {

TEST(TreeMethods, FindABodyWithinTheMirrorImageOfAnother) {
  const ConvexBody small = lp_test::octahedron(1);
  const ConvexBody large = lp_test::box({5, 6, 7});
  PairPose mirrored;
  mirrored.rotation.rows[0].x = -1;
  for (const char* name :
       {"aabb_tree", "obb_tree", "quick_cd_6", "quick_cd_14", "quick_cd_18", "quick_cd_26"}) {
    const Method& method = *find_method(name);
    EXPECT_EQ(method.make(small, large)->meets(mirrored), Verdict::Meet) << name;
    EXPECT_EQ(method.make(large, small)->meets(mirrored), Verdict::Meet) << name;
  }
}

}  // namespace
}  // namespace carpus::collision
