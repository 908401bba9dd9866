// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/input_runs.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "simulation/detail/bytes.hpp"

namespace carpus::simulation {
namespace {

using detail::Reader;
using detail::Writer;

/// A part is whole after so many runs: what a jump to a tick decodes for nothing, and the most that
/// is copied where bytes grow.
constexpr std::size_t kRunsOfAPart = 1024;

/// Bits of the mask of what changed: five a hand, then wrist, C-arm and command.
constexpr unsigned kBitsPerHand = 5;
constexpr unsigned kWristBit = kBitsPerHand * kHands;
constexpr unsigned kCArmBit = kWristBit + 1;
constexpr unsigned kCommandBit = kCArmBit + 1;
constexpr unsigned kAllBits = (1U << (kCommandBit + 1)) - 1;

unsigned changes(const InputUnits& a, const InputUnits& b) {
  unsigned mask = 0;
  for (unsigned h = 0; h < kHands; ++h) {
    const unsigned first = h * kBitsPerHand;
    if (a.hands[h].tip != b.hands[h].tip) mask |= 1U << first;
    if (a.hands[h].shaft != b.hands[h].shaft) mask |= 1U << (first + 1);
    if (a.hands[h].thrust != b.hands[h].thrust) mask |= 1U << (first + 2);
    if (a.hands[h].driver != b.hands[h].driver) mask |= 1U << (first + 3);
    if (a.hands[h].guidance != b.hands[h].guidance) mask |= 1U << (first + 4);
  }
  if (a.wrist != b.wrist) mask |= 1U << kWristBit;
  if (a.c_arm != b.c_arm) mask |= 1U << kCArmBit;
  if (a.command != b.command) mask |= 1U << kCommandBit;
  return mask;
}

template <std::size_t Count>
void put_differences(Writer& out,
                     const std::array<std::int64_t, Count>& now,
                     const std::array<std::int64_t, Count>& before) {
  for (std::size_t i = 0; i < Count; ++i) out.put_signed(now[i] - before[i]);
}

template <std::size_t Count>
void add_differences(Reader& in, std::array<std::int64_t, Count>& values) {
  // As unsigned: a hostile difference may wrap, never overflow.
  for (std::int64_t& value : values) {
    value = static_cast<std::int64_t>(static_cast<std::uint64_t>(value) +
                                      static_cast<std::uint64_t>(in.get_signed()));
  }
}

void put_run(Writer& out, std::uint32_t ticks, const InputUnits& before, const InputUnits& now) {
  const unsigned mask = changes(now, before);
  out.put(ticks, 4);
  out.put(mask, 2);
  for (unsigned h = 0; h < kHands; ++h) {
    const unsigned bits = mask >> (h * kBitsPerHand);
    const InputUnits::Hand& hand = now.hands[h];
    if ((bits & 1U) != 0) put_differences(out, hand.tip, before.hands[h].tip);
    if ((bits & 2U) != 0) put_differences(out, hand.shaft, before.hands[h].shaft);
    if ((bits & 4U) != 0) out.put_signed(hand.thrust - before.hands[h].thrust);
    if ((bits & 8U) != 0) out.put(hand.driver, 1);
    if ((bits & 16U) != 0) out.put(hand.guidance, 1);
  }
  if ((mask >> kWristBit & 1U) != 0) put_differences(out, now.wrist, before.wrist);
  if ((mask >> kCArmBit & 1U) != 0) {
    put_differences(out, now.c_arm.stand, before.c_arm.stand);
    out.put(now.c_arm.pedal, 1);
  }
  if ((mask >> kCommandBit & 1U) != 0) {
    out.put(now.command.kind, 1);
    out.put(now.command.hand, 1);
    out.put(now.command.index, 1);
    for (const std::int64_t angle : now.command.view) out.put_signed(angle);
  }
}

/// Reads what changed into `units`, whatever that makes of them.
void get_changes(Reader& in, unsigned mask, InputUnits& units) {
  for (unsigned h = 0; h < kHands; ++h) {
    const unsigned bits = mask >> (h * kBitsPerHand);
    InputUnits::Hand& hand = units.hands[h];
    if ((bits & 1U) != 0) add_differences(in, hand.tip);
    if ((bits & 2U) != 0) add_differences(in, hand.shaft);
    if ((bits & 4U) != 0) {
      std::array<std::int64_t, 1> thrust{hand.thrust};
      add_differences(in, thrust);
      hand.thrust = thrust[0];
    }
    if ((bits & 8U) != 0) hand.driver = static_cast<std::uint8_t>(in.get(1));
    if ((bits & 16U) != 0) hand.guidance = static_cast<std::uint8_t>(in.get(1));
  }
  if ((mask >> kWristBit & 1U) != 0) add_differences(in, units.wrist);
  if ((mask >> kCArmBit & 1U) != 0) {
    add_differences(in, units.c_arm.stand);
    units.c_arm.pedal = static_cast<std::uint8_t>(in.get(1));
  }
  if ((mask >> kCommandBit & 1U) != 0) {
    units.command.kind = static_cast<std::uint8_t>(in.get(1));
    units.command.hand = static_cast<std::uint8_t>(in.get(1));
    units.command.index = static_cast<std::uint8_t>(in.get(1));
    for (std::int64_t& angle : units.command.view) angle = in.get_signed();
  }
}

/// The most ticks that so many bytes may hold.
std::uint64_t most_ticks(std::size_t bytes) {
  return std::min(kMaxRecordedTicks, kTicksForNothing + kTicksForAByte * bytes);
}

/// Nothing where it may be believed.
std::string reason_against(std::uint64_t ticks, std::size_t size) {
  if (ticks > kMaxRecordedTicks) return "recording: longer than 4 hours";
  if (ticks <= most_ticks(size)) return {};
  return "recording: " + std::to_string(size) + " bytes that claim " +
         std::to_string(ticks / 1000) + " s or more; an exercise of that length takes more";
}

}  // namespace

InputRuns::InputRuns(std::initializer_list<InputRun> runs) {
  for (const InputRun& run : runs) push_back(run);
}

void InputRuns::encode_last() {
  if (parts_.empty() || parts_.back().runs == kRunsOfAPart) {
    if (!parts_.empty()) parts_.back().bytes.shrink_to_fit();
    parts_.push_back({before_last_, begin_of_last_, 0, {}});
  }
  Part& part = parts_.back();
  Writer out(std::move(part.bytes));
  put_run(out, last_.ticks, before_last_, last_units_);
  part.bytes = std::move(out.bytes());
  ++part.runs;
}

void InputRuns::push_back(const InputUnits& units, std::uint32_t ticks) {
  if (ticks == 0) return;
  if (!empty() && units == last_units_ && last_.ticks <= UINT32_MAX - ticks) {
    last_.ticks += ticks;
    return;
  }
  if (!empty()) {
    encode_last();
    begin_of_last_ += last_.ticks;
    before_last_ = last_units_;
  } else {
    before_last_ = in_units(Input{});
  }
  last_units_ = units;
  last_ = {input_of(units), ticks};
  ++size_;
}

Result<std::size_t> InputRuns::decode(std::span<const std::byte> bytes, std::size_t whole_size) {
  const carpus::Refusal cut{"recording: cut off among the inputs"};
  Reader in(bytes);
  InputUnits units = empty() ? in_units(Input{}) : last_units_;
  while (in.at() < bytes.size()) {
    const std::size_t begin = in.at();
    const auto ticks = static_cast<std::uint32_t>(in.get(4));
    if (in.is_spoilt()) return cut;
    if (ticks == 0) return begin;
    const auto mask = static_cast<unsigned>(in.get(2));
    if ((mask & ~kAllBits) == 0) get_changes(in, mask, units);
    if (in.is_spoilt()) return cut;
    if ((mask & ~kAllBits) != 0 || !is_an_input(units)) {
      return carpus::Refusal{
          "recording: an input names a driver, command, field or number that does not exist"};
    }
    std::string reason = reason_against(tick_count() + ticks, whole_size);
    if (!reason.empty()) return carpus::Refusal{std::move(reason)};
    push_back(units, ticks);
  }
  return bytes.size();
}

void InputRuns::encode_to(std::vector<std::byte>& bytes) const {
  for (const Part& part : parts_) bytes.insert(bytes.end(), part.bytes.begin(), part.bytes.end());
  if (empty()) return;
  Writer out(std::move(bytes));
  put_run(out, last_.ticks, before_last_, last_units_);
  bytes = std::move(out.bytes());
}

std::size_t InputRuns::encoded_size() const {
  std::vector<std::byte> last;
  if (!empty()) {
    Writer out;
    put_run(out, last_.ticks, before_last_, last_units_);
    last = std::move(out.bytes());
  }
  std::size_t size = last.size();
  for (const Part& part : parts_) size += part.bytes.size();
  return size;
}

InputRuns::Iterator::Iterator(const InputRuns& runs, std::size_t part)
    : runs_(&runs), left_(runs.size_ + 1), part_(part) {
  left_ -= part * kRunsOfAPart;
  if (part < runs.parts_.size()) {
    units_ = runs.parts_[part].before;
    begin_ = runs.parts_[part].begin;
  }
  run_.ticks = 0;
  ++*this;
}

InputRuns::Iterator& InputRuns::Iterator::operator++() {
  begin_ += run_.ticks;
  --left_;
  if (left_ == 0) return *this;
  if (left_ == 1) {
    begin_ = runs_->begin_of_last_;
    run_ = runs_->last_;
    return *this;
  }
  if (offset_ == runs_->parts_[part_].bytes.size()) {
    ++part_;
    offset_ = 0;
  }
  Reader in(std::span(runs_->parts_[part_].bytes).subspan(offset_));
  run_.ticks = static_cast<std::uint32_t>(in.get(4));
  get_changes(in, static_cast<unsigned>(in.get(2)), units_);
  run_.input = input_of(units_);
  offset_ += in.at();
  return *this;
}

InputRuns::Iterator InputRuns::begin() const { return empty() ? end() : Iterator(*this, 0); }

InputRuns::Iterator InputRuns::end() const { return {}; }

InputRuns::Iterator InputRuns::at(Tick tick) const {
  if (tick >= tick_count()) return end();
  const auto after = std::ranges::upper_bound(parts_, tick, {}, &Part::begin);
  Iterator run(*this,
               after == parts_.begin() ? 0 : static_cast<std::size_t>(after - parts_.begin()) - 1);
  while (run.begin_tick() + run->ticks <= tick) ++run;
  return run;
}

void RunEncoder::put(const InputRun& run) {
  const InputUnits units = in_units(run.input);
  Writer out(std::move(bytes_));
  put_run(out, run.ticks, before_, units);
  bytes_ = std::move(out.bytes());
  before_ = units;
}

std::vector<std::byte> RunEncoder::take() { return std::exchange(bytes_, {}); }

}  // namespace carpus::simulation
