// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/input_runs.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "core/rng.hpp"
#include "simulation/detail/bytes.hpp"

namespace carpus::simulation {
namespace {

/// Both hands move in most ticks; commands, pedal and wrist now and then.
std::vector<InputRun> a_way(std::size_t count) {
  Rng rng(7);
  std::vector<InputRun> runs;
  Input input;
  while (runs.size() < count) {
    for (HandInput& hand : input.hands) {
      for (std::size_t k = 0; k < 3; ++k) {
        hand.tip_in_patient[k] += 0.3 * rng.normal();
        hand.shaft_in_patient[k] += 0.002 * rng.normal();
      }
    }
    input.command = {};
    const auto what = rng.below(40);
    if (what == 0) input.command = {CommandKind::TakeShot, 0, 0, 31.5, -5};
    if (what == 1) input.c_arm = {rng.normal(), rng.normal(), !input.c_arm.pedal_is_down};
    if (what == 2) input.hands[0].driver = Driver::Forward;
    if (what == 3) input.wrist.flexion_rad += 0.01;
    runs.push_back({quantised(input), 1 + static_cast<std::uint32_t>(rng.below(3))});
  }
  return runs;
}

InputRuns runs_of(const std::vector<InputRun>& list) {
  InputRuns runs;
  for (const InputRun& run : list) runs.push_back(run);
  return runs;
}

std::vector<InputRun> list_of(const InputRuns& runs) { return {runs.begin(), runs.end()}; }

/// Lengths at which something begins or ends: none, the last one that is not encoded, parts.
constexpr std::array<std::size_t, 8> kLengths{0, 1, 2, 3, 1024, 1025, 1026, 3000};

TEST(InputRuns, ComeBackInOrderWhateverTheirLength) {
  for (const std::size_t length : kLengths) {
    const std::vector<InputRun> list = a_way(length);
    const InputRuns runs = runs_of(list);
    EXPECT_EQ(list_of(runs), list) << length;
    EXPECT_EQ(runs.size(), length);
    EXPECT_EQ(runs.empty(), length == 0);
    Tick ticks = 0;
    for (const InputRun& run : list) ticks += run.ticks;
    EXPECT_EQ(runs.tick_count(), ticks);
    std::vector<std::byte> bytes;
    runs.encode_to(bytes);
    EXPECT_EQ(bytes.size(), runs.encoded_size());
    InputRuns again;
    const auto read = again.decode(bytes, bytes.size());
    ASSERT_TRUE(read.has_value()) << read.error();
    EXPECT_EQ(*read, bytes.size());
    EXPECT_EQ(again, runs) << length;
  }
}

TEST(InputRuns, AreReadFromAnyTick) {
  for (const std::size_t length : kLengths) {
    const InputRuns runs = runs_of(a_way(length));
    Tick begin = 0;
    for (const InputRun& run : runs) {
      for (Tick tick = begin; tick < begin + run.ticks; ++tick) {
        const auto there = runs.at(tick);
        ASSERT_NE(there, runs.end()) << tick;
        ASSERT_EQ(*there, run) << tick;
        ASSERT_EQ(there.begin_tick(), begin) << tick;
      }
      begin += run.ticks;
    }
    EXPECT_EQ(runs.at(begin), runs.end());
    EXPECT_EQ(runs.at(begin + 1000), runs.end());
    if (begin < 5) continue;
    auto from = runs.at(begin / 2);
    Tick left = 0;
    for (; from != runs.end(); ++from) left += from->ticks;
    EXPECT_GE(left, begin / 2);
    EXPECT_LE(left, begin / 2 + 4);
  }
}

TEST(InputRuns, TheSameInputAgainIsOneRun) {
  const InputRun run = a_way(1).front();
  InputRuns runs;
  for (const std::uint32_t ticks : {250U, 0U, 250U, 7U}) runs.push_back({run.input, ticks});
  EXPECT_EQ(list_of(runs), (std::vector<InputRun>{{run.input, 507}}));
  runs.push_back({run.input, UINT32_MAX});
  EXPECT_EQ(runs.size(), 2U) << "a run's ticks do not overflow";
  EXPECT_EQ(runs.tick_count(), 507 + std::uint64_t{UINT32_MAX});
}

TEST(InputRuns, TakeAFewBytesARun) {
  const InputRuns runs = runs_of(a_way(20'000));
  EXPECT_LT(runs.encoded_size(), 40 * runs.size());
  EXPECT_GT(sizeof(InputRun), 200U) << "what each would take as it is";
}

TEST(InputRuns, CutOffAnywhereAreRefusedByName) {
  const InputRuns runs = runs_of(a_way(60));
  std::vector<std::byte> bytes;
  runs.encode_to(bytes);
  std::size_t whole = 0;
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    InputRuns cut;
    const auto read = cut.decode(std::span(bytes).first(size), 1000);
    if (read) {  // between two runs
      ++whole;
      EXPECT_EQ(*read, size);
    } else {
      EXPECT_EQ(read.error(), "recording: cut off among the inputs");
    }
  }
  EXPECT_EQ(whole, runs.size()) << "none, and each but the last";
}

TEST(InputRuns, NumbersThatNoDeviceGivesAreRefused) {
  // Two ticks, the tip of the first hand: a difference that goes beyond any input, or wraps.
  for (const std::int64_t difference :
       {std::int64_t{1'000'000'001}, std::int64_t{1'000'000'002}, std::int64_t{-1'000'000'001},
        std::int64_t{INT64_MAX}, std::int64_t{INT64_MIN}}) {
    detail::Writer out;
    out.put(2, 4);
    out.put(1, 2);
    for (const std::int64_t each : {difference, std::int64_t{0}, std::int64_t{0}}) {
      out.put_signed(each);
    }
    InputRuns runs;
    const auto read = runs.decode(out.bytes(), 100);
    EXPECT_EQ(read.has_value(), difference == 1'000'000'001) << difference;
    if (read) continue;
    EXPECT_NE(read.error().find("number that does not exist"), std::string::npos) << read.error();
  }
}

TEST(InputRuns, FourZerosEndThem) {
  std::vector<std::byte> bytes;
  runs_of(a_way(3)).encode_to(bytes);
  const std::size_t size = bytes.size();
  bytes.resize(size + 9);
  InputRuns runs;
  const auto read = runs.decode(bytes, bytes.size());
  ASSERT_TRUE(read.has_value()) << read.error();
  EXPECT_EQ(*read, size);
  EXPECT_EQ(runs.size(), 3U);
}

TEST(RunEncoder, PartsPutTogetherAreTheRuns) {
  const std::vector<InputRun> list = a_way(500);
  RunEncoder encoder;
  InputRuns runs;
  for (std::size_t i = 0; i < list.size(); ++i) {
    encoder.put(list[i]);
    if (i % 7 != 3) continue;
    ASSERT_TRUE(runs.decode(encoder.take(), 10'000).has_value());
    encoder = RunEncoder(list[i].input);  // as one that goes on after the program was started anew
  }
  ASSERT_TRUE(runs.decode(encoder.take(), 10'000).has_value());
  EXPECT_EQ(list_of(runs), list);
  RunEncoder still;
  for (const std::uint32_t ticks : {250U, 250U, 7U}) still.put({list[0].input, ticks});
  InputRuns joined;
  ASSERT_TRUE(joined.decode(still.take(), 1000).has_value());
  EXPECT_EQ(joined, (InputRuns{{list[0].input, 507}}));
}

}  // namespace
}  // namespace carpus::simulation
