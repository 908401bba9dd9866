// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "fields/cut_tissue.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <limits>
#include <vector>

#include "core/allocation_test_support.hpp"
#include "core/amount_test_support.hpp"
#include "core/error.hpp"
#include "fields/distance_field.hpp"
#include "fields/surface_test_support.hpp"

namespace carpus::fields {
namespace {

using carpus::test::amount;

ContactField field_of(const TriangleMesh& mesh) {
  return {build_distance_field(mesh, {.spacing_mm = 0.4, .band_mm = 4}), mesh};
}
/// A block of 16 mm and a bowl.
const std::vector<ContactField>& bones() {
  static const std::vector<ContactField> kBones{field_of(test::box({8, 8, 8})),
                                                field_of(test::bowl(24))};
  return kBones;
}
std::uint64_t hash_of(const CutTissue& tissue) {
  StateHash hash;
  tissue.add_to(hash);
  return hash.value();
}
std::vector<std::byte> bytes_of(const CutTissue& tissue) {
  std::vector<std::byte> bytes;
  tissue.write_to(bytes);
  return bytes;
}
SweptTool some_tool(Rng& rng) {
  const Vec3 a = test::random_shift(rng, 9);
  const Vec3 b = test::random_shift(rng, 9);
  return SweptTool::bar(a, rng.uniform(0.3, 1.5), b, rng.uniform(0.3, 1.5));
}

/// Takes all changes into a grid.
void bring_up(CutTissue& tissue, std::vector<RemovedShareGrid>& grids) {
  std::array<ShareChange, 50> changes;
  while (tissue.has_changes()) {
    const std::size_t count = tissue.take_changes(changes);
    for (std::size_t i = 0; i < count; ++i) {
      ASSERT_TRUE(grids[changes[i].body].apply(changes[i]));
    }
  }
}

TEST(CutTissue, RemovesTheVolumeOfTheTool) {
  Rng rng(1);
  for (int i = 0; i < amount(4, 12, 200); ++i) {
    CutTissue tissue(bones());
    const Vec3 a = test::random_shift(rng, 3);
    const Vec3 b = a + test::random_direction(rng) * rng.uniform(2.5, 4.5);
    const double r = i % 2 == 0 ? 0.57 : 1.65;
    ASSERT_EQ(tissue.remove(0, SweptTool::bar(a, r, b, r)).outcome, RemovalOutcome::Removed);
    std::vector<RemovedShareGrid> grids{RemovedShareGrid(tissue.field(0)),
                                        RemovedShareGrid(tissue.field(1))};
    bring_up(tissue, grids);
    ASSERT_FALSE(tissue.is_removing());
    const double truth = kPi * r * r * distance(a, b) + 4.0 / 3 * kPi * r * r * r;
    EXPECT_NEAR(grids[0].removed_volume_mm3() / truth, 1, r < 1 ? 0.03 : 0.01);
    EXPECT_EQ(grids[1].removed_volume_mm3(), 0);
    const RemovedShareGrid::Box box = grids[0].take_changed_box();
    for (std::size_t x = 0; x < 3; ++x) {
      const GridGeometry& g = grids[0].geometry();
      EXPECT_LE(g.origin[x] + (box.low[x] - 0.5) * g.spacing[x], std::min(a[x], b[x]) - r);
      EXPECT_GE(g.origin[x] + (box.high[x] - 0.5) * g.spacing[x], std::max(a[x], b[x]) + r);
    }
    EXPECT_EQ(grids[0].take_changed_box().high[0], 0);
  }
}

TEST(CutTissue, IsTheSameInAdvancesAsInOneGo) {
  // Nodes agree to rounding: by what each advance rounds its own origin.
  const InstrumentShape wire(ConeTipShape{0.57, 1.5, 30});
  const Mat3 turn = test::turned_to(normalized_or({1, 2, 3}, {}));
  const Vec3 shaft = turn.column(2);
  CutTissue slow(bones());
  (void)slow.remove(0, SweptTool::whole(wire, {turn, shaft * 9.0}));
  for (int i = 1; i <= 200; ++i) {
    (void)slow.remove(0, SweptTool::advance(wire, {turn, shaft * (9.0 - 0.05 * i)}, 0.05));
  }
  CutTissue fast(bones());
  (void)fast.remove(0, SweptTool::whole(wire, {turn, shaft * -1.0}, 10));
  Rng rng(2);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 p{rng.uniform(-8, 8), rng.uniform(-8, 8), rng.uniform(-8, 8)};
    ASSERT_NEAR(slow.field(0).sample(p), fast.field(0).sample(p), 2 * kCutRoundingMm);
  }
  // The same tool again, once it went through.
  const Removal again = slow.remove(0, SweptTool::advance(wire, {turn, shaft * 2.0}, 0.05));
  EXPECT_EQ(again.outcome, RemovalOutcome::Nothing);
}

TEST(CutTissue, TakesBackToTheBit) {
  Rng rng(3);
  for (int round = 0; round < amount(3, 10, 200); ++round) {
    CutTissue tissue(bones());
    std::vector<RemovedShareGrid> grids{RemovedShareGrid(tissue.field(0)),
                                        RemovedShareGrid(tissue.field(1))};
    std::vector<std::vector<std::byte>> states;
    std::vector<std::uint64_t> hashes;
    std::vector<double> volumes;
    for (int step = 0; step < 40; ++step) {
      const auto what = rng.below(4);
      if (what == 0 && states.size() < 6) {
        tissue.checkpoint();
        states.push_back(bytes_of(tissue));
        hashes.push_back(hash_of(tissue));
        bring_up(tissue, grids);
        volumes.push_back(grids[0].removed_volume_mm3());
      } else if (what == 1) {
        ASSERT_EQ(tissue.undo(), !states.empty());
        if (states.empty()) continue;
        ASSERT_EQ(bytes_of(tissue), states.back());
        ASSERT_EQ(hash_of(tissue), hashes.back());
        bring_up(tissue, grids);
        ASSERT_EQ(grids[0].removed_volume_mm3(), volumes.back());
        states.pop_back();
        hashes.pop_back();
        volumes.pop_back();
      } else {
        (void)tissue.remove(rng.below(2), some_tool(rng));
      }
    }
    ASSERT_EQ(tissue.checkpoint_count(), states.size());
    ASSERT_EQ(tissue.counts().checkpoints_forgotten, 0);
  }
}

TEST(CutTissue, ForgetsTheOldestCheckpointWhenTheJournalIsFull) {
  Rng rng(4);
  CutTissue tissue(bones(), {.brick_capacity = 32768, .journal_capacity = 3000});
  std::vector<std::vector<std::byte>> states;
  for (int i = 0; i < 8; ++i) {
    tissue.checkpoint();
    states.push_back(bytes_of(tissue));
    for (int j = 0; j < 2; ++j) (void)tissue.remove(0, some_tool(rng));
  }
  EXPECT_GT(tissue.counts().checkpoints_forgotten, 0);
  EXPECT_EQ(tissue.checkpoint_count() + tissue.counts().checkpoints_forgotten, 8);
  ASSERT_GT(tissue.checkpoint_count(), 0);
  while (tissue.checkpoint_count() > 0) {
    ASSERT_TRUE(tissue.undo());
    ASSERT_EQ(bytes_of(tissue), states.back());
    states.pop_back();
  }
  EXPECT_FALSE(tissue.undo());
  EXPECT_FALSE(states.empty());

  CutTissue tiny(bones(), {.brick_capacity = 32768, .journal_capacity = 2});
  tiny.checkpoint();
  EXPECT_EQ(tiny.remove(0, some_tool(rng)).outcome, RemovalOutcome::Removed);
  EXPECT_EQ(tiny.checkpoint_count(), 0);
  for (int i = 0; i < 20; ++i) tiny.checkpoint();
  EXPECT_EQ(tiny.checkpoint_count(), kMaxCheckpoints);
  EXPECT_EQ(tiny.counts().checkpoints_forgotten, 5);
}

TEST(CutTissue, ChangesNothingWhenTheReserveIsUsedUp) {
  CutTissue tissue(bones(), {.brick_capacity = 300, .journal_capacity = 300});
  ASSERT_EQ(tissue.remove(0, SweptTool::bar({0, 0, 0}, 0.5, {2, 0, 0}, 0.5)).outcome,
            RemovalOutcome::Removed);
  const auto before = bytes_of(tissue);
  const SweptTool large = SweptTool::bar({-6, 0, 0}, 2, {6, 5, 0}, 2);
  EXPECT_EQ(tissue.remove(0, large).outcome, RemovalOutcome::ReserveUsedUp);
  EXPECT_EQ(bytes_of(tissue), before);
  EXPECT_EQ(tissue.counts().reserve_used_up, 1);
  EXPECT_EQ(tissue.remove(0, SweptTool::bar({0, 0, 0}, 0.5, {2.2, 0, 0}, 0.5)).outcome,
            RemovalOutcome::Removed);
}

TEST(CutTissue, NamesWhatItCannotDo) {
  CutTissue tissue(bones());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(tissue.remove(0, SweptTool::bar({nan, 0, 0}, 1, {0, 0, 1}, 1)).outcome,
            RemovalOutcome::NotKnown);
  EXPECT_EQ(tissue.remove(0, SweptTool::bar({0, 0, 0}, 5, {0, 0, 9}, 5)).outcome,
            RemovalOutcome::NotKnown);
  EXPECT_EQ(tissue.remove(0, SweptTool::bar({1e300, 0, 0}, 1, {1e300, 1, 1}, 1)).outcome,
            RemovalOutcome::Nothing);
  EXPECT_EQ(tissue.remove(0, SweptTool::bar({15, 0, 0}, 1, {15, 0, 9}, 1)).outcome,
            RemovalOutcome::Nothing);
  EXPECT_FALSE(tissue.undo());
  EXPECT_THROW(CutTissue({}), InvalidInput);
  EXPECT_THROW(CutTissue(bones(), {.brick_capacity = 0}), InvalidInput);
  EXPECT_THROW(CutTissue(bones(), {.brick_capacity = 65535}), InvalidInput);
}

TEST(CutTissue, ComesBackFromItsBytes) {
  Rng rng(5);
  CutTissue tissue(bones());
  for (int i = 0; i < 6; ++i) (void)tissue.remove(rng.below(2), some_tool(rng));
  const auto bytes = bytes_of(tissue);
  CutTissue other(bones());
  (void)other.remove(1, some_tool(rng));
  other.checkpoint();
  const auto read = other.read_from(bytes);
  ASSERT_TRUE(read.has_value()) << read.error();
  EXPECT_EQ(*read, tissue.bricks_in_use());
  EXPECT_EQ(bytes_of(other), bytes);
  EXPECT_EQ(hash_of(other), hash_of(tissue));
  EXPECT_EQ(other.checkpoint_count(), 0);
  std::vector<RemovedShareGrid> a{RemovedShareGrid(other.field(0)),
                                  RemovedShareGrid(other.field(1))};
  std::vector<RemovedShareGrid> b = a;
  bring_up(other, a);
  bring_up(tissue, b);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_TRUE(std::ranges::equal(a[i].share(), b[i].share()));
    EXPECT_GT(a[i].removed_volume_mm3(), 0);
  }
  std::printf("%zu bricks in %zu bytes\n", *read, bytes.size());
}

TEST(CutTissue, RefusesHostileBytes) {
  Rng rng(6);
  CutTissue tissue(bones());
  (void)tissue.remove(0, SweptTool::bar({0, 0, 0}, 0.5, {2, 0, 0}, 0.5));
  const auto good = bytes_of(tissue);
  const auto seal = [](std::vector<std::byte> bytes) {  // a checksum that fits
    bytes.resize(bytes.size() - 8);
    StateHash hash;
    hash.add_bytes(bytes);
    for (unsigned i = 0; i < 64; i += 8) {
      bytes.push_back(static_cast<std::byte>((hash.value() >> i) & 255U));
    }
    return bytes;
  };
  ASSERT_TRUE(CutTissue(bones()).read_from(seal(good)).has_value());
  EXPECT_FALSE(tissue.read_from({}).has_value());
  for (std::size_t length = 0; length < good.size(); length += 97) {
    EXPECT_FALSE(tissue.read_from(std::span(good).first(length)).has_value());
    auto cut_off = good;
    cut_off.resize(std::max<std::size_t>(length, 8));
    EXPECT_FALSE(tissue.read_from(seal(cut_off)).has_value());
  }
  auto longer = good;
  longer.insert(longer.end() - 8, std::byte{0});
  EXPECT_FALSE(tissue.read_from(seal(longer)).has_value());
  std::vector<ContactField> other_bones{bones()[1], bones()[0]};
  EXPECT_FALSE(CutTissue(other_bones).read_from(good).has_value());
  EXPECT_FALSE(CutTissue(bones(), {.brick_capacity = 10}).read_from(good).has_value());
  // Any other change: refused, or a state that keeps every promise and comes back the same.
  int refused = 0;
  const int tries = amount(200, 1000, 20000);
  for (int i = 0; i < tries; ++i) {
    auto bad = good;
    bad[rng.below(bad.size())] = static_cast<std::byte>(rng.below(256));
    if (i % 2 == 0) bad = seal(bad);
    CutTissue target(bones(), {.brick_capacity = 1000, .journal_capacity = 10});
    (void)target.remove(0, SweptTool::bar({1, 0, 0}, 0.5, {3, 0, 0}, 0.5));
    const auto before = bytes_of(target);
    const auto read = target.read_from(bad);
    if (!read.has_value()) {
      ++refused;
      ASSERT_EQ(bytes_of(target), before);
      ASSERT_FALSE(read.error().empty());
    } else {
      ASSERT_EQ(*read, target.bricks_in_use());
    }
  }
  EXPECT_GT(refused, tries / 2);
}

TEST(CutTissue, TellsAllAnewWhenMoreChangedThanItCanNote) {
  Rng rng(7);
  CutTissue tissue(bones(), {.brick_capacity = 1000, .journal_capacity = 2000});
  std::vector<RemovedShareGrid> grids{RemovedShareGrid(tissue.field(0)),
                                      RemovedShareGrid(tissue.field(1))};
  for (int i = 0; i < 20; ++i) {  // each taken back: its bricks are noted and free again
    tissue.checkpoint();
    (void)tissue.remove(0, SweptTool::bar(test::random_shift(rng, 6), 0.5, {0, 0, 0}, 0.5));
    if (i == 3) bring_up(tissue, grids);
    ASSERT_TRUE(tissue.undo());
  }
  (void)tissue.remove(0, SweptTool::bar({0, 0, 0}, 0.5, {2, 0, 0}, 0.5));
  bring_up(tissue, grids);
  CutTissue fresh(bones());
  std::vector<RemovedShareGrid> expected{RemovedShareGrid(fresh.field(0)),
                                         RemovedShareGrid(fresh.field(1))};
  (void)fresh.remove(0, SweptTool::bar({0, 0, 0}, 0.5, {2, 0, 0}, 0.5));
  bring_up(fresh, expected);
  EXPECT_TRUE(std::ranges::equal(grids[0].share(), expected[0].share()));
}

double thread_time_us() {
  timespec now{};
  (void)clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

/// Drills 8 mm a second into the block, as a world would: whole once, then each 0.05 mm, as many
/// bricks in each tick between as the limit says. Processor time of each tick [us].
std::vector<double> drill(CutTissue& tissue,
                          const InstrumentShape& shape,
                          double mm,
                          std::size_t bricks_a_tick) {
  const Mat3 turn = test::turned_to(normalized_or({1, 2, 3}, {}));
  const Vec3 shaft = turn.column(2);
  double cut_at = 10;
  (void)tissue.remove(0, SweptTool::whole(shape, {turn, shaft * cut_at}));
  std::vector<double> times;
  for (double at = 10; at > 10 - mm; at -= 0.008) {
    const double start = thread_time_us();
    if (!tissue.is_removing() && cut_at - at >= 0.05) {
      (void)tissue.start(0, SweptTool::advance(shape, {turn, shaft * at}, cut_at - at));
      cut_at = at;
    } else {
      (void)tissue.advance(bricks_a_tick);
    }
    times.push_back(thread_time_us() - start);
  }
  (void)tissue.finish();
  return times;
}

TEST(CutTissue, CutsUndoesAndTellsInTimeAndInPlace) {
  CutTissue tissue(bones());
  std::array<ShareChange, 64> changes;
  const InstrumentShape wire(CapsuleShape{0.57, 40});
  const InstrumentShape reamer(CapsuleShape{1.65, 40});
  for (const InstrumentShape* shape : {&wire, &reamer}) {
    for (const std::size_t limit : {std::size_t{16}, kMaxCutBricks}) {
      tissue.checkpoint();
      (void)drill(tissue, *shape, 18, limit);  // touches the memory once
      ASSERT_TRUE(tissue.undo());
      tissue.checkpoint();
      auto times = drill(tissue, *shape, 18, limit);
      std::sort(times.begin(), times.end());
      const auto at = [&](double share) {
        return times[static_cast<std::size_t>(share * static_cast<double>(times.size() - 1))];
      };
      std::printf("%.2f mm, %5zu bricks a tick: p50 %.1f, p90 %.1f, p99 %.1f, worst %.1f us\n",
                  shape->greatest_radius_mm(), limit, at(0.5), at(0.9), at(0.99), at(1));
      std::printf("  %zu bricks\n", tissue.bricks_in_use());
      ASSERT_TRUE(tissue.undo());
    }
  }
  std::printf("two bodies, all memory %.1f MiB\n",
              static_cast<double>(tissue.byte_count()) / 1048576);
  EXPECT_LT(tissue.byte_count(), std::size_t{40} << 20U);

  carpus::test::start_counting_allocations();
  tissue.checkpoint();
  (void)tissue.remove(0, SweptTool::bar({-8, 1, 1}, 2, {8, -1, 2}, 1));
  (void)tissue.remove(1, SweptTool::bar({-8, 1, 1}, 2, {8, -1, 2}, 1));
  (void)tissue.take_changes(changes);
  StateHash hash;
  tissue.add_to(hash);
  const double start = thread_time_us();
  const bool is_undone = tissue.undo();
  const double time_us = thread_time_us() - start;
  EXPECT_EQ(carpus::test::stop_counting_allocations(), 0);
  EXPECT_TRUE(is_undone);
  std::printf("undo %.3f ms\n", time_us / 1000);
}

}  // namespace
}  // namespace carpus::fields
