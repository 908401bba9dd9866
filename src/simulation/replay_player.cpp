// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/replay_player.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace carpus::simulation {

ReplayPlayer::ReplayPlayer(const cases::CaseData& data,
                           const procedure::Procedure& procedure,
                           std::shared_ptr<const Recording> recording)
    : recording_(std::move(recording)),
      world_(data, procedure, recording_->seed, recording_->mode, recording_->prepared),
      opening_(world_.write_state()),
      run_(recording_->runs.begin()) {
  starts_.push_back({0, &opening_});
  for (const Keyframe& keyframe : recording_->keyframes) {
    if (keyframe.tick > 0 && keyframe.tick <= length()) {
      starts_.push_back({keyframe.tick, &keyframe.state});
    }
  }
}

const ReplayPlayer::Start& ReplayPlayer::start_before(Tick tick) const {
  const auto after =
      std::upper_bound(starts_.begin(), starts_.end(), tick,
                       [](Tick wanted, const Start& start) { return wanted < start.tick; });
  return *std::prev(after);
}

Result<bool> ReplayPlayer::begin_at(const Start& start) {
  const Result<bool> taken = world_.read_state(*start.state);
  if (!taken) return taken;
  if (world_.now().tick != start.tick) {
    return carpus::Refusal{"recording: a keyframe is not of the tick that it names"};
  }
  tick_ = start.tick;
  run_ = recording_->runs.at(tick_);
  input_ = {};
  return true;
}

void ReplayPlayer::step() {
  input_ = run_->input;
  world_.step(input_);
  ++tick_;
  if (tick_ == run_.begin_tick() + run_->ticks) ++run_;
}

Result<bool> ReplayPlayer::seek(Tick wanted) {
  const Tick tick = std::min(wanted, length());
  const Start& start = start_before(tick);
  // Where it stands is as good as a keyframe, but for what undo would go back to: that has one.
  if (tick < tick_ || start.tick > tick_) {
    const Result<bool> begun = begin_at(start);
    if (!begun) return begun;
  }
  while (tick_ < tick) step();
  return true;
}

Result<bool> ReplayPlayer::seek_with_events(Tick wanted) {
  const Tick tick = std::min(wanted, length());
  if (tick == 0) return seek(0);
  const Result<bool> reached = seek(tick - 1);
  if (!reached) return reached;
  if (goes_back(run_->input.command.kind)) return seek(tick);
  step();
  return true;
}

}  // namespace carpus::simulation
