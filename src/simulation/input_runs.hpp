// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The inputs of an exercise, tick by tick, held as a recording writes them: what changed since the
// run before, some 35 bytes where both hands move instead of the 216 of an input. An hour at 1 kHz
// takes 0.12 GB, not 0.8, and is decoded in passing.
//
// A run's bytes, little-endian: u32 ticks (not 0), u16 mask of what changed, the changed fields as
// signed differences in the units of quantisation.hpp, seven bits a byte.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <span>
#include <vector>

#include "core/result.hpp"
#include "simulation/input.hpp"
#include "simulation/input_units.hpp"
#include "simulation/snapshot.hpp"

namespace carpus::simulation {

/// Longest exercise that is recorded: 4 hours. Bounds what decoding untrusted bytes may allocate.
inline constexpr std::uint64_t kMaxRecordedTicks = 4ULL * 3600 * 1000;

/// What decoding believes: so much stillness for nothing, and so many ticks for each byte. A
/// keyframe every ten seconds weighs far more; a few bytes that claim hours are refused by name.
inline constexpr std::uint64_t kTicksForNothing = 120'000;
inline constexpr std::uint64_t kTicksForAByte = 100;

/// Ticks in which the input did not change.
struct InputRun {
  Input input;
  std::uint32_t ticks = 0;
  bool operator==(const InputRun&) const = default;
};

/// Grows at its end, in steps of bounded time; is read forward, from any tick.
class InputRuns {
 public:
  class Iterator;

  InputRuns() = default;
  InputRuns(std::initializer_list<InputRun> runs);

  /// Quantises the input. One run with the last where that has the same.
  void push_back(const InputRun& run) { push_back(in_units(run.input), run.ticks); }
  void push_back(const InputUnits& units, std::uint32_t ticks);

  /// Decodes whole runs that `encode_to` or a RunEncoder made, going on from the last input;
  /// untrusted. Refuses by name.
  /// @param whole_size  of the file that they are of: with its keyframes it vouches for their
  /// length.
  /// @return how many bytes were read: those before four zeros, which end runs, or all.
  [[nodiscard]] Result<std::size_t> decode(std::span<const std::byte> bytes,
                                           std::size_t whole_size);
  /// Puts the bytes of all runs behind what is there.
  void encode_to(std::vector<std::byte>& bytes) const;
  /// How many bytes that will be.
  [[nodiscard]] std::size_t encoded_size() const;

  [[nodiscard]] bool empty() const noexcept { return last_.ticks == 0; }
  /// Runs, and ticks in all.
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] std::uint64_t tick_count() const noexcept { return begin_of_last_ + last_.ticks; }
  /// The last one; a resting input of no ticks where there is none.
  [[nodiscard]] const InputRun& back() const noexcept { return last_; }

  [[nodiscard]] Iterator begin() const;
  [[nodiscard]] Iterator end() const;
  /// The run in which the tick after `tick` lies, the end where there is none.
  [[nodiscard]] Iterator at(Tick tick) const;

  bool operator==(const InputRuns&) const = default;

 private:
  /// Some runs in a row. Each stands alone but for the input before it.
  struct Part {
    InputUnits before;
    Tick begin = 0;
    std::size_t runs = 0;
    std::vector<std::byte> bytes;
    bool operator==(const Part&) const = default;
  };

  void encode_last();

  std::vector<Part> parts_;  ///< all but the last run
  InputUnits before_last_;
  InputUnits last_units_;
  InputRun last_;
  Tick begin_of_last_ = 0;
  std::size_t size_ = 0;
};

/// Holds the run that it stands at; valid until the runs change.
class InputRuns::Iterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = InputRun;
  using difference_type = std::ptrdiff_t;
  using pointer = const InputRun*;
  using reference = const InputRun&;

  Iterator() = default;
  reference operator*() const noexcept { return run_; }
  pointer operator->() const noexcept { return &run_; }
  Iterator& operator++();
  Iterator operator++(int) {
    Iterator before = *this;
    ++*this;
    return before;
  }
  bool operator==(const Iterator& other) const noexcept { return left_ == other.left_; }

  /// Ticks before this run.
  [[nodiscard]] Tick begin_tick() const noexcept { return begin_; }

 private:
  friend class InputRuns;
  Iterator(const InputRuns& runs, std::size_t part);

  const InputRuns* runs_ = nullptr;
  std::size_t left_ = 0;  ///< runs from this one on
  std::size_t part_ = 0;
  std::size_t offset_ = 0;  ///< in the part's bytes, of the run after this one
  InputUnits units_;
  InputRun run_;
  Tick begin_ = 0;
};

/// Runs to bytes, a part at a time. The parts put together are the runs.
class RunEncoder {
 public:
  /// @param before  the input that the next run is compared with.
  explicit RunEncoder(const Input& before = {}) : before_(in_units(before)) {}
  void put(const InputRun& run);
  /// What was put since the last call.
  [[nodiscard]] std::vector<std::byte> take();

 private:
  InputUnits before_;
  std::vector<std::byte> bytes_;
};

}  // namespace carpus::simulation
