// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The second hand at the wire's entry: a sleeve held on the way that the wire is to take, so that
// it spreads what lies under the skin and the point does not slip [clinical: B1 step 3].
#pragma once

#include "procedure/procedure.hpp"
#include "simulation/input.hpp"
#include "simulation/snapshot.hpp"
#include "trainee/hand_motion.hpp"

namespace carpus::trainee {

class LeadingSleeve {
 public:
  explicit LeadingSleeve(const procedure::Procedure& procedure);

  /// One lies on the tray.
  [[nodiscard]] bool is_offered() const noexcept {
    return instrument_ != instruments::kNoInstrument;
  }
  [[nodiscard]] bool is_held() const noexcept { return is_held_; }

  /// Of a way into bone: to be taken, or turned to it where the hand has it already.
  /// @param hand  where the second hand is; not asked for once the sleeve is held.
  void begin(const HandPose& hand, const Vec3& entry, const Vec3& inward, double mm_per_s);
  /// Each tick from then on. @return that it stands: on the first bone that it met, or just before
  /// the entry.
  [[nodiscard]] bool next(const simulation::Snapshot& now, simulation::Input& input);
  /// Where the hand keeps it.
  void keep(simulation::Input& input) const;
  void put_down(simulation::Input& input);

 private:
  enum class Stage { Take, Come, Approach, Stands };
  void move_to(const HandPose& target);

  instruments::InstrumentIndex instrument_ = instruments::kNoInstrument;
  bool is_held_ = false;
  Stage stage_ = Stage::Stands;
  HandPose hand_;
  Vec3 entry_;
  Vec3 inward_{0, 0, 1};
  double mm_per_s_ = 50.0;
  MinimumJerkMove move_;
  Tick in_move_ = 0;
};

}  // namespace carpus::trainee
