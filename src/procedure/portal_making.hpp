// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Making portals through closed skin [clinical: B7]: what a procedure declares of it, and what was
// done. Figures stand in procedure.json, with their marks.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace carpus::procedure {

/// Portals that are made in one operation.
inline constexpr std::size_t kPortalsMade = 2;
/// Along each side of the square about a place within which it counts as felt.
inline constexpr int kCellsAcross = 4;
/// A needle that a scope saw for so long without a break was seen, as a place of the tour is [E].
inline constexpr std::uint32_t kNeedleSeenTicks = 1000;

/// What is felt for before a portal: a bone of ArthroscopicMap::landmarks, or another portal.
struct PortalLandmark {
  std::string portal;
  std::string landmark;
  /// Ids of tendons, arteries and nerves (data/structures.json) beside it, each told how near
  /// anything came.
  std::vector<std::string> endangers = {};
  /// Tendons that are drawn aside as the way is spread: what goes in by it then harms none of them.
  std::vector<std::string> draws_aside = {};
  /// Cut and spread before the needle: it goes in on the ground of the wound.
  bool is_opened_first = false;
  std::string before_needle =
      {};  ///< what to do so, in sentences before those of the needle's step
  /// Farther off its way, on its side of the wrist, lies what a case of an older program lacks:
  /// whether that was harmed nobody can say, and nothing there counts as unharmed.
  std::optional<double> judged_mm = std::nullopt;
  std::string beyond = {};  ///< what lies there: "the median nerve"
};

struct PortalMaking {
  std::string first;                ///< id of the portal that is made first: "3-4"
  std::vector<std::string> second;  ///< of these the seed draws one that the case has
  /// What is asked for, in a sentence with {second} for that one's name: it names no landmark.
  std::string task;
  std::vector<PortalLandmark> landmarks;  ///< one of each
  /// A second portal is asked for only where the case has all that it endangers.
  bool needs_structures = false;
  double touch_n = 0.0;         ///< with less a finger feels nothing
  double bone_mm = 0.0;         ///< bone so near under the skin feels hard
  double deepest_mm = 0.0;      ///< bone below that no finger feels
  double cord_deep_mm = 0.0;    ///< a tendon deeper under the skin is no cord under a finger
  double fascia_mm = 0.0;       ///< tendons lie below it, nerves and arteries do not
  double skin_mm = 0.0;         ///< a cut no deeper is of the skin alone: nothing else lies in it
  double cord_mm = 0.0;         ///< a taut tendon so near to a finger's middle is felt
  double firm_share = 0.0;      ///< of the way to bone a fingertip sinks in until it is firm
  double cell_mm = 0.0;         ///< width of a cell about a place that is felt for
  double cell_s = 0.0;          ///< felt for so long it is felt
  std::uint8_t cells = 0;       ///< of kCellsAcross^2 that are to be felt
  double ink_mm = 0.0;          ///< between two points of ink
  double pass_mm = 0.0;         ///< deeper a needle makes a pass
  double strike_n = 0.0;        ///< pressed harder against bone it is struck
  double in_joint_s = 0.0;      ///< in the joint for so long fluid comes back, or it is in
  double cut_reach_mm = 0.0;    ///< so near to a cut what is blunt slips into it
  double cut_stretch_mm = 0.0;  ///< by which a cut gives, for what is wider
  double spread_s = 0.0;
  double spread_reach_mm = 0.0;  ///< so near to the capsule its tip spreads the way to it
};

/// How a needle or a sheath went in. Against the portal as the case's map has it.
struct WayMade {
  bool is_in = false;         ///< it came into a joint
  double skin_off_mm = 0.0;   ///< where it went through the skin, off the portal's way
  double inner_off_mm = 0.0;  ///< where it came into the joint, likewise
  double tilt_cosine = 1.0;   ///< of the angle to that way, seen from the side of the wrist
  bool operator==(const WayMade&) const = default;
};

/// The cut by which the sheath went in.
struct CutMade {
  double length_mm = 0.0;
  double deepest_mm = 0.0;    ///< below the skin
  double along_cosine = 0.0;  ///< to the limb's axis, 0 across it
  double off_mm = 0.0;        ///< from it to the portal's way, at the skin
  bool operator==(const CutMade&) const = default;
};

/// Bits of PortalMade::out_of_order.
inline constexpr std::uint8_t kCutBeforeNeedle = 1;
inline constexpr std::uint8_t kSheathBeforeSpread = 2;

struct PortalMade {
  /// Cells about the landmark and about the portal's own place that were felt before the first
  /// needle, bit by bit.
  std::uint16_t landmark_felt = 0;
  std::uint16_t place_felt = 0;
  std::uint16_t passes = 0;  ///< of the needle
  std::uint16_t bone_strikes = 0;
  std::uint8_t cuts = 0;  ///< undone or not
  std::uint8_t out_of_order = 0;
  bool is_cut = false;     ///< a cut for it is there
  bool is_spread = false;  ///< ... and was spread down to the capsule
  WayMade needle;          ///< as fluid came back, the last time
  WayMade sheath;          ///< as it came in first
  CutMade cut;
  double overrun_mm = 0.0;  ///< by which the sheath went on beyond the capsule, at most
  /// How far off the portal's way a needle, the blade or the sheath went in at most, on its side of
  /// the wrist.
  double strayed_mm = 0.0;
  /// For so long without a break a scope saw the needle's point in the joint, at most: of the
  /// needle that came in last before the skin was cut.
  std::uint32_t needle_seen_ticks = 0;
  bool operator==(const PortalMade&) const = default;
};

/// By the portal's id; nullptr where none is declared.
[[nodiscard]] inline const PortalLandmark* landmark_of(const PortalMaking& making,
                                                       const std::string& portal) noexcept {
  for (const PortalLandmark& each : making.landmarks) {
    if (each.portal == portal) return &each;
  }
  return nullptr;
}

struct MakingFacts {
  std::array<PortalMade, kPortalsMade> portal{};
  std::array<std::uint8_t, kPortalsMade> asked{};  ///< of the map's portals; 0 in the state
  std::uint8_t made = 0;                           ///< so many are: the sheath is in, or was
  bool operator==(const MakingFacts&) const = default;
};

}  // namespace carpus::procedure
