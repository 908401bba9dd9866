// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Methods of this folder that promise an exact verdict, against all separating axes in exact
// arithmetic: touching to the last bit, a bit apart, a bit inside, far from the origin, thin,
// nested. CARPUS_LONG=1 runs twenty times as many, CARPUS_QUICK=1 a fifth.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "convex/bodies_test_support.hpp"
#include "convex/exact_meeting.hpp"
#include "convex/growth/test_oracle.hpp"
#include "convex/pair_query.hpp"
#include "core/amount_test_support.hpp"
#include "core/rng.hpp"
#include "survey/methods.hpp"

namespace carpus::survey {
namespace {

/// By name in the list of methods; each promises the exact verdict.
constexpr std::array kExactMethods{"lp_growth", "lp_scan", "lp_partial", "lp_walk", "seidel"};

int case_count(int usual) { return test::amount(usual / 5 + 1, usual, usual * 20); }

convex::ConvexBody small_body(Rng& rng) {
  switch (rng.below(7)) {
    case 0:
      return test::box({4, 4, 4});
    case 1:
      return test::octahedron(5);
    case 2:
      return test::box({0.01, 0.5, 20});  // a strip
    case 3:
      return test::prism(6, 2, 3);
    case 4: {  // lattice corners: parallel faces, coplanar corners
      while (true) {
        std::vector<Vec3> points;
        for (int i = 0; i < 9; ++i) {
          const auto c = [&] { return static_cast<double>(rng.below(5)); };
          points.push_back({c(), c(), c()});
        }
        const auto built = hull::build_convex_hull(points);
        if (built.status == hull::HullStatus::Ok) return convex::ConvexBody(built.polytope);
      }
    }
    default:
      return test::pebble(rng, 4 + static_cast<int>(rng.below(7)));
  }
}

Mat3 axis_rotation(Rng& rng) {
  Mat3 m{};
  const std::uint64_t shift = rng.below(3);
  for (std::size_t i = 0; i < 3; ++i) {
    m.rows[i] = {};
    m.rows[i][(i + shift) % 3] = 1;
  }
  if (rng.below(2) == 0) {
    m.rows[0] = -m.rows[0];
    m.rows[1] = -m.rows[1];
  }
  return m;
}

/// Lets features of both bodies coincide as nearly as doubles can: a vertex, an edge's middle or a
/// face's corner of the second is put on one of the first; then moved by `gap` along an axis.
convex::PairPose touching_pose(const convex::ConvexBody& first,
                               const convex::ConvexBody& second,
                               Rng& rng) {
  convex::PairPose pose;
  if (rng.below(3) != 0)
    pose.rotation = rng.below(2) == 0 ? axis_rotation(rng) : test::random_rotation(rng);
  const auto feature = [&](const convex::ConvexBody& body) {
    const hull::PolygonalFace& face = body.faces()[rng.below(body.faces().size())];
    const Vec3& a = body.vertices()[face.corners[0]];
    const Vec3& b = body.vertices()[face.corners[1]];
    const Vec3& c = body.vertices()[face.corners[2]];
    const std::uint64_t kind = rng.below(3);
    if (kind == 0) return a;
    return kind == 1 ? a + (b - a) * 0.5 : a + (b - a) * 0.25 + (c - a) * 0.25;
  };
  pose.translation = feature(first) - pose.rotation * feature(second);
  const std::array gaps{0.0, 0.0, 1e-15, -1e-15, 1e-12, -1e-12, 1e-3, -1e-3, 0.5, 30.0};
  pose.translation[rng.below(3)] += gaps[rng.below(gaps.size())];
  return pose;
}

std::string name_of(convex::Verdict v) {
  return v == convex::Verdict::Meet ? "meet" : (v == convex::Verdict::Apart ? "apart" : "unknown");
}

TEST(ExactVerdict, IsThatOfAllSeparatingAxesInExactArithmetic) {
  int meets = 0;
  const int cases = case_count(150);
  for (int seed = 0; seed < cases; ++seed) {
    Rng rng(static_cast<std::uint64_t>(seed) + 1000);
    const convex::ConvexBody first = small_body(rng);
    const convex::ConvexBody second = small_body(rng);
    std::vector<std::unique_ptr<convex::PairQuery>> queries;
    for (const char* name : kExactMethods) {
      ASSERT_NE(find_method(name), nullptr) << name;
      queries.push_back(find_method(name)->make(first, second));
    }
    for (int step = 0; step < 6; ++step) {  // the state of one answer starts the next
      const convex::PairPose pose = touching_pose(first, second, rng);
      const convex::Verdict expected = test::verdict_by_all_axes(first, second, pose);
      meets += expected == convex::Verdict::Meet ? 1 : 0;
      const convex::ExactAnswer exact = convex::exactly_meet(
          {&first, Mat3::identity(), {}}, {&second, pose.rotation, pose.translation}, {});
      EXPECT_EQ(name_of(exact.verdict), name_of(expected)) << seed << " " << step;
      for (std::size_t m = 0; m < queries.size(); ++m) {
        if (step % 3 == 2) queries[m]->forget();
        EXPECT_EQ(name_of(queries[m]->meets(pose)), name_of(expected))
            << kExactMethods[m] << " " << seed << " " << step;
      }
    }
  }
  EXPECT_GT(meets, cases);
  EXPECT_LT(meets, 5 * cases);
}

TEST(ExactVerdict, SeesOneUnitInTheLastPlaceOfAGap) {
  for (const double at : {1.0, 1e6, 1e12}) {
    const convex::ConvexBody first = test::box({at, 3, 3});
    const convex::ConvexBody second = test::box({0.5, 1, 1});
    const double touching = at + 0.5;
    for (const char* name : kExactMethods) {
      const auto query = find_method(name)->make(first, second);
      for (const double t : {touching, std::nextafter(touching, 0.0),
                             std::nextafter(touching, HUGE_VAL), touching}) {
        const convex::Verdict expected =
            t > touching ? convex::Verdict::Apart : convex::Verdict::Meet;
        EXPECT_EQ(query->meets({Mat3::identity(), {t, 0.5, 0.5}}), expected) << name << " " << t;
        EXPECT_EQ(query->meets({Mat3::identity(), {-t, 4, 4}}), expected) << name << " " << t;
      }
    }
  }
}

TEST(ExactVerdict, TakesBodiesFarFromTheirFramesOrigins) {
  Rng rng(5);
  const int cases = case_count(40);
  for (int i = 0; i < cases; ++i) {
    const convex::ConvexBody first = test::pebble(rng, 8, {1e6, -2e6, 3e5});
    const convex::ConvexBody second = test::pebble(rng, 8, {-1e6, 4e6, 1e6});
    for (const char* name : kExactMethods) {
      const auto query = find_method(name)->make(first, second);
      for (int step = 0; step < 3; ++step) {
        convex::PairPose pose = touching_pose(first, second, rng);
        EXPECT_EQ(query->meets(pose), test::verdict_by_all_axes(first, second, pose)) << name;
      }
    }
  }
}

TEST(ExactVerdict, AppliesMatricesThatAreNoRotationsAsTheyAre) {
  Rng rng(6);
  const int cases = case_count(40);
  for (int i = 0; i < cases; ++i) {
    const convex::ConvexBody first = small_body(rng);
    const convex::ConvexBody second = small_body(rng);
    for (const char* name : kExactMethods) {
      const auto query = find_method(name)->make(first, second);
      for (int step = 0; step < 4; ++step) {
        convex::PairPose pose = touching_pose(first, second, rng);
        const std::array scales{1 + 1e-15, 1 + 1e-9, 1.001, 0.5, 3.0, -1.0};
        const double scale = scales[rng.below(scales.size())];
        for (Vec3& row : pose.rotation.rows) row *= scale;
        pose.rotation.rows[0] += pose.rotation.rows[1] * rng.uniform(0, 1e-3);
        EXPECT_EQ(query->meets(pose), test::verdict_by_all_axes(first, second, pose)) << name;
      }
    }
  }
}

TEST(ExactVerdict, TakesAMatrixThatShrinksABodyForNoMotion) {
  const convex::ConvexBody small = test::box({1, 1, 1});
  const convex::ConvexBody large = test::box({10, 10, 10});
  for (const char* name : kExactMethods) {
    const auto query = find_method(name)->make(small, large);
    for (int again = 0; again < 3; ++again) {
      EXPECT_EQ(query->meets({Mat3::identity(), {3, 0, 0}}), convex::Verdict::Meet) << name;
      convex::PairPose shrunk{Mat3::identity(), {3, 0, 0}};
      for (Vec3& row : shrunk.rotation.rows) row *= 0.1;
      EXPECT_EQ(query->meets(shrunk), convex::Verdict::Apart) << name;
    }
  }
}

TEST(ExactVerdict, TakesThinSmallAndLargeBodies) {
  const convex::ConvexBody sheet = test::box({10, 10, 1e-14});
  const convex::ConvexBody cube = test::box({1, 1, 1});
  const convex::ConvexBody tiny = test::box({1e-60, 1e-60, 1e-60});
  const convex::ConvexBody huge = test::box({1e90, 1e90, 1e90});
  for (const char* name : kExactMethods) {
    const Method& method = *find_method(name);
    const auto thin = method.make(sheet, cube);
    EXPECT_EQ(thin->meets({Mat3::identity(), {0, 0, 1 + 1e-14}}), convex::Verdict::Meet) << name;
    EXPECT_EQ(thin->meets({Mat3::identity(), {0, 0, 1 + 2e-14}}), convex::Verdict::Apart) << name;
    EXPECT_EQ(method.make(cube, tiny)->meets({Mat3::identity(), {1, 1, 1}}), convex::Verdict::Meet);
    EXPECT_EQ(method.make(tiny, tiny)->meets({Mat3::identity(), {3e-60, 0, 0}}),
              convex::Verdict::Apart);
    EXPECT_EQ(method.make(tiny, tiny)->meets({Mat3::identity(), {2e-60, 0, 0}}),
              convex::Verdict::Meet);
    EXPECT_EQ(method.make(huge, cube)->meets({Mat3::identity(), {1e90, 0, 0}}),
              convex::Verdict::Meet);
    EXPECT_EQ(method.make(huge, cube)->meets({Mat3::identity(), {1.1e90, 0, 0}}),
              convex::Verdict::Apart);
  }
}

TEST(ExactVerdict, IsUnknownOnlyForPosesThatAreNone) {
  const convex::ConvexBody cube = test::box({1, 1, 1});
  for (const char* name : kExactMethods) {
    const auto query = find_method(name)->make(cube, cube);
    convex::PairPose pose;
    pose.translation.y = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(query->meets(pose), convex::Verdict::Unknown) << name;
    pose = {};
    pose.rotation.rows[1].z = std::numeric_limits<double>::infinity();
    EXPECT_EQ(query->meets(pose), convex::Verdict::Unknown) << name;
    pose = {Mat3::identity(), {1e300, 0, 0}};
    EXPECT_EQ(query->meets(pose), convex::Verdict::Unknown) << name;
    EXPECT_EQ(query->meets({Mat3::identity(), {1e99, 0, 0}}), convex::Verdict::Apart) << name;
    EXPECT_EQ(query->meets({}), convex::Verdict::Meet) << name;  // and recovers
    pose = {};
    for (Vec3& row : pose.rotation.rows) row = {};  // everything at one point
    pose.translation = {1, 1, 1};
    EXPECT_EQ(query->meets(pose), convex::Verdict::Meet) << name;
    pose.translation.x = std::nextafter(1.0, 2.0);
    EXPECT_EQ(query->meets(pose), convex::Verdict::Apart) << name;
  }
}

}  // namespace
}  // namespace carpus::survey
