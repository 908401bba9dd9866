// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A recording to be looked at: any moment of it within the ticks that lie between two keyframes.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "simulation/recording.hpp"
#include "simulation/world.hpp"

namespace carpus::simulation {

/// Not for the 1 kHz thread; one thread at a time.
class ReplayPlayer {
 public:
  /// @param data, procedure  those of the recording; must outlive it.
  /// @throws InvalidInput  as World does.
  ReplayPlayer(const cases::CaseData& data,
               const procedure::Procedure& procedure,
               std::shared_ptr<const Recording> recording);

  [[nodiscard]] Tick length() const noexcept { return recording_->tick_count(); }
  [[nodiscard]] const Recording& recording() const noexcept { return *recording_; }

  /// Goes to the state after `tick` (at most the last): on from where it stands, from the nearest
  /// keyframe or from the beginning, whichever is nearest. Refuses a keyframe that does not fit;
  /// what is shown then is some other moment.
  [[nodiscard]] Result<bool> seek(Tick tick);
  /// The same, with the events of that tick, which a keyframe does not hold; but for an undo's.
  [[nodiscard]] Result<bool> seek_with_events(Tick tick);

  [[nodiscard]] const Snapshot& now() const noexcept { return world_.now(); }
  /// What is to be judged of it so far.
  [[nodiscard]] procedure::OperationRecord operation_record() const {
    return world_.operation_record();
  }
  /// What led to it; nothing at the beginning and at a keyframe.
  [[nodiscard]] const Input& input() const noexcept { return input_; }

 private:
  /// Where to begin: a keyframe, or the beginning with its own state.
  struct Start {
    Tick tick = 0;
    const std::vector<std::byte>* state = nullptr;
  };

  [[nodiscard]] const Start& start_before(Tick tick) const;
  [[nodiscard]] Result<bool> begin_at(const Start& start);
  void step();

  std::shared_ptr<const Recording> recording_;
  World world_;
  std::vector<std::byte> opening_;
  std::vector<Start> starts_;  ///< rising ticks, the first is 0
  InputRuns::Iterator run_;    ///< in which the next tick's input is
  Tick tick_ = 0;              ///< where it stands
  Input input_;
};

}  // namespace carpus::simulation
