// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What was done, as far as any score needs it: plain values that the simulation hands over.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cases/joint_lesions.hpp"
#include "core/units.hpp"
#include "geometry/pose.hpp"
#include "procedure/fluid_use.hpp"
#include "procedure/situation.hpp"

namespace carpus::procedure {

/// One way that an instrument took into bone, from entering to leaving or to the end. Harm stays on
/// record whatever is undone.
struct Pass {
  instruments::InstrumentIndex instrument = instruments::kNoInstrument;
  std::uint8_t first_body = kNoBody;
  std::uint32_t bodies_entered = 0;  ///< bit i: body i, deeper than a scratch
  double far_exit_mm = 0.0;          ///< the wire's tip beyond the target's far surface, at most
  std::uint32_t far_exits = 0;
  double follower_exit_mm = 0.0;  ///< likewise, of what ran over the wire
  /// Of its ways out there the one with the shortest way through the target; 0 where there is none.
  double shortest_exit_mm = 0.0;
  bool was_undone = false;
  bool operator==(const Pass&) const = default;
};

/// How near something that turned, or went into a joint, came to a tendon, an artery or a nerve.
/// Harm stays on record whatever is undone.
struct NearStructure {
  std::size_t structure = 0;  ///< its place in CaseData::structures
  double least_mm = 0.0;      ///< surface to surface; negative where it was in it
  bool was_struck = false;
  instruments::InstrumentIndex by = instruments::kNoInstrument;  ///< that came nearest
  bool operator==(const NearStructure&) const = default;
};

/// Where a scope looked from, when that changed.
struct ScopeLook {
  Vec3 eye;   ///< frame Patient [mm]
  Vec3 axis;  ///< unit
  double traction_n = 0;
  double flexion_rad = 0;
  double radial_deviation_rad = 0;
  double pronation_rad = 0;
  std::uint8_t joint = 0;  ///< in ArthroscopicMap::joints
  bool operator==(const ScopeLook&) const = default;
};

enum class Scuffing : std::uint8_t { Pressed = 0, Bitten = 1, Shaved = 2 };

/// Where cartilage was scuffed.
struct CartilageScuff {
  Tick tick = 0;  ///< when it began
  std::uint8_t body = kNoBody;
  Vec3 at;             ///< on the bone's surface, frame Bone of `body` [mm]
  double force_n = 0;  ///< the most while it was pressed there; 0 of jaws and blades
  instruments::InstrumentIndex by = instruments::kNoInstrument;
  Scuffing how = Scuffing::Pressed;
  bool operator==(const CartilageScuff&) const = default;
};

/// The way over which a movement is judged [E]: a joint gives 15 mm to go in and out.
inline constexpr double kStretchMm = 5.0;
/// Dimensionless jerk of a minimum-jerk reach: 720 / 1.875^2 [flash1985coordination].
inline constexpr double kLeastJerk = 204.8;

/// Dimensionless jerks of an instrument's stretches (simulation/detail/smoothness.hpp), multiplied:
/// `product` times 2 to the `octaves`.
struct SmoothnessFacts {
  double product = 1.0;  ///< in [1, 2)
  std::uint32_t octaves = 0;
  std::uint32_t stretches = 0;
  bool operator==(const SmoothnessFacts&) const = default;
};

/// What an arthroscopy left to be judged.
struct ScopeRecord {
  ScopeFacts facts;                      ///< at the end
  std::array<double, kHands> path_mm{};  ///< of the scope's tip and the other's, in the joint
  std::uint32_t entries = 0;             ///< of the scope into the joint
  std::uint32_t pull_outs = 0;  ///< times that the scope had to go back in by the portal it left
  Tick looking_ticks = 0;       ///< with the scope in the joint
  Tick tilted_ticks = 0;        ///< of these, with the horizon off by more than 15 degrees
  Tick warn_ticks = 0;          ///< pressed with more than 3 N in the joint
  Tick injury_ticks = 0;        ///< more than 8 N
  double most_force_n = 0;
  double least_cosine = 1;  ///< of half the scope's field
  cases::Grades truth{};    ///< of an examination, by finding (data/pathology.json)
  cases::Grades answers = cases::not_judged();
  FluidFacts fluid;           ///< of a procedure that declares it
  std::uint32_t lesions = 0;  ///< that there are
  std::uint32_t lesions_seen = 0;
  std::vector<ScopeLook> looks;
  std::array<SmoothnessFacts, kHands> smoothness{};  ///< as path_mm
  std::vector<CartilageScuff> scuff_places;          ///< the first of them
  std::uint32_t scuffs = 0;
  std::uint32_t capsule_pushes = 0;  ///< of the scope, with more than 3 N, across from its portal
};

/// One operation, finished or not.
struct OperationRecord {
  std::vector<LineFacts> lines;  ///< that lie in bone at the end, in hand or not
  std::vector<Pass> passes;
  std::vector<Shot> shots;
  std::vector<NearStructure> structures;  ///< one each of the case's
  double gauge_reading_mm = -1.0;         ///< last reading, -1 for none
  double reamed_mm = 0.0;                 ///< greatest depth of a reamer along its wire
  double holding_share = 1.0;       ///< of a screw in untouched bone [1] (instruments/…holding)
  FractureFacts fracture_at_first;  ///< before anything was done
  FractureFacts fracture;           ///< at the end
  Judgement judgement = Judgement::None;
  /// By body, where it lies beside where the wrist's motion takes it; empty while none was moved.
  std::vector<Pose<frame::Bone, frame::Bone>> displacements;
  double compression_n = 0.0;         ///< of the pieces on each other, by the screw
  std::uint32_t stripped_screws = 0;  ///< whose thread gave way, undone or taken out or not
  std::optional<ScopeRecord> scope;   ///< of an arthroscopy
  std::optional<MakingFacts> making;  ///< of a procedure that makes portals
  double most_bend_rad = 0.0;         ///< by which any wire was bent for good
  std::uint32_t broken_wires = 0;
  std::uint32_t undos = 0;
  std::uint8_t aids = 0;              ///< bit i: Aid i was used
  std::uint32_t aids_used = 0;        ///< how often any was
  Tick ticks = 0;                     ///< duration
  std::uint32_t completed_steps = 0;  ///< bit i: step i
  /// By step, when it was first done, undone since or not; 0: never.
  std::vector<Tick> first_done;
  double unheld_ream_mm = 0.0;  ///< greatest depth of a reamer over a wire not out at both ends
  bool finished = false;
  std::uint8_t declined_for = 0;  ///< bit i: Procedure::decline.reasons[i]; 0: not declined
};

}  // namespace carpus::procedure
