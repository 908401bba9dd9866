// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Cuts to and from bytes: "CUT1", the mark of the bones, then for each body the number of bricks
// and the bricks in rising order (how far from the last, nodes as differences), a checksum at the
// end. Whole numbers are written seven bits to a byte, lowest first, signed ones folded (0, -1, 1,
// -2): uncut stretches and gentle slopes take a byte or two a node.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/check.hpp"
#include "fields/cut_tissue.hpp"

namespace carpus::fields {
namespace {

constexpr std::uint64_t kVersion = 0x31545543;  // "CUT1"

void put(std::vector<std::byte>& bytes, std::uint64_t value) {
  while (value >= 128) {
    bytes.push_back(static_cast<std::byte>((value & 127U) | 128U));
    value >>= 7U;
  }
  bytes.push_back(static_cast<std::byte>(value));
}
void put_fixed(std::vector<std::byte>& bytes, std::uint64_t value) {
  for (unsigned shift = 0; shift < 64; shift += 8) {
    bytes.push_back(static_cast<std::byte>((value >> shift) & 255U));
  }
}
std::uint64_t folded(int value) {
  const std::int64_t wide = value;
  return static_cast<std::uint64_t>(wide < 0 ? -2 * wide - 1 : 2 * wide);
}

std::uint64_t checksum_of(std::span<const std::byte> bytes) {
  StateHash hash;
  hash.add_bytes(bytes);
  return hash.value();
}

class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : left_(bytes) {}
  /// 0 once spoilt.
  std::uint64_t get() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 35; shift += 7) {
      if (left_.empty()) break;
      const auto byte = static_cast<std::uint64_t>(left_.front());
      left_ = left_.subspan(1);
      value |= (byte & 127U) << shift;
      if (byte < 128) return value;
    }
    is_spoilt_ = true;
    return 0;
  }
  std::uint64_t get_fixed() {
    if (left_.size() < 8) {
      is_spoilt_ = true;
      return 0;
    }
    std::uint64_t value = 0;
    for (unsigned i = 0; i < 8; ++i) value |= static_cast<std::uint64_t>(left_[i]) << (8 * i);
    left_ = left_.subspan(8);
    return value;
  }
  [[nodiscard]] bool is_spoilt() const { return is_spoilt_; }
  [[nodiscard]] bool is_at_end() const { return left_.empty(); }

 private:
  std::span<const std::byte> left_;
  bool is_spoilt_ = false;
};

/// False: cut off, or values that no cut leaves.
bool get_nodes(Reader& in, int steepest, CutBrick& brick) {
  int last = CutBrick::kUncut;
  bool is_cut = false;
  for (std::size_t n = 0; n < CutBrick::kNodeCount; ++n) {
    const auto code = static_cast<std::int64_t>(in.get());
    const std::int64_t value = last + (code % 2 == 0 ? code / 2 : -(code + 1) / 2);
    if (in.is_spoilt() || value < CutBrick::kUncut || value > CutBrick::kDeepest) return false;
    last = static_cast<int>(value);
    is_cut = is_cut || last > CutBrick::kUncut;
    brick.node[n] = static_cast<std::int16_t>(last);
    for (const std::size_t step : {std::size_t{1}, std::size_t{5}, std::size_t{25}}) {
      const bool has_neighbour = n / step % 5 > 0;
      if (has_neighbour && std::abs(last - brick.node[n - step]) > steepest) return false;
    }
  }
  return is_cut;
}

}  // namespace

std::uint64_t CutTissue::case_mark() const noexcept {
  StateHash hash;
  for (const CutField& field : fields_) {
    hash.add(field.spacing_mm());
    for (std::size_t a = 0; a < 3; ++a) {
      hash.add(field.origin()[a]);
      hash.add(static_cast<std::uint64_t>(field.cell_count()[a]));
    }
  }
  return hash.value();
}

void CutTissue::write_to(std::vector<std::byte>& bytes) const {
  CARPUS_CHECK(!is_removing());
  const std::size_t begin = bytes.size();
  put(bytes, kVersion);
  put_fixed(bytes, case_mark());
  for (const CutField& field : fields_) {
    put(bytes, field.brick_count_);
    std::size_t next = 0;
    for (std::size_t b = 0; b < field.table_.size(); ++b) {
      if (field.table_[b] == CutField::kNoBrick) continue;
      put(bytes, b - next);
      next = b + 1;
      int last = CutBrick::kUncut;
      const CutBrick& brick = bricks_[field.table_[b] - 1U];
      for (std::size_t n = 0; n < CutBrick::kNodeCount; ++n) {
        put(bytes, folded(brick.node[n] - last));
        last = brick.node[n];
      }
    }
  }
  put_fixed(bytes, checksum_of(std::span(bytes).subspan(begin)));
}

Result<std::size_t> CutTissue::read_from(std::span<const std::byte> bytes) {
  if (bytes.size() < 8) return Refusal{"cuts: cut off"};
  const auto body_bytes = bytes.first(bytes.size() - 8);
  if (Reader(bytes.last(8)).get_fixed() != checksum_of(body_bytes)) {
    return Refusal{"cuts: the checksum is another"};
  }
  Reader in(body_bytes);
  if (in.get() != kVersion) return Refusal{"cuts: not in the format CUT1"};
  if (in.get_fixed() != case_mark()) return Refusal{"cuts: made in other bones"};
  std::vector<std::pair<BrickPlace, CutBrick>> read;
  for (std::uint32_t body = 0; body < fields_.size(); ++body) {
    const CutField& field = fields_[body];
    const int steepest = static_cast<int>(field.steepest() * field.spacing_mm() / kCutUnitMm) + 2;
    const std::uint64_t count = in.get();
    if (count > bricks_.size() - read.size()) return Refusal{"cuts: more bricks than the reserve"};
    std::uint64_t brick = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
      brick += in.get();
      if (in.is_spoilt() || brick >= field.table_.size()) {
        return Refusal{"cuts: cut off, or a brick outside the bone's grid"};
      }
      read.push_back({{body, static_cast<std::uint32_t>(brick)}, CutBrick()});
      if (!get_nodes(in, steepest, read.back().second)) {
        return Refusal{"cuts: cut off, or values that no cut leaves"};
      }
      ++brick;
    }
  }
  if (in.is_spoilt() || !in.is_at_end()) return Refusal{"cuts: cut off, or more than bricks"};

  checkpoint_count_ = 0;
  work_count_ = 0;
  work_done_ = 0;
  for (std::size_t body = 0; body < fields_.size(); ++body) {
    for (std::uint32_t b = 0; b < fields_[body].table_.size(); ++b) {
      if (fields_[body].table_[b] != CutField::kNoBrick) release(body, b);
    }
  }
  for (const auto& [place, brick] : read) {
    const std::uint16_t at = allocate(place.body, place.brick);
    bricks_[at - 1U] = brick;
    update_state(place.body, place.brick, at);
  }
  tell_all();
  return read.size();
}

}  // namespace carpus::fields
