// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Compared with an oracle on small whole numbers: closed triangles are apart iff one of finitely
// many axes separates them strictly, which 64-bit integers decide.
#include "survey/volumes/triangle_contact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "core/allocation_test_support.hpp"
#include "core/amount_test_support.hpp"
#include "core/rng.hpp"

namespace carpus::survey {
namespace {

using Integers = std::array<long long, 3>;

Integers minus(const Integers& a, const Integers& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Integers cross_of(const Integers& a, const Integers& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

std::array<Integers, 3> integers(const TrianglePoints& t) {
  std::array<Integers, 3> result{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) result[i][k] = static_cast<long long>(t[i][k]);
  }
  return result;
}

bool separates(const Integers& axis,
               const std::array<Integers, 3>& a,
               const std::array<Integers, 3>& b) {
  const auto along = [&](const Integers& p) {
    return axis[0] * p[0] + axis[1] * p[1] + axis[2] * p[2];
  };
  const std::array sa{along(a[0]), along(a[1]), along(a[2])};
  const std::array sb{along(b[0]), along(b[1]), along(b[2])};
  const auto [low_a, high_a] = std::minmax_element(sa.begin(), sa.end());
  const auto [low_b, high_b] = std::minmax_element(sb.begin(), sb.end());
  return *high_a < *low_b || *high_b < *low_a;
}

/// Two compact convex sets are apart iff the origin is outside their difference; that polytope's
/// facets (or, where it is flat, facets within its plane, its line) have as normals one of: normals
/// of the triangles, cross products of edges, products of these with edges and one another's edges,
/// edges, and differences of corners.
bool oracle_meets(const TrianglePoints& first, const TrianglePoints& second) {
  const auto a = integers(first);
  const auto b = integers(second);
  std::vector<Integers> edges;
  for (std::size_t i = 0; i < 3; ++i) {
    edges.push_back(minus(a[(i + 1) % 3], a[i]));
    edges.push_back(minus(b[(i + 1) % 3], b[i]));
  }
  std::vector<Integers> axes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const Integers& e : edges) {
    axes.push_back(e);
    for (const Integers& f : edges) {
      const Integers n = cross_of(e, f);
      axes.push_back(n);
      for (const Integers& g : edges) axes.push_back(cross_of(n, g));
    }
  }
  for (const Integers& p : a) {
    for (const Integers& q : b) axes.push_back(minus(p, q));
  }
  const std::size_t count = axes.size();
  for (std::size_t i = count - 9; i < count; ++i) {  // off a common line, in its plane
    for (const Integers& e : edges) axes.push_back(cross_of(cross_of(e, axes[i]), e));
  }
  return std::none_of(axes.begin(), axes.end(),
                      [&](const Integers& axis) { return separates(axis, a, b); });
}

TrianglePoints random_triangle(Rng& rng, std::uint64_t range, std::uint64_t kind) {
  const auto c = [&] { return static_cast<double>(rng.below(range)); };
  TrianglePoints t{Vec3{c(), c(), c()}, Vec3{c(), c(), c()}, Vec3{c(), c(), c()}};
  if (kind == 1) {
    for (Vec3& v : t) v.z = 2;  // coplanar
  } else if (kind == 2) {
    for (Vec3& v : t) v = {v.x, v.y, v.x + v.y};  // coplanar and slanted
  } else if (kind == 3) {
    t[2] = (t[0] * 2) - t[1];  // a segment
  } else if (kind == 4) {
    t[1] = t[2] = t[0];  // a point
  } else if (kind == 5) {
    for (Vec3& v : t) v = Vec3{1, 2, 3} + Vec3{1, -1, 2} * v.x;  // all on one line
  }
  return t;
}

int case_count() { return test::amount(5000, 5000, 100'000); }

TEST(TriangleContact, AgreesWithIntegerAxesOnLatticeTriangles) {
  Rng rng(1);
  std::array<int, 2> seen{};
  for (int i = 0; i < case_count(); ++i) {
    const std::uint64_t range = 3 + rng.below(6);
    const std::uint64_t kind = rng.below(6);
    const TrianglePoints a = random_triangle(rng, range, kind);
    const TrianglePoints b = random_triangle(rng, range, rng.below(3) == 0 ? rng.below(6) : kind);
    const bool expected = oracle_meets(a, b);
    ASSERT_EQ(triangles_meet(a, b), expected) << "case " << i;
    ASSERT_EQ(triangles_meet(b, a), expected) << "case " << i;
    ++seen[expected ? 1 : 0];
  }
  EXPECT_GT(seen[0], 500);
  EXPECT_GT(seen[1], 500);
}

TEST(TriangleContact, DoesNotDependOnTheOrderOfCorners) {
  Rng rng(2);
  for (int i = 0; i < 2000; ++i) {
    TrianglePoints a = random_triangle(rng, 4, rng.below(6));
    TrianglePoints b = random_triangle(rng, 4, rng.below(6));
    const bool meet = triangles_meet(a, b);
    std::rotate(a.begin(), a.begin() + 1, a.end());
    std::swap(b[0], b[2]);
    ASSERT_EQ(triangles_meet(a, b), meet);
  }
}

TEST(TriangleContact, SeesTheLastBitOfAGap) {
  const TrianglePoints a{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}};
  const double ulp = 0x1.0p-52;
  EXPECT_TRUE(triangles_meet(a, {Vec3{0.5, 0.5, 0}, Vec3{2, 2, 1}, Vec3{2, 2, -1}}));
  EXPECT_FALSE(triangles_meet(a, {Vec3{0.5 + ulp, 0.5, 0}, Vec3{2, 2, 1}, Vec3{2, 2, -1}}));
  EXPECT_FALSE(triangles_meet(a, {Vec3{0.2, 0.2, 1e-80}, Vec3{2, 2, 1}, Vec3{2, 3, 1}}));
}

TEST(TriangleContact, AllocatesNothingEvenWhereOnlyExactSignsTell) {
  Rng rng(4);
  int met = 0;
  carpus::test::start_counting_allocations();
  for (int i = 0; i < 500; ++i) {
    TrianglePoints a = random_triangle(rng, 4, rng.below(6));
    TrianglePoints b = random_triangle(rng, 4, rng.below(6));
    for (Vec3& v : a) v = without_tiny_coordinates(v * 0.1 + Vec3{1e-300, 1e-70, 0});
    for (Vec3& v : b) v = without_tiny_coordinates(v * 0.1 + Vec3{1e-300, 1e-70, 0});
    met += triangles_meet(a, b) ? 1 : 0;
  }
  EXPECT_EQ(carpus::test::stop_counting_allocations(), 0);
  EXPECT_GT(met, 50);
}

}  // namespace
}  // namespace carpus::survey
