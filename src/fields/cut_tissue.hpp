// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// All that one exercise has taken out of its bones: cutting, taking it back, keeping it. The case's
// fields are shared and never written; what changes are bricks of cut fields (cut_field.hpp), taken
// from a reserve that is allocated once.
//
// A journal keeps each brick as it was at the last checkpoint, at its first change after it; undo
// writes those back. Journal and reserve are bounded; what happens at either's end is named and
// counted. A fingerprint of all bricks is kept up with each change.
//
// Who draws or projects the bone takes changes out, brick by brick, for any thread
// (removed_share.hpp).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "core/state_hash.hpp"
#include "fields/contact_field.hpp"
#include "fields/cut_field.hpp"
#include "fields/removed_share.hpp"
#include "geometry/swept_tool.hpp"

namespace carpus::fields {

namespace detail {
class SweepNodes;
}

inline constexpr std::size_t kMaxCheckpoints = 16;
/// A table's entries are 16 bits wide.
inline constexpr std::size_t kMaxCutBricks = 65534;

struct CutTissueOptions {
  /// 256 bytes each; a scaphoid's wire and reamer take 1100 (cut_tissue_test.cpp prints it).
  std::size_t brick_capacity = 32768;
  /// Bricks that the journal holds for all checkpoints, 272 bytes each.
  std::size_t journal_capacity = 16384;
};

enum class RemovalOutcome : std::uint8_t {
  NotKnown,       ///< a number is not finite, or the tool is thicker than kCutReachMm: nothing done
  Nothing,        ///< all of it was gone, or the tool was not in the bone's reach
  Removed,        ///< fields changed
  ReserveUsedUp,  ///< the bricks that this might need are not left: nothing was changed
};

struct Removal {
  RemovalOutcome outcome = RemovalOutcome::NotKnown;
  std::uint32_t bricks_written = 0;
};

struct CutTissueCounts {
  std::uint64_t removals = 0;
  std::uint64_t reserve_used_up = 0;        ///< removals refused
  std::uint64_t checkpoints_forgotten = 0;  ///< the journal, or kMaxCheckpoints, was full
  std::uint64_t undone = 0;
};

class CutTissue {
 public:
  /// @param bones  fields in the bones' own frames, which must outlive this; bodies are numbered in
  ///     their order.
  /// @throws InvalidInput if there are no or more than 65535 bones, or a capacity is 0 or exceeds
  ///     kMaxCutBricks.
  explicit CutTissue(std::span<const ContactField> bones, const CutTissueOptions& options = {});
  CutTissue(const CutTissue&) = delete;
  CutTissue& operator=(const CutTissue&) = delete;
  CutTissue(CutTissue&&) = default;
  CutTissue& operator=(CutTissue&&) = default;
  ~CutTissue() = default;

  [[nodiscard]] std::size_t body_count() const noexcept { return fields_.size(); }
  [[nodiscard]] const CutField& field(std::size_t body) const noexcept { return fields_[body]; }
  [[nodiscard]] std::span<const CutField> fields() const noexcept { return fields_; }

  // Real-time, as all down to take_changes(): noexcept, no allocation, only + - * / and sqrt.

  /// Takes the swept tool out of a body. Cost: the bricks of the tool's box grown by kCutDepthMm
  /// are looked at (0.04 us each), those that it may change are computed (0.4 us each).
  Removal remove(std::size_t body, const SweptTool& tool) noexcept;

  /// The same in slices, for ticks that have little time: start() finishes what was under way and
  /// looks at the bricks, advance() computes up to a number of them. In between, the nodes not yet
  /// reached are as before: what is left seems nearer there by up to the way that the tool swept,
  /// and neighbouring bricks differ by as much, which adds to error_mm().
  /// @return Removed if there are bricks to compute.
  RemovalOutcome start(std::size_t body, const SweptTool& tool) noexcept;
  /// @return how many bricks changed.
  std::size_t advance(std::size_t brick_limit) noexcept;
  [[nodiscard]] bool is_removing() const noexcept { return work_done_ < work_count_; }
  /// To be called before write_to(); checkpoint() and undo() call it.
  std::size_t finish() noexcept { return advance(work_count_); }

  /// Undo will come back to now. Forgets the oldest when there are kMaxCheckpoints.
  void checkpoint() noexcept;
  /// Back to the last checkpoint, to the last bit, which is used up. False: there is none. Whoever
  /// keeps distances from one tick to the next must look anew: bone has come back.
  bool undo() noexcept;
  [[nodiscard]] std::size_t checkpoint_count() const noexcept { return checkpoint_count_; }
  /// There is nothing left to come back to.
  void forget_checkpoints() noexcept { checkpoint_count_ = 0; }

  /// Adds the fingerprint of what is cut now: the same for the same bricks, however they came.
  void add_to(StateHash& hash) const noexcept { hash.add(fingerprint_); }

  /// Bricks whose share changed since they were last taken out, oldest first; each is told as it is
  /// now. @return how many were written to `out`. If more changed than could be noted, all bricks
  /// are told anew.
  std::size_t take_changes(std::span<ShareChange> out) noexcept;
  [[nodiscard]] bool has_changes() const noexcept { return is_telling_all_ || noted_count_ > 0; }

  [[nodiscard]] const CutTissueCounts& counts() const noexcept { return counts_; }
  [[nodiscard]] std::size_t bricks_in_use() const noexcept { return bricks_.size() - free_.size(); }
  /// All memory of this exercise's cuts.
  [[nodiscard]] std::size_t byte_count() const noexcept;

  // Not for the 1 kHz thread.

  /// Everything but the checkpoints: what is cut now. Nothing may be under way.
  void write_to(std::vector<std::byte>& bytes) const;
  /// Takes over what write_to() wrote for the same bones; checkpoints are gone after it. Refused,
  /// and nothing changed, if the bytes are not that, word for word: wrong version or bones, bricks
  /// out of order or range, values that no cut leaves, or more bricks than the reserve holds.
  /// @return the number of bricks.
  [[nodiscard]] Result<std::size_t> read_from(std::span<const std::byte> bytes);

 private:
  struct JournalEntry {
    std::uint32_t body = 0;
    std::uint32_t brick = 0;
    bool was_there = false;
    CutBrick before;
  };
  struct BrickState {
    std::uint64_t fingerprint = 0;
    std::uint64_t saved_at = 0;  ///< serial of the checkpoint for which the journal has it
    std::int16_t least = 0;      ///< of the nodes
  };
  struct BrickPlace {
    std::uint32_t body = 0;
    std::uint32_t brick = 0;
  };

  [[nodiscard]] bool gather(std::size_t body, const SweptTool& tool) noexcept;
  [[nodiscard]] bool may_change(const CutField& field,
                                const ContactField& bone,
                                const SweptTool& tool,
                                const VoxelIndex& brick,
                                std::uint16_t at) const noexcept;
  bool deepen(std::size_t body, std::uint32_t brick, const detail::SweepNodes& sweep) noexcept;
  std::uint16_t allocate(std::size_t body, std::uint32_t brick) noexcept;
  void release(std::size_t body, std::uint32_t brick) noexcept;
  void update_state(std::size_t body, std::uint32_t brick, std::uint16_t at) noexcept;
  void save(std::size_t body, std::uint32_t brick, std::uint16_t at) noexcept;
  void forget_oldest() noexcept;
  void note(std::size_t body, std::uint32_t brick) noexcept;
  void tell_all() noexcept;
  [[nodiscard]] ShareChange told(const BrickPlace& place) noexcept;
  /// Of the last checkpoint.
  [[nodiscard]] std::uint64_t serial() const noexcept {
    return serials_[(first_checkpoint_ + checkpoint_count_ - 1) % kMaxCheckpoints];
  }
  [[nodiscard]] std::uint64_t case_mark() const noexcept;

  std::span<const ContactField> bones_;
  std::vector<CutField> fields_;
  std::vector<CutBrick> bricks_;
  std::vector<BrickState> states_;
  std::vector<std::uint16_t> free_;  ///< as tables name them; the last is taken first
  std::vector<std::uint32_t> work_;  ///< bricks that a removal may change
  std::size_t work_count_ = 0;
  std::size_t work_done_ = 0;
  std::size_t work_body_ = 0;
  SweptTool work_tool_;
  std::uint64_t fingerprint_ = 0;

  std::vector<JournalEntry> journal_;  ///< a ring
  std::uint64_t journal_end_ = 0;      ///< counts on; modulo the size it is the place
  std::array<std::uint64_t, kMaxCheckpoints> starts_{};   ///< of the checkpoints' entries, a ring
  std::array<std::uint64_t, kMaxCheckpoints> serials_{};  ///< likewise
  std::size_t first_checkpoint_ = 0;
  std::size_t checkpoint_count_ = 0;
  std::uint64_t next_serial_ = 1;

  std::vector<BrickPlace> noted_;  ///< a ring
  std::size_t noted_first_ = 0;
  std::size_t noted_count_ = 0;
  std::vector<std::vector<std::uint8_t>> is_noted_;  ///< by body and brick
  bool is_telling_all_ = false;                      ///< all bricks are told anew, from sweep_ on
  BrickPlace sweep_;

  CutTissueCounts counts_;
};

}  // namespace carpus::fields
