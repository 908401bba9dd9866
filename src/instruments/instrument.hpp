// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// An instrument, defined once (data/instruments.json, data/screws.json): its shape for contact, how
// it is held and moves, what it does to bone, how it is drawn and how it shows in the beam.
// Frame Tool throughout: the foremost point is the origin, +z runs along the shaft towards the
// hand.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/instrument_shape.hpp"
#include "geometry/vec3.hpp"

namespace carpus::instruments {

/// What it does to bone when it is driven.
enum class Work : std::uint8_t {
  None = 0,    ///< touches only: probe, sleeve, gauge
  Drill = 1,   ///< cuts its own way and keeps to it: a wire
  Ream = 2,    ///< widens the way of the wire on which it rides
  Thread = 3,  ///< screws itself in over the wire on which it rides
};

/// Who turns it.
enum class Drive : std::uint8_t { None = 0, Powered = 1, ByHand = 2 };

/// How fast it goes on: 0 below the resistance, then linear in what is pushed beyond it.
struct Feed {
  double bite_n = 0.0;            ///< thrust that it needs even in soft tissue [N]
  double resistance_share = 1.0;  ///< of a 1.14 mm wire's resistance in the same bone
  double mm_per_s_per_n = 0.0;    ///< speed gained by each newton above the resistance
  double fastest_mm_per_s = 0.0;
  double back_mm_per_s = 0.0;  ///< in reverse
};

enum class Material : std::uint8_t { Steel = 0, Titanium = 1, Handle = 2, Black = 3, Glove = 4 };

/// One round part, for the eye: a cone or cylinder about its axis, smooth or threaded.
struct DrawnPart {
  double from_mm = 0.0;  ///< along its axis
  double to_mm = 0.0;
  double radius_mm = 0.0;  ///< at from_mm; of a thread the outer one
  double end_radius_mm = 0.0;
  bool is_threaded = false;
  double pitch_mm = 0.0;      ///< of a thread at from_mm, crest to crest
  double end_pitch_mm = 0.0;  ///< at to_mm
  Material material = Material::Steel;
  bool only_in_hand = false;  ///< of what holds it: gone once it is let go
  Vec3 origin_mm{};           ///< its axis starts here …
  Vec3 axis{0, 0, 1};         ///< … and runs this way: a pistol's grip lies across the shaft
  std::array<double, 2> squash{1, 1};  ///< scales across the axis: a grip is no cylinder
};

/// One rod of metal, for the beam.
struct BeamRod {
  double from_mm = 0.0;
  double to_mm = 0.0;
  double radius_mm = 0.0;  ///< at from_mm; of a thread over its crests
  double end_radius_mm = 0.0;
  double bore_radius_mm = 0.0;
  double thread_depth_mm = 0.0;  ///< crest minus root
  double thread_pitch_mm = 1.0;
  Material material = Material::Steel;
  bool only_in_hand = false;
};

/// Of a scope.
struct Optic {
  double view_angle_deg = 30.0;  ///< of its line of sight from the shaft
  double field_deg = 80.0;       ///< across its round picture
};

/// Of a shaver: where it cuts while it is driven forward. It lies on the shaft's side.
struct Mouth {
  double behind_mm = 1.0;  ///< its middle behind the tip
  double reach_mm = 1.0;   ///< so near to there it draws tissue in
};

/// Of a punch: what its jaws take at once as they close.
struct Bite {
  double behind_mm = 1.0;  ///< the middle of the open jaws behind the tip
  double reach_mm = 1.0;   ///< so near to there what they close on lies between them
  double width_mm = 2.0;   ///< across what one bite takes
};

/// What it does to closed skin and to what lies under it.
enum class SkinWork : std::uint8_t {
  Palpate = 0,  ///< a fingertip
  Mark = 1,     ///< leaves ink
  Needle = 2,   ///< goes through skin and capsule by its point
  Incise = 3,   ///< cuts the skin where it is led
  Spread = 4,   ///< blunt, opens the way under a cut while it is driven forward
  Sheath = 5,   ///< blunt, goes into the joint by that way
};
inline constexpr std::size_t kSkinWorks = 6;

/// How skin and what lies under it hold it back.
struct SkinTool {
  SkinWork work = SkinWork::Palpate;
  double gives_share = 0.0;  ///< of the way by which a hand presses, skin goes along
  double skin_n = 0.0;       ///< that goes through skin; 0: it does not, without a cut
  double way_n = 0.0;        ///< against it on its way, both ways
  double unspread_n = 0.0;   ///< besides, where nothing was spread for it
  double capsule_n = 0.0;    ///< that goes through the capsule
  double reaim_mm = 0.0;     ///< until it is so deep its line can be changed
};

struct Instrument {
  std::string id;                         ///< stable, snake_case: "guide_wire", "acutrak_2_mini_24"
  std::string name;                       ///< for people: "Guide wire 1.14 mm"
  std::string use;                        ///< what it is for, one sentence
  std::string mark;                       ///< where its measures come from: "[S1]", "[K]", "[E]"
  InstrumentShape shape{CapsuleShape{}};  ///< what of it can meet tissue
  double length_mm = 0.0;                 ///< over all, tip to tail; what a gauge subtracts from
  Work work = Work::None;
  Drive drive = Drive::None;
  Feed feed;
  double cut_tip_radius_mm = 0.0;   ///< of the hole that it leaves, at its tip …
  double cut_tail_radius_mm = 0.0;  ///< … and cut_length_mm behind it (core of a screw's thread)
  double cut_length_mm = 0.0;       ///< further back the hole is as wide as there
  double bore_radius_mm = 0.0;      ///< rides on wires up to this radius; 0: it has no bore
  bool is_sleeve = false;           ///< a wire may be led through its bore
  bool is_gauge = false;            ///< reads how much of a wire is beyond its foot
  bool stays = false;               ///< let go in bone, it stays there
  bool is_joystick = false;         ///< a fragment goes where a hand takes it by this
  bool enters_joints = false;       ///< through a portal, where it pivots; nowhere else
  bool has_jaws = false;            ///< which close driven forward, and open in reverse: it grasps
  std::optional<Mouth> mouth;       ///< of a shaver
  std::optional<Bite> bite;         ///< of a punch, which has jaws
  std::optional<Optic> optic;       ///< of a scope
  std::optional<SkinTool> skin;     ///< of what works on closed skin
  bool is_double_pointed = false;   ///< may be held and drawn by either end
  double gauge_step_mm = 0.0;       ///< of its scale
  std::vector<DrawnPart> parts;
  std::vector<BeamRod> rods;
  double closing_share = 0.0;     ///< of a screw's way by which it draws pieces together
  std::string family;             ///< of a screw: "acutrak_2_mini"; else empty
  double tip_diameter_mm = 0.0;   ///< of a screw, over its thread
  double tail_diameter_mm = 0.0;  ///< of a screw
  bool is_confirmed = false;      ///< measures checked against the maker's guide
};

/// Place in catalogue(): how Input, State and recordings of one program name an instrument. What is
/// stored or sent names it by id.
using InstrumentIndex = std::uint8_t;
inline constexpr InstrumentIndex kNoInstrument = 255;

/// All instruments, at most 255: data/instruments.json, then the screws of data/screws.json by
/// family and length, then what enters joints, works on skin, and bites. Read once, on the first
/// call.
/// @throws InvalidInput naming file and field when the built-in data are wrong.
[[nodiscard]] std::span<const Instrument> catalogue();

/// Empty when no instrument has this id.
[[nodiscard]] std::optional<InstrumentIndex> instrument_of(std::string_view id);

/// Reads instruments and families of screws from JSON text (format: data/README.md); `file` names
/// it in errors. For the catalogue and for tests.
/// @throws InvalidInput "instruments.json: guide_wire: shape: radius_mm is missing".
[[nodiscard]] std::vector<Instrument> read_instruments(std::string_view json,
                                                       std::string_view file);

/// Thrust [N] that the instrument needs to go on where a wire of 1.14 mm meets `wire_n`.
[[nodiscard]] constexpr double resistance_n(const Feed& feed, double wire_n) noexcept {
  return feed.bite_n + feed.resistance_share * wire_n;
}

/// Speed [mm/s] at which it goes on under this thrust; 0 below the resistance.
[[nodiscard]] constexpr double speed_mm_per_s(const Feed& feed,
                                              double thrust_n,
                                              double resistance) noexcept {
  return std::clamp(feed.mm_per_s_per_n * (thrust_n - resistance), 0.0, feed.fastest_mm_per_s);
}

}  // namespace carpus::instruments
