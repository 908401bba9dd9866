// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A scripted operator: sees snapshots, gives inputs, one each tick, and goes through a whole
// fixation of a bone by a wire and a screw, from whichever pole and with whatever steps the
// procedure declares.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "anatomy/bone_solid.hpp"
#include "cases/case_data.hpp"
#include "core/rng.hpp"
#include "procedure/procedure.hpp"
#include "simulation/input.hpp"
#include "simulation/snapshot.hpp"
#include "trainee/hand_motion.hpp"
#include "trainee/leading_sleeve.hpp"
#include "trainee/reducing.hpp"
#include "trainee/skill.hpp"

namespace carpus::trainee {

class ScriptedTrainee {
 public:
  /// @param data  what is operated on; its landmarks, plus errors, are what the trainee reads off
  /// the
  ///              pictures. It and the procedure must outlive the trainee.
  /// @throws InvalidInput  when the procedure is no fixation of the scaphoid by a wire and a screw.
  ScriptedTrainee(const cases::CaseData& data,
                  const procedure::Procedure& procedure,
                  Skill skill,
                  std::uint64_t seed);

  /// The input for the next tick, from the state that the last one left. Nothing but an idle input
  /// after is_done().
  [[nodiscard]] simulation::Input next(const simulation::Snapshot& now);

  /// The operation was finished (Command::Finish was given).
  [[nodiscard]] bool is_done() const noexcept { return phase_ == Phase::Done; }

 private:
  enum class Phase {
    Survey,
    Reduce,
    LookReduced,
    PlaceSleeve,
    GoToStandoff,
    Approach,
    Engage,
    Drive,
    Check,
    Judge,
    PutSleeveDown,
    FreeFragment,
    DriveThrough,
    TakeFarEnd,
    DrawThrough,
    LookExtended,
    PushBack,
    TakeNearEnd,
    DrawBack,
    Withdraw,
    Measure,
    HoldWire,
    Ream,
    DrillOut,
    Choose,
    Insert,
    LetGo,
    TakeWire,
    DrawWire,
    Verify,
    Finish,
    Done
  };
  struct PlannedShot {
    double rotation_deg;
    double tilt_deg;
  };

  void plan_line(const simulation::Snapshot& now);
  void enter(Phase phase, const simulation::Snapshot& now);
  void start_move(const HandPose& target);
  /// The next try, on a line that is planned anew.
  void try_again(const simulation::Snapshot& now);
  void think(const simulation::Snapshot& now);
  void think_of_line(const simulation::Snapshot& now);
  void act(const simulation::Snapshot& now, simulation::Input& input);
  void drill(const simulation::Snapshot& now, simulation::Input& input);
  void ream(const simulation::Snapshot& now, simulation::Input& input);
  void measure(const simulation::Snapshot& now, simulation::Input& input);
  void think_of_drawing_through(const simulation::Snapshot& now);
  void draw_through(const simulation::Snapshot& now, simulation::Input& input);
  void take_end(simulation::CommandKind end,
                Phase next,
                const simulation::Snapshot& now,
                simulation::Input& input);
  [[nodiscard]] bool is_way_out_free(const simulation::Snapshot& now) const;
  void judge_line(const simulation::Snapshot& now);
  void choose_screw(const simulation::Snapshot& now, simulation::Input& input);
  void lean(double depth_mm);
  void insert(const simulation::Snapshot& now, simulation::Input& input);
  void take_wire(const simulation::Snapshot& now, simulation::Input& input);
  [[nodiscard]] PlannedShot down_the_bone(const simulation::Snapshot& now) const;
  bool shoot(simulation::Input& input);
  void plan_shots(const simulation::Snapshot& now);
  [[nodiscard]] double draw(const Range& range) { return rng_.uniform(range.low, range.high); }
  [[nodiscard]] Vec3 random_across();
  [[nodiscard]] Vec3 random_error(const Range& range_mm);
  [[nodiscard]] double offset_of_line(const simulation::Snapshot& now) const;
  /// What the first hand holds.
  [[nodiscard]] static simulation::ItemView held(const simulation::Snapshot& now);
  /// Where the axis ends, as the fragments lie now, Patient.
  [[nodiscard]] Vec3 near_end(const simulation::Snapshot& now) const;
  [[nodiscard]] Vec3 far_end(const simulation::Snapshot& now) const;
  [[nodiscard]] HandPose second_hand() const;
  [[nodiscard]] bool is_seen_apart(const simulation::Snapshot& now) const;
  void plan_on_reduced_bone(const simulation::Snapshot& now);
  [[nodiscard]] bool is_posing(const simulation::Snapshot& now, simulation::Input& input);
  [[nodiscard]] simulation::Command judgement(const simulation::Snapshot& now) const;
  void look_at_bone(const simulation::Snapshot& now, simulation::Input& input);
  /// A direction of frame Bone of the target in Patient, as it lies now.
  [[nodiscard]] Vec3 turned(const simulation::Snapshot& now, const Vec3& in_target) const;
  [[nodiscard]] double true_chord(const simulation::Snapshot& now,
                                  const simulation::ItemView& wire) const;

  const cases::CaseData& case_;
  const procedure::Procedure& procedure_;
  procedure::Opening opening_;
  Vec3 near_end_;  ///< of the central axis, where the wire goes in
  Vec3 far_end_;
  std::size_t target_ = 0;     ///< body
  std::size_t near_body_ = 0;  ///< fragments of the axis's ends: the target of a whole bone
  std::size_t far_body_ = 0;
  instruments::InstrumentIndex gauge_ = instruments::kNoInstrument;
  instruments::InstrumentIndex drill_ = instruments::kNoInstrument;  ///< where a step asks for it
  SkillProfile profile_;
  Rng rng_;
  Tremor tremor_;
  BoneSolid scaphoid_;  ///< as its fragments lie, frame Bone of the target
  Reducing reducing_;
  LeadingSleeve sleeve_;

  bool uses_sleeve_ = false;
  bool is_drawn_through_ = false;  ///< the wire was
  bool draws_through_ = false;     ///< a step asks for it, and this trainee knows how
  simulation::WristPose wrist_;    ///< as it is to be held
  Phase phase_ = Phase::Survey;
  Tick posing_ = 0;
  bool has_begun_ = false;
  bool has_judged_ = false;
  Tick in_phase_ = 0;  ///< ticks since the phase began
  Tick wait_ = 0;      ///< reaction time left
  Tick total_ = 0;
  HandPose hand_;
  MinimumJerkMove move_;
  Tick in_move_ = 0;

  Vec3 planned_entry_;      ///< Patient
  Vec3 planned_direction_;  ///< Patient, into the bone
  double error_scale_ = 1.0;
  int tries_ = 0;
  Phase after_sleeve_ = Phase::Finish;
  Phase after_freeing_ = Phase::Finish;
  double stop_depth_mm_ = -1.0;
  double ream_depth_mm_ = 0.0;
  double thrust_n_ = 30.0;
  double lean_n_ = 0.0;          ///< pushed on top of the usual thrust, because nothing moved
  double last_depth_mm_ = -1e9;  ///< when that was last looked at
  double bury_mm_ = 2.0;
  std::uint8_t taken_item_ = simulation::kNoItem;  ///< let go of to take it at its other end
  std::vector<PlannedShot> shots_;
  std::size_t next_shot_ = 0;
};

}  // namespace carpus::trainee
