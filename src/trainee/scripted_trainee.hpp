// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A scripted operator: sees snapshots, gives inputs, one each tick, and goes through the whole
// operation.
#pragma once

#include <vector>

#include "anatomy/bone_solid.hpp"
#include "cases/case_data.hpp"
#include "core/rng.hpp"
#include "simulation/input.hpp"
#include "simulation/snapshot.hpp"
#include "trainee/hand_motion.hpp"
#include "trainee/skill.hpp"

namespace carpus::trainee {

class ScriptedTrainee {
 public:
  /// @param posed_case  what is operated on; its landmarks, plus errors, are what the trainee reads
  ///                    off the pictures. Must outlive the trainee.
  ScriptedTrainee(const cases::CaseData& posed_case, Skill skill, std::uint64_t seed);

  /// The input for the next tick, from the state that the last one left. Nothing but an idle input
  /// after is_done().
  [[nodiscard]] simulation::Input next(const simulation::Snapshot& now);

  /// The operation was finished (Command::Finish was given).
  [[nodiscard]] bool is_done() const noexcept { return phase_ == Phase::Done; }

 private:
  enum class Phase {
    Survey,
    GoToStandoff,
    Approach,
    Engage,
    Drive,
    Check,
    Judge,
    Withdraw,
    Measure,
    Choose,
    Insert,
    Verify,
    Finish,
    Done
  };
  struct PlannedShot {
    double rotation_deg;
    double tilt_deg;
  };

  void plan_line();
  void enter(Phase phase);
  void start_move(const HandPose& target);
  void think(const simulation::Snapshot& now);
  void act(const simulation::Snapshot& now, simulation::Input& input);
  void drill(const simulation::Snapshot& now, simulation::Input& input);
  void judge_line(const simulation::Snapshot& now);
  void choose_screw(const simulation::Snapshot& now, simulation::Input& input);
  void lean(double depth_mm);
  void insert(const simulation::Snapshot& now, simulation::Input& input);
  bool shoot(simulation::Input& input);
  void plan_shots();
  [[nodiscard]] double draw(const Range& range) { return rng_.uniform(range.low, range.high); }
  [[nodiscard]] Vec3 random_across();
  [[nodiscard]] double offset_of_line(const simulation::Snapshot& now) const;

  const cases::CaseData& case_;
  SkillProfile profile_;
  Rng rng_;
  Tremor tremor_;
  BoneSolid scaphoid_;

  Phase phase_ = Phase::Survey;
  Tick in_phase_ = 0;  ///< ticks since the phase began
  Tick wait_ = 0;      ///< reaction time left
  Tick total_ = 0;
  HandPose hand_;
  MinimumJerkMove move_;
  Tick in_move_ = 0;

  Vec3 planned_entry_;
  Vec3 planned_direction_;
  double error_scale_ = 1.0;
  int tries_ = 0;
  double stop_depth_mm_ = -1.0;
  double thrust_n_ = 30.0;
  double lean_n_ = 0.0;          ///< pushed on top of the usual thrust, because nothing moved
  double last_depth_mm_ = -1e9;  ///< when that was last looked at
  double bury_mm_ = 2.0;
  std::vector<PlannedShot> shots_;
  std::size_t next_shot_ = 0;
};

}  // namespace carpus::trainee
