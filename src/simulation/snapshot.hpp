// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What one tick leaves to be seen, felt and recorded. Plain bytes: it crosses threads by copy.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "core/units.hpp"
#include "geometry/vec3.hpp"
#include "procedure/step.hpp"

namespace carpus::simulation {

/// What the hand holds. None: the screw is seated and lies alone, driver and guide wire are out;
/// `WireState` then still tells the line on which the screw lies.
enum class Instrument : std::uint8_t { GuideWire = 0, ScrewDriver = 1, None = 2 };

/// Contact of the instrument's tip with bone.
struct TipContact {
  bool touching = false;
  std::uint8_t label = 0;    ///< bone label (anatomy/bone_id.hpp) that is touched, 0 when none
  double depth_mm = 0.0;     ///< how far the hand's target lies beyond the surface
  Vec3 normal_in_patient{};  ///< outward surface normal
  bool operator==(const TipContact&) const = default;
};

/// The guide wire as it lies.
struct WireState {
  bool engaged = false;         ///< its tip is in bone, so its line is fixed
  Vec3 entry_in_patient{};      ///< where it entered the scaphoid's surface [mm]
  Vec3 tip_in_patient{};        ///< [mm]
  Vec3 direction_in_patient{};  ///< unit vector from the entry towards the tip
  double depth_mm = 0.0;        ///< from the entry to the tip, along the wire
  std::uint32_t passes = 0;     ///< how often bone was entered anew
  double tip_hu = 0.0;          ///< density at the tip, from the CT
  std::uint8_t tip_label = 0;   ///< bone in which the tip is, 0 in soft tissue or a gap
  bool operator==(const WireState&) const = default;
};

/// The screw, once chosen.
struct ScrewState {
  std::int32_t index = -1;  ///< in the catalogue, -1 when none is chosen
  double length_mm = 0.0;
  double advance_mm = 0.0;  ///< depth of its tip below the entry point, along the wire
  double buried_mm =
      0.0;  ///< depth of its tail below the bone's surface; negative while it stands out
  bool operator==(const ScrewState&) const = default;
};

/// Kinds of things worth a line in the log.
enum class EventKind : std::uint8_t {
  None = 0,
  TouchedBone = 1,   ///< detail: label
  WireEngaged = 2,   ///< detail: label
  WireLeftBone = 3,  ///< the tip came out of the far side; detail: label that it left
  WireWithdrawn = 4,
  ShotTaken = 5,      ///< detail: number of the shot
  Measured = 6,       ///< value: mm
  ScrewSelected = 7,  ///< detail: index
  ScrewSeated = 8,    ///< tail level with the surface for the first time; value: buried mm
  StepCompleted = 9,  ///< detail: step
  Undone = 10,
  Finished = 11,
  Refused = 12,    ///< a command that makes no sense now; detail: CommandKind
  WrongBone = 13,  ///< the wire entered a bone that is not the scaphoid; detail: label
  Slipped = 14,    ///< the turning tip slipped along a surface it met too flat; detail: label
};

struct Event {
  EventKind kind = EventKind::None;
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
  procedure::Step step = procedure::Step::Survey;
  std::uint32_t completed_steps = 0;  ///< bit i: Step i was done
  Instrument instrument = Instrument::GuideWire;
  Vec3 tip_in_patient{};           ///< where the instrument really is, after contact [mm]
  Vec3 shaft_in_patient{0, 0, 1};  ///< unit, from the tip towards the hand
  TipContact contact;
  Vec3 force_in_patient{};    ///< on the hand [N]
  double resistance_n = 0.0;  ///< of the bone against wire or screw, along the shaft [N]
  WireState wire;
  ScrewState screw;
  double measured_mm = -1.0;  ///< last reading of the depth gauge, -1 before any
  std::uint32_t shots = 0;
  std::uint32_t undos = 0;
  std::array<Event, kMaxEventsPerTick> events{};
  std::uint8_t event_count = 0;
  bool finished = false;
};
static_assert(std::is_trivially_copyable_v<Snapshot>);

}  // namespace carpus::simulation
