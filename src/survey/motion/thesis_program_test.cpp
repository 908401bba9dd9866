// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The programs of [yaacoub2008] §5.6 as printed, solved by trying every basis, give wrong answers
// where contact_interval.hpp gives right ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "hull/fast_hull.hpp"
#include "survey/detail/small_lu.hpp"
#include "survey/motion/contact_interval.hpp"

namespace carpus::survey {
namespace {

/// normal . x + e t <= offset.
struct Row {
  std::array<double, 4> coefficients;
  double offset;
};

convex::ConvexBody unit_cube() {
  std::vector<Vec3> corners(8);
  for (std::size_t i = 0; i < 8; ++i) {
    corners[i] = {(i & 1U) != 0 ? 1.0 : -1.0, (i & 2U) != 0 ? 1.0 : -1.0,
                  (i & 4U) != 0 ? 1.0 : -1.0};
  }
  return convex::ConvexBody(hull::build_fast_hull(corners).polytope);
}

/// (5.17) of a resting cube at `first` and a moving one at `second`.
std::vector<Row> rows_of(const Vec3& first, const Vec3& second, const Vec3& velocity) {
  const convex::ConvexBody cube = unit_cube();
  std::vector<Row> rows;
  for (std::uint32_t i = 0; i < cube.faces().size(); ++i) {
    const Plane p = cube.face_plane(i);
    const Vec3& n = p.normal;
    rows.push_back({{n.x, n.y, n.z, 0}, p.offset + dot(n, first)});
    rows.push_back({{n.x, n.y, n.z, -dot(n, velocity)}, p.offset + dot(n, second)});
  }
  return rows;
}

/// (5.19): every row with the sign that the thesis prints.
std::vector<Row> with_greater_or_equal(std::vector<Row> rows) {
  for (Row& row : rows) {
    for (double& c : row.coefficients) c = -c;
    row.offset = -row.offset;
  }
  return rows;
}

/// What the inequality of the dual (5.23) means for X: X >= 0.
std::vector<Row> with_positive_unknowns(std::vector<Row> rows) {
  for (std::size_t i = 0; i < 4; ++i) {
    Row row{{}, 0};
    row.coefficients[i] = -1;
    rows.push_back(row);
  }
  return rows;
}

bool satisfies(const std::vector<Row>& rows, const std::array<double, 4>& x) {
  return std::all_of(rows.begin(), rows.end(), [&](const Row& row) {
    double sum = -row.offset;
    for (std::size_t i = 0; i < 4; ++i) sum += row.coefficients[i] * x[i];
    return sum <= 1e-9;
  });
}

/// min t over all corners that four rows make; empty if none satisfies all rows.
std::optional<double> least_t(const std::vector<Row>& rows) {
  std::optional<double> best;
  std::vector<std::uint8_t> chosen(rows.size(), 0);
  std::fill(chosen.end() - 4, chosen.end(), std::uint8_t{1});
  do {
    detail::SmallLu<4>::Matrix matrix{};
    detail::SmallLu<4>::Vector offsets{};
    std::size_t k = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (chosen[i] == 0) continue;
      matrix[k] = rows[i].coefficients;
      offsets[k++] = rows[i].offset;
    }
    const detail::SmallLu<4> lu(matrix);
    if (!(lu.smallest_pivot() > 1e-9)) continue;
    const auto x = lu.solve(offsets);
    if (satisfies(rows, x) && (!best || x[3] < *best)) best = x[3];
  } while (std::next_permutation(chosen.begin(), chosen.end()));
  return best;
}

ContactInterval ours(const Vec3& first, const Vec3& second, const Vec3& velocity) {
  const convex::ConvexBody cube = unit_cube();
  return ContactIntervalQuery(cube, cube).query({Mat3::identity(), second - first}, velocity);
}

TEST(ThesisProgram, CorrectedByHandAgreesWithOurs) {
  const std::array<Vec3, 3> places{Vec3{8, 0.5, 0}, Vec3{1.5, 0.5, 0}, Vec3{-8, 0.25, 0.5}};
  for (const Vec3& second : places) {
    const auto t = least_t(rows_of({}, second, {-2, 0.125, 0}));
    EXPECT_NEAR(t.value_or(1e300), ours({}, second, {-2, 0.125, 0}).t_min_s, 1e-12);
  }
}

TEST(ThesisProgram, HasNoSolutionWithTheSignOf519) {
  const Vec3 first{5, 5, 5};                                      // so that X >= 0 is no excuse
  for (const Vec3& second : {Vec3{13, 5, 5}, Vec3{6.5, 5, 5}}) {  // apart, touching
    EXPECT_FALSE(least_t(with_greater_or_equal(rows_of(first, second, {-2, 0, 0}))).has_value());
    EXPECT_NE(ours(first, second, {-2, 0, 0}).outcome, MotionOutcome::NeverMeet);
  }
}

TEST(ThesisProgram, NeverFindsAPenetrationWithTheDualOf523) {
  const Vec3 first{5, 5, 5};
  const Vec3 second{6.5, 5, 5};
  const auto printed = least_t(with_positive_unknowns(rows_of(first, second, {-2, 0, 0})));
  EXPECT_NEAR(printed.value_or(1e300), 0, 1e-12);  // no depth
  const ContactInterval right = ours(first, second, {-2, 0, 0});
  EXPECT_NEAR(right.t_min_s, -0.25, 1e-12);
  EXPECT_NEAR(right.depth_along_motion_mm(), 0.5, 1e-12);
}

TEST(ThesisProgram, LosesBodiesOutsideThePositiveOctantWithTheDualOf523) {
  const Vec3 first{-5, 5, 5};
  const Vec3 second{3, 5, 5};
  EXPECT_FALSE(least_t(with_positive_unknowns(rows_of(first, second, {-2, 0, 0}))).has_value());
  EXPECT_NEAR(ours(first, second, {-2, 0, 0}).t_min_s, 3, 1e-12);
}

TEST(ThesisProgram, TakesBodiesThatHavePassedForPenetratingByTheSignOfTheMinimumAlone) {
  const auto t = least_t(rows_of({}, {8, 0, 0}, {2, 0, 0}));
  EXPECT_LT(t.value_or(1e300), 0);  // "the PD vector if it is negative"
  EXPECT_EQ(ours({}, {8, 0, 0}, {2, 0, 0}).outcome, MotionOutcome::HasPassed);
}

}  // namespace
}  // namespace carpus::survey
