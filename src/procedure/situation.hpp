// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a procedure sees of an operation while it goes on: plain facts that the simulation keeps, in
// words that no single procedure owns. Steps are ticked off, and undone things noticed, by
// predicates on these.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "anatomy/hand_pose.hpp"
#include "anatomy/reduction.hpp"
#include "core/units.hpp"
#include "geometry/vec3.hpp"
#include "instruments/instrument.hpp"
#include "procedure/loose_removal.hpp"
#include "procedure/portal_making.hpp"
#include "procedure/punching.hpp"
#include "procedure/scope_drill.hpp"
#include "procedure/screw_control.hpp"
#include "procedure/shaving.hpp"
#include "procedure/tube_setting.hpp"

namespace carpus::procedure {

inline constexpr std::size_t kHands = 2;
inline constexpr std::size_t kMaxSteps = 32;
inline constexpr std::uint8_t kNoBody = 255;

/// How hand and forearm are held, from the neutral wrist.
using WristPose = anatomy::HandPose;

/// How a look through the C-arm came about.
enum class Look : std::uint8_t {
  Single = 0,  ///< one shot
  Live = 1,    ///< the foot pedal went down
  LiveOn = 2,  ///< it is still down, and another view came up, or more had been done
};

/// Pulses of the tube a second while the pedal is down, and of a single shot: five seconds [E].
inline constexpr std::uint32_t kPulsesPerSecond = 10;
inline constexpr std::uint32_t kPulsesPerShot = 50;

/// One look through the C-arm.
struct Shot {
  double rotation_deg = 0.0;  ///< relative to the forearm as it is held: fluoroscopy/c_arm.hpp,
                              ///< 0 PA, 90 lateral, 45 pronated oblique
  double tilt_deg = 0.0;      ///< towards proximal (positive) or distal
  Tick tick = 0;
  WristPose wrist;
  bool shows_wire = false;   ///< a wire lay in the target then
  bool shows_screw = false;  ///< a screw was seated in the target
  double along_aim = 0.0;    ///< |cos| between beam and the aim's line: 1 looks down it, the ring
  Look look = Look::Single;
  std::uint32_t pulses = kPulsesPerShot;
  TubeSetting tube = kUsualTube;
  bool operator==(const Shot&) const = default;
};

/// An instrument whose line is fixed in bone: a wire, and what rides on it. "Target" is the bone
/// that the procedure operates on, all its fragments and the gap between them.
struct LineFacts {
  instruments::InstrumentIndex instrument = instruments::kNoInstrument;
  std::uint8_t body = kNoBody;  ///< index in CaseData::bones: the frame in which the line is fixed
  bool in_hand = false;
  bool in_target = false;    ///< it entered the target on this line
  Vec3 entry_in_bone{};      ///< where it entered the target, else bone at all [mm]
  Vec3 direction_in_bone{};  ///< unit, from the entry towards the tip
  double depth_mm = 0.0;     ///< tip beyond the entry; of what rides, its own tip
  double chord_mm = 0.0;     ///< of the line inside the target, gap included; 0 outside it
  double from_aim_mm = 0.0;  ///< that entry, from the aim's as its piece lies now
  double buried_mm = 0.0;    ///< a screw's tail below the surface; negative while it stands out
  /// Of a wire, beyond its entry towards the hand; negative when its near end is in the bone.
  double near_end_out_mm = 0.0;
  bool far_end_is_out = false;  ///< a wire's, of the skin beyond the bone
  bool was_flush = false;       ///< it was drawn through until that end lay level with the bone
  bool operator==(const LineFacts&) const = default;
};

/// What a hand holds and touches.
struct HandFacts {
  instruments::InstrumentIndex instrument = instruments::kNoInstrument;
  std::uint8_t touched_body = kNoBody;
  bool touches_target = false;
  bool operator==(const HandFacts&) const = default;
};

/// The line that a procedure is after on a case [mm]: of a bone that is to be reduced first, that
/// of the bone reduced. Steps are told by it and practice shows it; the score measures by itself.
struct Aim {
  /// Index in CaseData::bones of the piece with the entry: all else is in its frame Bone.
  std::uint8_t body = kNoBody;
  Vec3 entry;                    ///< where an instrument should go in
  Vec3 direction{0, 0, 1};       ///< unit, into the bone
  double length_mm = 0.0;        ///< of the longest way through the bone
  double entry_within_mm = 0.0;  ///< of `entry` an entry is right
  double chord_mm = 0.0;         ///< of this line in the bone
  /// The screw for it, and how deep its tail lies; kNoInstrument: none fits.
  instruments::InstrumentIndex screw = instruments::kNoInstrument;
  double screw_tail_mm = 0.0;
};

/// How the fragments of a target in two pieces lie (anatomy/reduction.hpp); whole bones have none.
struct FractureFacts {
  bool is_apart = false;  ///< the target is in two pieces
  double gap_mm = 0.0;    ///< between the middles of their faces, along the first one's normal
  double step_mm = 0.0;   ///< across it
  double cosine_angle = 1.0;
  bool operator==(const FractureFacts&) const = default;
};
[[nodiscard]] constexpr FractureFacts facts_of(const anatomy::FractureOffset& offset) noexcept {
  return {true, offset.gap_mm, offset.step_mm, offset.cosine_angle};
}

/// What was said of the fracture before anything was drilled.
enum class Judgement : std::uint8_t { None = 0, Aligned = 1, Displaced = 2 };

/// What has been done by arthroscopy. A point's bit is its number in the tour.
struct ScopeFacts {
  /// By hand: in CaseData::arthroscopy the portal through which its instrument goes.
  std::array<std::uint8_t, kHands> portal{kNoBody, kNoBody};
  std::array<std::uint8_t, kHands> joint{};  ///< into which that leads, in its joints
  std::array<bool, kHands> is_in_joint{};
  std::uint32_t points_seen = 0;    ///< for a second at a useful distance, nothing before them
  std::uint32_t points_probed = 0;  ///< touched by the probe
  std::uint8_t unanswered = 0;      ///< of what an examination asks
  DrillFacts drill;                 ///< of exercises with a scope
  LooseFacts loose;                 ///< of what floats in the joints
  ShavingFacts shaving;             ///< of what a shaver, or a punch, takes away
  PunchFacts punch;                 ///< of how a punch bit
  ScrewFacts screw;                 ///< of a screw that is controlled
  /// By hand: the number of that portal in data/portals.json, the same in every case.
  std::array<std::uint8_t, kHands> portal_number{kNoBody, kNoBody};
  bool operator==(const ScopeFacts&) const = default;
};

/// Everything so far; spans live as long as the call. Predicates are noexcept, allocate nothing and
/// use only + - * / and sqrt: they run in every tick.
struct Situation {
  Tick tick = 0;
  std::array<HandFacts, kHands> hands{};
  std::span<const LineFacts> lines;  ///< in the order in which they were laid
  std::span<const Shot> shots;
  /// Of these, those since the step before the one that is asked for was last completed.
  std::span<const Shot> recent_shots;
  std::uint32_t completed_steps = 0;
  /// Last one; -1 before any, and again once neither wire nor screw lies in the target: what was
  /// read is gone.
  double gauge_reading_mm = -1.0;
  double reamed_mm = 0.0;  ///< greatest depth of a reamer along its wire, from the entry
  WristPose wrist;
  FractureFacts fracture;
  Judgement judgement = Judgement::None;
  Aim aim;
  ScopeFacts scope;
  MakingFacts making;         ///< of a procedure that makes portals
  bool is_finishing = false;  ///< this is the tick of Finish
};

}  // namespace carpus::procedure
