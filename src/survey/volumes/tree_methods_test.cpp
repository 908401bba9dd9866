// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// tests/oracles compares these methods with exact arithmetic; here, what poses there do not have.
#include "survey/volumes/tree_methods.hpp"

#include <gtest/gtest.h>

#include "convex/bodies_test_support.hpp"
#include "convex/pair_query.hpp"
#include "survey/methods.hpp"

namespace carpus::survey {
namespace {

TEST(TreeMethods, FindABodyWithinTheMirrorImageOfAnother) {
  const convex::ConvexBody small = test::octahedron(1);
  const convex::ConvexBody large = test::box({5, 6, 7});
  convex::PairPose mirrored;
  mirrored.rotation.rows[0].x = -1;
  for (const char* name :
       {"aabb_tree", "obb_tree", "quick_cd_6", "quick_cd_14", "quick_cd_18", "quick_cd_26"}) {
    const Method& method = *find_method(name);
    EXPECT_EQ(method.make(small, large)->meets(mirrored), convex::Verdict::Meet) << name;
    EXPECT_EQ(method.make(large, small)->meets(mirrored), convex::Verdict::Meet) << name;
  }
}

}  // namespace
}  // namespace carpus::survey
