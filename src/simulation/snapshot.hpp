// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What one tick leaves to be seen, felt and recorded. Plain bytes: it crosses threads by copy.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>

#include "cases/joint_lesions.hpp"
#include "cases/ligament_band.hpp"
#include "cases/prepared_pathology.hpp"
#include "core/units.hpp"
#include "geometry/pose.hpp"
#include "geometry/vec3.hpp"
#include "procedure/mode.hpp"
#include "simulation/input.hpp"
#include "yielding/net.hpp"

namespace carpus::simulation {

using procedure::kNoBody;

inline constexpr std::size_t kMaxBodies = 32;
inline constexpr std::size_t kMaxItems = 12;   ///< instruments in hands or in the body at once
inline constexpr std::size_t kMaxTracks = 64;  ///< holes that are told one by one
inline constexpr std::uint8_t kNoItem = 255;
inline constexpr std::uint8_t kNoHand = 255;

/// An instrument that is out of the tray.
struct ItemView {
  InstrumentIndex instrument = kNoInstrument;  ///< kNoInstrument: this place is empty
  std::uint8_t hand = kNoHand;                 ///< that holds it
  std::uint8_t body = kNoBody;     ///< in which its line is fixed, kNoBody while it is free
  std::uint8_t wire = kNoItem;     ///< item on which it rides
  Vec3 tip_in_patient{};           ///< where it really is, after contact [mm]
  Vec3 shaft_in_patient{0, 0, 1};  ///< unit, from the tip towards the hand
  bool in_target = false;
  std::uint8_t tip_body = kNoBody;  ///< body in which its tip is
  double tip_hu = 0.0;              ///< density at its tip, of what is left
  Vec3 entry_in_patient{};          ///< of its line, while it is fixed
  double depth_mm = 0.0;            ///< tip beyond the entry
  double buried_mm = 0.0;           ///< screw: tail below the surface
  double length_mm = 0.0;           ///< tip to tail, of what is left of it
  bool by_far_end = false;          ///< its hand holds it beyond the bone
  bool near_end_is_out = false;     ///< of the skin, so that a hand can take it there
  bool far_end_is_out = false;
  double bend_rad = 0.0;                 ///< of what stands out where it went in ...
  double bent_at_mm = 0.0;               ///< ... from so far behind its tip on
  Vec3 outer_shaft_in_patient{0, 0, 1};  ///< unit, of that part; the shaft while it is straight
  bool operator==(const ItemView&) const = default;
};

/// Bone before the foremost point of a free instrument: for devices that render it by themselves,
/// so that it is there before it is touched. Follows from the state, is none of it.
struct SurfaceAhead {
  std::uint8_t body = kNoBody;  ///< kNoBody: none near, or a hole is
  double gap_mm = 0.0;
  Vec3 normal_in_patient{};   ///< unit, out of the bone
  double facing_mm = kFarMm;  ///< from the surface to another bone that faces it
  static constexpr double kFarMm = 100.0;
  bool operator==(const SurfaceAhead&) const = default;
};

/// What a hand feels.
struct HandView {
  std::uint8_t item = kNoItem;
  bool touching = false;  ///< its free instrument touches bone
  std::uint8_t touched_body = kNoBody;
  double contact_depth_mm = 0.0;  ///< how far the hand's wish lies beyond where the tip is
  Vec3 contact_normal_in_patient{};
  Vec3 force_in_patient{};    ///< on the hand [N]
  double resistance_n = 0.0;  ///< of bone along the shaft [N]
  double thrust_n = 0.0;      ///< with which it pushes along the shaft [N]
  double torque_n_mm = 0.0;   ///< that turning a screw takes
  SurfaceAhead ahead;
  bool operator==(const HandView&) const = default;
};

/// A body that floats in a joint.
struct LooseView {
  std::uint8_t lesion = 0;      ///< its place in World::lesions
  std::uint8_t hand = kNoHand;  ///< in whose jaws it is
  Vec3 at_in_patient{};         ///< its middle
  bool operator==(const LooseView&) const = default;
};

/// Fluid in the joint that is looked into.
struct FluidView {
  bool is_there = false;  ///< the procedure declares it
  std::uint8_t inflow_steps = 0;
  bool is_outflow_open = true;
  bool is_dry = false;
  bool is_flushing = false;
  double pressure_mmhg = 0.0;
  double haze_per_mm = 0.0;  ///< optical depth, of blood
  double bubbles = 0.0;      ///< share of those that are drawn at most
  double fog_depth = 0.0;    ///< optical depth of mist on the lens
  double smear_depth = 0.0;  ///< of blood on it
  bool operator==(const FluidView&) const = default;
};

/// What a fingertip feels through the skin, where it presses: no more than a finger tells.
enum class Felt : std::uint8_t { Nothing = 0, Soft = 1, Cord = 2, Bone = 3 };
struct FeltView {
  Felt felt = Felt::Nothing;
  double firm_share = 0.0;  ///< 0 gives way, 1 as bone under skin
  bool operator==(const FeltView&) const = default;
};

/// A cut of the skin, where it lies now.
struct CutView {
  Vec3 from_in_patient{};
  Vec3 to_in_patient{};
  bool is_spread = false;
  bool operator==(const CutView&) const = default;
};
inline constexpr std::size_t kMaxInk = 96;
inline constexpr std::size_t kMaxCuts = 8;

/// A portal as it was made. Frame Bone of the body that the portal goes with.
struct OwnWayView {
  std::uint8_t portal = 0;  ///< in ArthroscopicMap::portals
  std::uint8_t joint = 0;   ///< in ArthroscopicMap::joints: the one that it leads into
  Vec3 skin;                ///< [mm]
  Vec3 inwards;             ///< unit
  double capsule_mm = 0.0;  ///< from the skin
  bool operator==(const OwnWayView&) const = default;
};

/// Closed skin that is worked on, of a procedure that makes portals.
struct SkinView {
  bool is_there = false;
  procedure::MakingFacts facts;
  std::array<FeltView, kHands> feels{};
  std::array<Vec3, kHands> on_skin{};      ///< nearest to the tip, Patient
  std::array<Vec3, kHands> out_of_skin{};  ///< unit, there
  std::array<double, kHands> under_mm{};   ///< of the tip along its way, or of a blade's depth
  std::array<bool, kHands> is_wet{};       ///< fluid comes back through the needle
  std::array<bool, kHands> is_spreading{};
  std::array<Vec3, kMaxInk> ink{};  ///< Patient
  std::uint8_t ink_count = 0;
  std::array<CutView, kMaxCuts> cuts{};
  std::uint8_t cut_count = 0;
  Vec3 spot{};      ///< where the portal that is next goes through the skin: an aid shows it
  Vec3 landmark{};  ///< and what is felt for before it, on the skin
  /// Of procedures that go in by the portals that were made.
  std::array<OwnWayView, procedure::kPortalsMade> ways{};
  std::uint8_t way_count = 0;
  bool operator==(const SkinView&) const = default;
};

/// The disc, and ligaments that yield (cases/ligament_band.hpp).
inline constexpr std::size_t kMaxSheets = 1 + cases::kMaxBands;

/// Tissue that yields, as it lies: by how much each particle is off where it was scanned, frame
/// Bone of its first body [mm].
struct SheetView {
  std::array<std::array<float, 3>, yielding::kMaxParticles> off{};
  std::uint16_t count = 0;
  bool is_still = true;
};

/// Where a punch bit cartilage.
struct ScuffView {
  std::uint8_t joint = 0;  ///< in ArthroscopicMap::joints
  Vec3 at_as_scanned{};    ///< on the bone's surface, frame Patient as scanned [mm]
  bool operator==(const ScuffView&) const = default;
};
inline constexpr std::size_t kMaxScuffs = 8;

/// A scope's optics and what has been done with it (arthroscopy/optics.hpp).
struct ScopeView {
  std::uint8_t hand = kNoHand;  ///< that holds one
  double shaft_turn_deg = 0.0;
  double camera_turn_deg = 0.0;
  Vec3 axis_in_patient{0, 0, -1};  ///< where it looks
  Vec3 up_in_patient{0, 1, 0};     ///< of the picture
  procedure::ScopeFacts facts;
  std::uint32_t points_in_view = 0;  ///< now, by their numbers
  std::uint32_t pull_outs = 0;
  std::uint32_t lesions_seen = 0;  ///< bits, in the order of World::lesions
  cases::Grades answers = cases::not_judged();
  std::uint32_t hold_ticks = 0;  ///< for which the place that is to be held was kept
  double line_share = 0.0;       ///< of the line that is followed, at a stretch
  bool is_probe_seen = false;    ///< in exercises with a scope alone
  bool is_level = true;          ///< the picture, within what counts as level
  /// Bodies that float in the joints, the first `loose_count`.
  std::array<LooseView, procedure::kMaxLooseBodies> loose{};
  std::uint8_t loose_count = 0;
  std::array<bool, kHands> are_closed{};  ///< jaws, by hand
  /// Of what a shaver takes away, in the order of World::lesions: of each so many percent are left.
  std::array<std::uint8_t, cases::kMaxPieces> pieces_left{};
  std::uint8_t piece_count = 0;
  std::array<double, kHands> mouth_deg{};  ///< of a shaver, by hand
  std::array<bool, kHands> are_running{};
  std::array<ScuffView, kMaxScuffs> scuffs{};
  std::uint8_t scuff_count = 0;
  FluidView fluid;
  bool operator==(const ScopeView&) const = default;
};

/// Bone that was removed: a round way, tapered, frame Bone of `body`.
struct TrackView {
  std::uint8_t body = kNoBody;
  Vec3 from_in_bone{};
  Vec3 to_in_bone{};
  double from_radius_mm = 0.0;
  double to_radius_mm = 0.0;
  bool operator==(const TrackView&) const = default;
};

/// Kinds of things worth a line in the log.
enum class EventKind : std::uint8_t {
  None = 0,
  TouchedBone = 1,     ///< detail: body
  EnteredBone = 2,     ///< an instrument engaged; detail: body
  LeftFarSide = 3,     ///< the tip came out of the target's far side; value: mm
  Withdrawn = 4,       ///< an instrument came out of bone; detail: instrument
  ShotTaken = 5,       ///< detail: number of the look
  GaugeRead = 6,       ///< value: mm
  Taken = 7,           ///< detail: instrument
  PutDown = 8,         ///< detail: instrument
  Seated = 9,          ///< a screw's tail is level with the surface; value: buried mm
  StepCompleted = 10,  ///< detail: step
  Undone = 11,         ///< detail: the step that it went back to, from 1; 0: the last checkpoint
  Finished = 12,       ///< detail: for which of the procedure's reasons it was declined, bits
  Refused = 13,        ///< a command that makes no sense now; detail: Refusal
  WrongBone = 14,      ///< a bone was entered that is neither target nor allowed; detail: body
  Slipped = 15,        ///< a turning tip slipped along a surface it met too flat; detail: body
  WristStopped = 16,   ///< the wrist came to its limit, or an instrument holds it
  LiveEnded = 17,      ///< the pedal was let go; detail: number of the look, value: s
  WireBent = 18,       ///< bone came against what stands out of it; detail: body, value: degrees
  WireBroke = 19,      ///< likewise, too far; detail: body
  ScrewStripped = 20,  ///< turned on when it was tight, its thread gave way
  AidUsed = 21,        ///< item: in the hand that asked; detail: procedure::Aid
  /// Something turned in a tendon, artery or nerve; detail: its place in the case.
  StructureStruck = 22,
  EnteredJoint = 23,  ///< through a portal; detail: its place in the case's list
  LeftJoint = 24,     ///< likewise
  PointSeen = 25,     ///< detail: its number in the tour
  PointProbed = 26,   ///< likewise
  Judged = 27,        ///< detail: procedure::Judgement
  /// A wire would not go in: its shaft lies in soft tissue where a hand would hold it; detail: body
  ShaftUnderSkin = 28,
  LooseCaught = 29,   ///< a loose body is in the jaws; detail: which
  LooseLost = 30,     ///< it sprang from them, or was stripped off in the way; detail: which
  LooseOut = 31,      ///< it is out of the skin; detail: which
  TissueBitten = 32,  ///< jaws closed on what lines the joint; detail: 1 on cartilage
  /// A shaver ran against what is to stay; detail: 0 lining, 1 cartilage, 2 the scope
  ShaverHarmed = 33,
  SoundTissueShaved = 34,  ///< a piece that was to stay came off; detail: 1 of the disc's rim
  CartilagePressed = 35,   ///< in a joint, with more than 8 N; detail: body, value: N
  /// The scope, across from its portal, with more than 3 N; detail: portal, value: N
  CapsulePushed = 36,
  PressureTooHigh = 40,  ///< of the fluid in the joint; value: mmHg
  TissueSwells = 41,     ///< of what went into it; value: ml
  ViewClouded = 42,      ///< blood or what lies on the lens hides the joint
  ScrewProbed = 50,      ///< a site of a screw, in the scope's sight; detail: cases::ScrewSite
  /// Through a needle that is in a joint; detail: 1 where it came in from another side than the
  /// portal's that is asked for
  FluidBack = 60,
  NeedleStruckBone = 61,  ///< detail: body
  SkinCut = 62,           ///< a cut was begun; detail as of FluidBack
  WaySpread = 63,         ///< down to the capsule
  /// In a joint; detail as of FluidBack, value: by how much it went on beyond the capsule [mm]
  SheathIn = 64,
  HeldBySkin = 65,  ///< what is blunt does not go through it
  NeedleSeen = 66,  ///< its point, by the scope, before the skin was cut
};

struct Event {
  EventKind kind = EventKind::None;
  std::uint8_t item = kNoItem;  ///< whose it is
  InstrumentIndex instrument = kNoInstrument;
  std::int32_t detail = 0;
  double value = 0.0;
  Tick tick = 0;
  bool operator==(const Event&) const = default;
};
inline constexpr std::size_t kMaxEventsPerTick = 8;

/// State after a tick.
struct Snapshot {
  Tick tick = 0;
  std::uint64_t state_hash = 0;
  procedure::Mode mode = procedure::Mode::Practice;
  std::uint64_t seed = 0;  ///< of the exercise
  std::optional<cases::PreparedPathology>
      prepared;                       ///< what is wrong, where that is not the seed's
  std::uint8_t step = 0;              ///< current one; the number of steps when finished
  std::uint32_t completed_steps = 0;  ///< bit i: step i is done
  std::array<HandView, kHands> hands{};
  std::array<ItemView, kMaxItems> items{};
  std::uint8_t body_count = 0;
  std::array<Pose<frame::Patient, frame::Bone>, kMaxBodies> patient_from_bone{};
  WristPose wrist;  ///< as it is held now
  std::array<TrackView, kMaxTracks> tracks{};
  std::uint8_t track_count = 0;
  std::uint32_t tissue_revision = 0;  ///< changes whenever bone does
  double gauge_reading_mm = -1.0;     ///< last reading, -1 before any
  double holding_share = 1.0;         ///< of the screw in the target, of that in untouched bone
  double compression_n = 0.0;         ///< of what the screw holds
  procedure::Judgement judgement = procedure::Judgement::None;
  std::uint32_t passes = 0;      ///< how often bone was entered anew
  CArmInput c_arm;               ///< as it stands; pedal_is_down while it is looked through
  std::uint32_t shots = 0;       ///< kept of all looks: OperationRecord::shots
  std::uint32_t looks = 0;       ///< shots taken and times that the pedal went down
  std::uint32_t pulses = 0;      ///< of the tube in all
  std::uint64_t dose_units = 0;  ///< procedure::dose_units of them
  procedure::TubeSetting tube = procedure::kUsualTube;
  ScopeView scope;
  SkinView skin;
  std::array<SheetView, kMaxSheets> sheets{};  ///< the disc first
  std::uint8_t sheet_count = 0;
  std::uint8_t aids = 0;  ///< bit i: procedure::Aid i was used
  std::uint32_t undos = 0;
  bool can_undo = false;
  std::uint32_t returnable_steps = 0;  ///< bit i: step i is done, and could be done again
  std::array<Event, kMaxEventsPerTick> events{};
  std::uint8_t event_count = 0;
  bool finished = false;
};
static_assert(std::is_trivially_copyable_v<Snapshot>);

}  // namespace carpus::simulation
