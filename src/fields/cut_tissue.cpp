// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A removal in two passes: which bricks may change (and are there enough left for all of them),
// then their nodes. A brick is left out where the tool's depth cannot reach its nodes, where its
// nodes are as deep already, where it lies behind what was swept before, and where the bone is so
// far that d exceeds any depth in the tool: there max(d, c) is d with or without it.
#include "fields/cut_tissue.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

#include "core/check.hpp"
#include "core/error.hpp"
#include "fields/detail/sweep_nodes.hpp"

namespace carpus::fields {
namespace {

constexpr std::uint8_t kIsNoted = 1;  ///< waits to be told
constexpr std::uint8_t kWasTold = 2;  ///< was last told with a share

/// Telling all bricks anew skips this many that need not be told for each that is asked for.
constexpr std::size_t kTableLooksPerChange = 64;

/// From a brick's middle to its corners, per spacing.
constexpr double kHalfDiagonal = 3.4641016151377550;  // sqrt(3) / 2 of four cells, rounded up

constexpr std::uint64_t kOdd = 0x9E3779B97F4A7C15ULL;

std::uint64_t mixed(std::uint64_t value) noexcept {
  value = (value ^ (value >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  value = (value ^ (value >> 27U)) * 0x94D049BB133111EBULL;
  return value ^ (value >> 31U);
}

/// Of a brick's place and nodes; the fingerprint of all is their sum, whatever the order.
std::uint64_t fingerprint_of(std::size_t body,
                             std::uint32_t brick,
                             const CutBrick& nodes) noexcept {
  // Four chains, so that one multiplication need not wait for another.
  std::array<std::uint64_t, 4> chain{1, 2, 3, 4};
  for (std::size_t i = 0; i < nodes.node.size(); i += 4) {
    std::uint64_t word = 0;
    for (std::size_t j = 0; j < 4; ++j) {
      word |= static_cast<std::uint64_t>(static_cast<std::uint16_t>(nodes.node[i + j])) << (16 * j);
    }
    std::uint64_t& hash = chain[i / 4 % 4];
    hash = std::rotl((hash ^ word) * kOdd, 29);
  }
  std::uint64_t hash = mixed((static_cast<std::uint64_t>(body) << 32U) + brick + 1);
  for (const std::uint64_t part : chain) hash = mixed(hash + part);
  return hash;
}

}  // namespace

CutTissue::CutTissue(std::span<const ContactField> bones, const CutTissueOptions& options)
    : bones_(bones) {
  if (bones.empty() || bones.size() > 65535)
    throw InvalidInput("cut tissue: it needs 1 to 65535 bones");
  if (options.brick_capacity == 0 || options.brick_capacity > kMaxCutBricks ||
      options.journal_capacity == 0) {
    throw InvalidInput(
        "cut tissue: brick_capacity must be 1 to 65534, journal_capacity at least 1");
  }
  bricks_.resize(options.brick_capacity);
  states_.resize(options.brick_capacity);
  journal_.resize(options.journal_capacity);
  noted_.resize(2 * options.brick_capacity);
  work_.resize(options.brick_capacity);
  free_.reserve(options.brick_capacity);
  for (std::size_t i = options.brick_capacity; i > 0; --i) {
    free_.push_back(static_cast<std::uint16_t>(i));
  }
  fields_.reserve(bones.size());
  for (const ContactField& bone : bones) {
    fields_.emplace_back(bone, bricks_.data());
    is_noted_.emplace_back(fields_.back().table_.size(), std::uint8_t{0});
  }
}

bool CutTissue::may_change(const CutField& field,
                           const ContactField& bone,
                           const SweptTool& tool,
                           const VoxelIndex& brick,
                           std::uint16_t at) const noexcept {
  const double half = kHalfDiagonal * field.spacing_;
  const double cells = CutBrick::kCells;
  const Vec3 middle =
      field.origin_ + Vec3{brick.x + 0.5, brick.y + 0.5, brick.z + 0.5} * (cells * field.spacing_);
  if (tool.is_back_known()) {
    const double along = dot(middle - tool.origin(), tool.axis());
    if (along - half > tool.knots().back().z_mm) return false;
  }
  const double deepest = half - tool.signed_distance(middle);
  if (deepest < -kCutDepthMm) return false;
  if (at != CutField::kNoBrick) {
    return deepest + kCutUnitMm > states_[at - 1U].least * kCutUnitMm;
  }
  return bone.sample(middle) < tool.greatest_radius_mm() + half + 2 * bone.error_mm();
}

/// Fills work_. False: more bricks than it or the reserve holds.
bool CutTissue::gather(std::size_t body, const SweptTool& tool) noexcept {
  const CutField& field = fields_[body];
  const Aabb box = tool.bounds().grown(kCutDepthMm);
  std::array<int, 3> low{};
  std::array<int, 3> high{};
  work_count_ = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    const double per_brick = field.per_spacing_ / CutBrick::kCells;
    const double last = field.bricks_by_axis_[a] - 1;
    const double from = (box.low[a] - field.origin_[a]) * per_brick;
    const double to = (box.high[a] - field.origin_[a]) * per_brick;
    if (!(to >= 0 && from <= last + 1)) return true;
    // A node on the border is in both bricks: half a cell wider.
    low[a] = static_cast<int>(std::clamp(from - 0.125, 0.0, last));
    high[a] = static_cast<int>(std::clamp(to + 0.125, 0.0, last));
  }
  std::size_t fresh = 0;
  for (int z = low[2]; z <= high[2]; ++z) {
    for (int y = low[1]; y <= high[1]; ++y) {
      for (int x = low[0]; x <= high[0]; ++x) {
        const auto brick = static_cast<std::uint32_t>(
            (z * field.bricks_by_axis_[1] + y) * field.bricks_by_axis_[0] + x);
        const std::uint16_t at = field.table_[brick];
        if (!may_change(field, bones_[body], tool, {x, y, z}, at)) continue;
        if (at == CutField::kNoBrick) ++fresh;
        if (work_count_ == work_.size() || fresh > free_.size()) return false;
        work_[work_count_++] = brick;
      }
    }
  }
  return true;
}

RemovalOutcome CutTissue::start(std::size_t body, const SweptTool& tool) noexcept {
  CARPUS_CHECK(body < fields_.size());
  finish();
  if (!tool.is_sound() || tool.greatest_radius_mm() > kCutReachMm) return RemovalOutcome::NotKnown;
  ++counts_.removals;
  work_done_ = 0;
  if (!gather(body, tool)) {
    work_count_ = 0;
    ++counts_.reserve_used_up;
    return RemovalOutcome::ReserveUsedUp;
  }
  work_body_ = body;
  work_tool_ = tool;
  return work_count_ > 0 ? RemovalOutcome::Removed : RemovalOutcome::Nothing;
}

std::size_t CutTissue::advance(std::size_t brick_limit) noexcept {
  if (!is_removing()) return 0;
  CutField& field = fields_[work_body_];
  const detail::SweepNodes sweep(work_tool_, field.origin_, field.spacing_);
  const std::size_t end = work_done_ + std::min(brick_limit, work_count_ - work_done_);
  std::size_t written = 0;
  for (; work_done_ < end; ++work_done_) {
    if (deepen(work_body_, work_[work_done_], sweep)) ++written;
  }
  return written;
}

Removal CutTissue::remove(std::size_t body, const SweptTool& tool) noexcept {
  Removal result{start(body, tool), 0};
  if (result.outcome != RemovalOutcome::Removed) return result;
  result.bricks_written = static_cast<std::uint32_t>(finish());
  if (result.bricks_written == 0) result.outcome = RemovalOutcome::Nothing;
  return result;
}

/// False: the brick's nodes were as deep already, but for a step.
bool CutTissue::deepen(std::size_t body,
                       std::uint32_t brick,
                       const detail::SweepNodes& sweep) noexcept {
  const CutField& field = fields_[body];
  const auto nx = static_cast<std::uint32_t>(field.bricks_by_axis_[0]);
  const auto ny = static_cast<std::uint32_t>(field.bricks_by_axis_[1]);
  const VoxelIndex low{static_cast<int>(brick % nx) * CutBrick::kCells,
                       static_cast<int>(brick / nx % ny) * CutBrick::kCells,
                       static_cast<int>(brick / (nx * ny)) * CutBrick::kCells};
  alignas(64) std::array<std::int16_t, 128> depth{};
  sweep.depths(low, depth);
  std::uint16_t at = field.table_[brick];
  const CutBrick uncut;
  const CutBrick& before = at == CutField::kNoBrick ? uncut : bricks_[at - 1U];
  int deeper = 0;
  for (std::size_t n = 0; n < depth.size(); ++n) {
    deeper += depth[n] > before.node[n] + 1 ? 1 : 0;
  }
  if (deeper == 0) return false;
  save(body, brick, at);
  if (at == CutField::kNoBrick) at = allocate(body, brick);
  CutBrick& now = bricks_[at - 1U];
  for (std::size_t n = 0; n < depth.size(); ++n) {
    now.node[n] = now.node[n] > depth[n] ? now.node[n] : depth[n];
  }
  update_state(body, brick, at);
  note(body, brick);
  return true;
}

/// The brick's nodes are uncut.
std::uint16_t CutTissue::allocate(std::size_t body, std::uint32_t brick) noexcept {
  const std::uint16_t at = free_.back();
  free_.pop_back();
  bricks_[at - 1U] = CutBrick();
  states_[at - 1U] = {0, checkpoint_count_ > 0 ? serial() : 0, CutBrick::kUncut};
  fields_[body].table_[brick] = at;
  ++fields_[body].brick_count_;
  return at;
}

void CutTissue::release(std::size_t body, std::uint32_t brick) noexcept {
  const std::uint16_t at = fields_[body].table_[brick];
  fingerprint_ -= states_[at - 1U].fingerprint;
  fields_[body].table_[brick] = CutField::kNoBrick;
  --fields_[body].brick_count_;
  free_.push_back(at);  // its capacity is that of the reserve
}

void CutTissue::update_state(std::size_t body, std::uint32_t brick, std::uint16_t at) noexcept {
  const CutBrick& nodes = bricks_[at - 1U];
  BrickState& state = states_[at - 1U];
  fingerprint_ -= state.fingerprint;
  state.fingerprint = fingerprint_of(body, brick, nodes);
  fingerprint_ += state.fingerprint;
  std::int16_t least = nodes.node[0];
  for (std::size_t n = 1; n < CutBrick::kNodeCount; ++n) {
    least = nodes.node[n] < least ? nodes.node[n] : least;
  }
  state.least = least;
}

void CutTissue::save(std::size_t body, std::uint32_t brick, std::uint16_t at) noexcept {
  if (checkpoint_count_ == 0) return;
  if (at != CutField::kNoBrick && states_[at - 1U].saved_at == serial()) return;
  while (journal_end_ - starts_[first_checkpoint_] == journal_.size()) {
    forget_oldest();
    if (checkpoint_count_ == 0) return;
  }
  JournalEntry& entry = journal_[journal_end_ % journal_.size()];
  entry.body = static_cast<std::uint32_t>(body);
  entry.brick = brick;
  entry.was_there = at != CutField::kNoBrick;
  if (entry.was_there) {
    entry.before = bricks_[at - 1U];
    states_[at - 1U].saved_at = serial();
  }
  ++journal_end_;
}

void CutTissue::checkpoint() noexcept {
  finish();
  if (checkpoint_count_ == kMaxCheckpoints) forget_oldest();
  const std::size_t at = (first_checkpoint_ + checkpoint_count_) % kMaxCheckpoints;
  starts_[at] = journal_end_;
  serials_[at] = next_serial_++;
  ++checkpoint_count_;
}

void CutTissue::forget_oldest() noexcept {
  first_checkpoint_ = (first_checkpoint_ + 1) % kMaxCheckpoints;
  --checkpoint_count_;
  ++counts_.checkpoints_forgotten;
}

bool CutTissue::undo() noexcept {
  finish();
  if (checkpoint_count_ == 0) return false;
  const std::size_t last = (first_checkpoint_ + checkpoint_count_ - 1) % kMaxCheckpoints;
  while (journal_end_ > starts_[last]) {
    const JournalEntry& entry = journal_[--journal_end_ % journal_.size()];
    // Entries go back in order, so a brick that was there then is there now.
    const std::uint16_t at = fields_[entry.body].table_[entry.brick];
    CARPUS_CHECK(at != CutField::kNoBrick);
    if (entry.was_there) {
      bricks_[at - 1U] = entry.before;
      update_state(entry.body, entry.brick, at);
    } else {
      release(entry.body, entry.brick);
    }
    note(entry.body, entry.brick);
  }
  --checkpoint_count_;
  ++counts_.undone;
  return true;
}

void CutTissue::note(std::size_t body, std::uint32_t brick) noexcept {
  std::uint8_t& flags = is_noted_[body][brick];
  if ((flags & kIsNoted) != 0 || is_telling_all_) return;
  if (noted_count_ == noted_.size()) {
    tell_all();
    return;
  }
  flags |= kIsNoted;
  noted_[(noted_first_ + noted_count_++) % noted_.size()] = {static_cast<std::uint32_t>(body),
                                                             brick};
}

void CutTissue::tell_all() noexcept {
  for (; noted_count_ > 0; --noted_count_) {
    const BrickPlace& place = noted_[(noted_first_ + noted_count_ - 1) % noted_.size()];
    is_noted_[place.body][place.brick] &= kWasTold;
  }
  is_telling_all_ = true;
  sweep_ = {};
}

ShareChange CutTissue::told(const BrickPlace& place) noexcept {
  const CutField& field = fields_[place.body];
  const std::uint16_t at = field.table_[place.brick];
  ShareChange change{place.body, place.brick, {}};
  if (at != CutField::kNoBrick) change.share = shares_of(bricks_[at - 1U], field.spacing_);
  is_noted_[place.body][place.brick] = at != CutField::kNoBrick ? kWasTold : std::uint8_t{0};
  return change;
}

std::size_t CutTissue::take_changes(std::span<ShareChange> out) noexcept {
  std::size_t count = 0;
  if (is_telling_all_) {
    std::size_t look = kTableLooksPerChange * out.size();
    while (count < out.size() && look > 0 && sweep_.body < fields_.size()) {
      const auto& table = fields_[sweep_.body].table_;
      if (sweep_.brick == table.size()) {
        sweep_ = {sweep_.body + 1, 0};
        continue;
      }
      --look;
      const bool is_cut = table[sweep_.brick] != CutField::kNoBrick;
      if (is_cut || is_noted_[sweep_.body][sweep_.brick] != 0) out[count++] = told(sweep_);
      ++sweep_.brick;
    }
    is_telling_all_ = sweep_.body < fields_.size();
    return count;
  }
  while (count < out.size() && noted_count_ > 0) {
    out[count++] = told(noted_[noted_first_]);
    noted_first_ = (noted_first_ + 1) % noted_.size();
    --noted_count_;
  }
  return count;
}

std::size_t CutTissue::byte_count() const noexcept {
  std::size_t bytes = bricks_.size() * (sizeof(CutBrick) + sizeof(BrickState)) +
                      journal_.size() * sizeof(JournalEntry) + free_.capacity() * sizeof(free_[0]) +
                      work_.size() * sizeof(work_[0]) + noted_.size() * sizeof(noted_[0]);
  for (std::size_t b = 0; b < fields_.size(); ++b) {
    bytes += fields_[b].byte_count() + is_noted_[b].size();
  }
  return bytes;
}

}  // namespace carpus::fields
