// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "survey/volumes/sweep_and_prune.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "core/allocation_test_support.hpp"
#include "core/error.hpp"
#include "core/rng.hpp"

namespace carpus::survey {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
using PairSet = std::set<std::pair<std::uint32_t, std::uint32_t>>;

PairSet pairs_of(const SweepAndPrune& sweep) {
  PairSet pairs;
  sweep.for_each_overlapping([&](IndexPair p) { pairs.insert({p.first, p.second}); });
  return pairs;
}

bool is_empty(const Aabb& b) {
  return b.low.x > b.high.x || b.low.y > b.high.y || b.low.z > b.high.z;
}

PairSet brute_force(const std::vector<Aabb>& boxes) {
  PairSet pairs;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    for (std::uint32_t j = i + 1; j < boxes.size(); ++j) {
      if (is_empty(boxes[i]) || is_empty(boxes[j])) continue;
      if (boxes[i].overlaps(boxes[j])) pairs.insert({i, j});
    }
  }
  return pairs;
}

/// Whole coordinates now and then, so that boxes touch, and a few empty ones.
Aabb random_box(Rng& rng, double range) {
  const bool on_lattice = rng.below(3) == 0;
  const auto c = [&](double low, double high) {
    return on_lattice ? static_cast<double>(static_cast<long long>(rng.uniform(low, high)))
                      : rng.uniform(low, high);
  };
  const Vec3 low{c(-range, range), c(-range, range), c(-range, range)};
  Aabb box{low, low + Vec3{c(0, 6), c(0, 6), c(0, 6)}};
  if (rng.below(40) == 0) box.high.y = box.low.y - 1;
  if (rng.below(40) == 0) box = Aabb{};
  return box;
}

/// Boxes on the move, and what they have shown so far.
struct Crowd {
  SweepAndPrune sweep;
  std::vector<Aabb> boxes;
  Rng rng;
  PairSet known;  ///< by what began and ended alone
  std::size_t begun = 0;
  std::size_t ended = 0;

  explicit Crowd(std::size_t n) : sweep(n), boxes(n), rng(n) {}

  void move(bool all_jump) {
    for (Aabb& box : boxes) {
      if (all_jump || is_empty(box) || rng.below(60) == 0) {
        box = random_box(rng, boxes.size() > 20 ? 14 : 7);
        continue;
      }
      const Vec3 step{rng.uniform(-0.3, 0.3), rng.uniform(-0.3, 0.3), rng.uniform(-0.3, 0.3)};
      box = {box.low + step, box.high + step};
    }
    if (rng.below(70) == 0) {
      sweep.forget();
      known.clear();
    }
    sweep.update(boxes);
    sweep.for_each_begun([&](IndexPair p) { begun += known.insert({p.first, p.second}).second; });
    sweep.for_each_ended([&](IndexPair p) { ended += known.erase({p.first, p.second}); });
  }

  [[nodiscard]] bool agrees() const {
    const PairSet expected = brute_force(boxes);
    return pairs_of(sweep) == expected && known == expected &&
           sweep.overlapping_count() == expected.size() &&
           sweep.overlap(0, 1) == expected.contains({0, 1});
  }
};

TEST(SweepAndPrune, FindsThePairsOfBruteForceWhileBoxesMoveAndJump) {
  std::size_t begun = 0;
  std::size_t ended = 0;
  for (const std::size_t n : {2U, 3U, 15U, 16U, 60U}) {
    Crowd crowd(n);
    for (int step = 0; step < 600; ++step) {
      crowd.move(step % 50 == 0);
      ASSERT_TRUE(crowd.agrees()) << n << " boxes, step " << step;
    }
    begun += crowd.begun;
    ended += crowd.ended;
  }
  EXPECT_GT(begun, 1000U);
  EXPECT_GT(ended, 1000U);
}

TEST(SweepAndPrune, CountsTouchingBoxesAsOverlapping) {
  const std::vector<Aabb> boxes{{{0, 0, 0}, {1, 1, 1}},
                                {{1, 1, 1}, {2, 2, 2}},
                                {{-1, -1, std::nextafter(1, 2)}, {0, 0, 4}},
                                {{0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}}};
  SweepAndPrune sweep(4);
  sweep.update(boxes);
  EXPECT_EQ(pairs_of(sweep), (PairSet{{0, 1}, {0, 3}}));
}

TEST(SweepAndPrune, FollowsBoxesThatPassThroughEachOtherInOneStep) {
  SweepAndPrune sweep(2);
  std::vector<Aabb> boxes{{{0, 0, 0}, {1, 1, 1}}, {{2, 0, 0}, {3, 1, 1}}};
  for (int i = 0; i < 4; ++i) {
    sweep.update(boxes);
    EXPECT_EQ(sweep.overlapping_count(), 0U);
    std::swap(boxes[0], boxes[1]);
  }
}

TEST(SweepAndPrune, TakesABoxWithNanAsAllOfSpaceAndSaysSo) {
  std::vector<Aabb> boxes{
      {{0, 0, 0}, {1, 1, 1}}, {{50, 0, 0}, {51, 1, 1}}, {{5, kNan, 5}, {6, 6, 6}}, Aabb{}};
  SweepAndPrune sweep(4);
  EXPECT_EQ(sweep.update(boxes), SweepStatus::NotANumber);
  EXPECT_EQ(pairs_of(sweep), (PairSet{{0, 2}, {1, 2}}));
  boxes[2] = {{0, 0, 0}, {1, 1, 1}};
  EXPECT_EQ(sweep.update(boxes), SweepStatus::Ok);
  EXPECT_EQ(pairs_of(sweep), (PairSet{{0, 2}}));
}

TEST(SweepAndPrune, TakesInfiniteBoxes) {
  const std::vector<Aabb> boxes{
      {{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}},
      {{1e300, 0, 0}, {kInfinity, 1, 1}},
      {{-kInfinity, 0, 0}, {0, 1, 1}}};
  SweepAndPrune sweep(3);
  EXPECT_EQ(sweep.update(boxes), SweepStatus::Ok);
  EXPECT_EQ(pairs_of(sweep), (PairSet{{0, 1}, {0, 2}}));
}

TEST(SweepAndPrune, NeedsFewSwapsForSmallMotionAndStartsOverAfterAJump) {
  constexpr std::size_t kCount = 200;
  Rng rng(7);
  std::vector<Aabb> boxes(kCount);
  for (Aabb& box : boxes) {
    const Vec3 low{rng.uniform(0, 100), rng.uniform(0, 100), rng.uniform(0, 100)};
    box = {low, low + Vec3{5, 5, 5}};
  }
  SweepAndPrune sweep(kCount);
  sweep.update(boxes);
  EXPECT_EQ(sweep.counts().full_sorts, 3U);
  for (Aabb& box : boxes) {
    const Vec3 move{rng.uniform(-0.01, 0.01), 0, 0};
    box = {box.low + move, box.high + move};
  }
  sweep.update(boxes);
  EXPECT_LT(sweep.counts().swaps, kCount);
  EXPECT_EQ(sweep.counts().full_sorts, 3U);
  for (std::size_t i = 0; i < kCount / 2; ++i) std::swap(boxes[i], boxes[kCount - 1 - i]);
  sweep.update(boxes);
  EXPECT_EQ(sweep.counts().full_sorts, 6U);
  EXPECT_EQ(pairs_of(sweep), brute_force(boxes));
}

TEST(SweepAndPrune, AllocatesNothingInAnUpdate) {
  Rng rng(3);
  std::vector<Aabb> boxes(30);
  SweepAndPrune sweep(30);
  std::size_t seen = 0;
  carpus::test::start_counting_allocations();
  for (int step = 0; step < 50; ++step) {
    for (Aabb& box : boxes) box = random_box(rng, 8);
    if (step % 10 == 0) sweep.forget();
    sweep.update(boxes);
    sweep.for_each_overlapping([&](IndexPair) { ++seen; });
  }
  EXPECT_EQ(carpus::test::stop_counting_allocations(), 0);
  EXPECT_GT(seen, 0U);
}

TEST(SweepAndPrune, TakesNoBoxesAndOne) {
  SweepAndPrune none(0);
  EXPECT_EQ(none.update({}), SweepStatus::Ok);
  EXPECT_EQ(none.overlapping_count(), 0U);
  SweepAndPrune one(1);
  const std::vector<Aabb> box{{{0, 0, 0}, {1, 1, 1}}};
  EXPECT_EQ(one.update(box), SweepStatus::Ok);
  EXPECT_EQ(one.overlapping_count(), 0U);
  EXPECT_THROW(SweepAndPrune{SweepAndPrune::kMaxBoxes + 1}, InvalidInput);
}

}  // namespace
}  // namespace carpus::survey
