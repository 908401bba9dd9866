// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Everything of a world that changes, as plain data. What changes it: detail/world_state.hpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "cases/case_data.hpp"
#include "contact/instrument_scene.hpp"
#include "fields/contact_field.hpp"
#include "simulation/detail/bodies.hpp"
#include "simulation/detail/joint_fluid.hpp"
#include "simulation/detail/loose_bodies.hpp"
#include "simulation/detail/operation_state.hpp"
#include "simulation/detail/portal_making.hpp"
#include "simulation/detail/punches.hpp"
#include "simulation/detail/scope_drill.hpp"
#include "simulation/detail/scope_watch.hpp"
#include "simulation/detail/screw_watch.hpp"
#include "simulation/detail/scuffs.hpp"
#include "simulation/detail/shaving.hpp"
#include "simulation/detail/structure_watch.hpp"
#include "simulation/detail/tissue.hpp"
#include "simulation/detail/yielding_sheet.hpp"
#include "simulation/world.hpp"
#include "yielding/net_state.hpp"

namespace carpus::simulation::detail {

struct ChangingData {
  ChangingData(const cases::CaseData& data, const std::vector<fields::ContactField>& bones)
      : structures(data), tissue(bones), scene(bones, kHands) {}

  Operated now;
  Spent spent;
  StructureState structure_state;
  ScopeState scope_state;
  ScopeConduct conduct;  ///< told, and no part of the hash
  DrillState drill_state;
  LooseState loose_state;
  ShavingState shaving_state;
  PunchState punch_state;
  JointFluid fluid;
  double suction_ml_per_s = 0.0;  ///< of the joint's fluid in this tick
  ScrewState screw_state;
  MakingState making;
  std::array<yielding::NetState, kMaxSheets> sheets;  ///< as in the model
  /// Of those between two bodies: as they were laid last. Follows from the poses.
  std::array<Pose<frame::Bone, frame::Bone>, kMaxSheets> sheet_poses{};
  std::array<bool, kMaxSheets> has_sheet_moved{};  ///< since it was published
  /// What of a sheet lies under a tip, frame Bone of its first body.
  struct UnderTip {
    std::uint8_t sheet = kNoSheet;
    Vec3 at;
    Vec3 out;  ///< unit, towards the tip
    double most_gives_mm = 0.0;
    bool is_behind = false;  ///< the tip
  };
  std::array<UnderTip, kHands> under_tips{};  ///< found anew in every tick, by hand
  std::array<procedure::ScopeLook, kMaxLooks> looks{};
  cases::LaidStructures structures;
  Tissue tissue;
  contact::InstrumentScene scene;  ///< a place for each hand; what it keeps changes no answer
  std::array<BodyPose, kMaxBodies> poses{};  ///< follow from wrist and shifts
  std::array<Pose<frame::Bone, frame::Patient>, kMaxBodies> inverses{};
  std::array<BodyPose, kMaxBodies> bases{};  ///< without the fragments' displacements
  WristPose wrist_before;                    ///< at the beginning of the tick
  Snapshot snapshot;
  TickFaults faults;
  std::array<procedure::Shot, kMaxShots> shots{};
  std::array<Operated, kMaxCheckpoints> checkpoints{};
  std::array<std::uint32_t, kMaxCheckpoints> passes_at_checkpoint{};
  std::array<Worked, kMaxCheckpoints> worked_at_checkpoint{};
  std::size_t checkpoint_count = 0;
  bool is_finishing = false;  ///< in the tick of Finish
  bool is_hashed = true;
};

}  // namespace carpus::simulation::detail
