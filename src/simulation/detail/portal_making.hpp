// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Portals made through closed skin, in the tick: what the hands feel, what they left on the skin,
// which way was opened. Places on the skin are kept as scanned. Nothing of it is there where the
// procedure makes none.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "geometry/vec3.hpp"
#include "procedure/portal_making.hpp"
#include "simulation/detail/operation_state.hpp"

namespace carpus::simulation::detail {

inline constexpr std::uint8_t kNoCut = 255;

/// A cut of the skin, between its ends.
struct SkinCut {
  Vec3 from;                ///< as scanned
  Vec3 to;                  ///< as scanned
  double deepest_mm = 0.0;  ///< below the skin
  double spread_mm = 0.0;   ///< so deep the way under it was spread
  bool is_spread = false;   ///< ... down to the capsule
  std::uint8_t portal = 0;  ///< for which of those that are asked for
};

/// What of a hand is under the skin.
struct UnderSkin {
  bool is_in = false;
  bool is_deep = false;     ///< counted as a pass
  bool is_through = false;  ///< the capsule
  bool is_told = false;     ///< that it is in the joint
  bool has_struck = false;  ///< bone, since it was drawn back
  bool is_spreading = false;
  bool waits = false;         ///< taken anew: until the hand is outside the skin it stays there too
  std::uint8_t cut = kNoCut;  ///< by which it went in, or that it makes
  std::uint8_t portal = 0;    ///< that was asked for as it went in
  Vec3 entry;                 ///< through the skin, Patient
  Vec3 towards{0, 0, -1};     ///< unit, Patient
  double travel_mm = 0.0;     ///< from the entry
  double capsule_mm = 0.0;    ///< where it went through the capsule
  std::uint32_t ticks = 0;    ///< in the joint, or spreading
  std::uint32_t seen_ticks = 0;  ///< a needle's point, by a scope, without a break
};

/// The way by which a sheath came into a joint first. Frame Bone of the body that the portal goes
/// with.
struct OwnWay {
  Vec3 skin;                ///< [mm]
  Vec3 inwards{0, 0, -1};   ///< unit
  double capsule_mm = 0.0;  ///< from the skin
  std::uint8_t joint = 0;   ///< that it came into: not always the portal's
};

/// What an undo brings back.
struct Worked {
  std::array<Vec3, kMaxInk> ink{};  ///< as scanned
  std::uint8_t ink_count = 0;
  std::array<SkinCut, kMaxCuts> cuts{};
  std::uint8_t cut_count = 0;
  std::array<UnderSkin, kHands> hands{};
};

/// A place that is felt for: in which cell of it a finger is, for how long.
struct FeltPlace {
  std::uint8_t cell = 255;
  std::uint32_t ticks = 0;
};

struct MakingState {
  Worked worked;
  procedure::MakingFacts facts;
  std::array<FeltPlace, 2> felt{};  ///< of the landmark, of the portal's own
  std::array<FeltView, kHands> feels{};
  /// Of the portals that are made; of procedures that go in by them.
  std::array<OwnWay, procedure::kPortalsMade> ways{};
};

template <typename SomeWay, typename Visitor>
void visit_way_made(SomeWay& way, Visitor&& v) noexcept {
  v(way.is_in);
  v(way.skin_off_mm);
  v(way.inner_off_mm);
  v(way.tilt_cosine);
}

template <Is<MakingState> SomeState, typename Visitor>
void visit(SomeState& state, Visitor&& v) noexcept {
  auto& worked = state.worked;
  v(worked.ink_count);
  for (std::size_t i = 0; i < worked.ink_count && i < kMaxInk; ++i) v(worked.ink[i]);
  v(worked.cut_count);
  for (std::size_t i = 0; i < worked.cut_count && i < kMaxCuts; ++i) {
    auto& cut = worked.cuts[i];
    v(cut.from);
    v(cut.to);
    v(cut.deepest_mm);
    v(cut.spread_mm);
    v(cut.is_spread);
    v(cut.portal);
  }
  for (auto& under : worked.hands) {
    v(under.is_in);
    v(under.is_deep);
    v(under.is_through);
    v(under.is_told);
    v(under.has_struck);
    v(under.is_spreading);
    v(under.waits);
    v(under.cut);
    v(under.portal);
    v(under.entry);
    v(under.towards);
    v(under.travel_mm);
    v(under.capsule_mm);
    v(under.ticks);
  }
  for (auto& made : state.facts.portal) {
    v(made.landmark_felt);
    v(made.place_felt);
    v(made.passes);
    v(made.bone_strikes);
    v(made.cuts);
    v(made.out_of_order);
    v(made.is_cut);
    v(made.is_spread);
    visit_way_made(made.needle, v);
    visit_way_made(made.sheath, v);
    v(made.cut.length_mm);
    v(made.cut.deepest_mm);
    v(made.cut.along_cosine);
    v(made.cut.off_mm);
    v(made.overrun_mm);
    v(made.strayed_mm);
  }
  v(state.facts.made);
  for (auto& felt : state.felt) {
    v(felt.cell);
    v(felt.ticks);
  }
}

/// Of procedures that go in by them: the ways, and what a scope saw of the needle.
template <Is<MakingState> SomeState, typename Visitor>
void visit_ways(SomeState& state, Visitor&& v) noexcept {
  for (std::size_t i = 0; i < state.facts.made && i < state.ways.size(); ++i) {
    auto& way = state.ways[i];
    v(way.skin);
    v(way.inwards);
    v(way.capsule_mm);
    v(way.joint);
  }
  for (auto& made : state.facts.portal) v(made.needle_seen_ticks);
  for (auto& under : state.worked.hands) v(under.seen_ticks);
}

/// Whether a tick could have left them.
[[nodiscard]] inline bool are_possible_ways(const MakingState& state, std::size_t joints) noexcept {
  return std::all_of(state.ways.begin(), state.ways.end(), [joints](const OwnWay& way) {
    return way.joint < joints && way.capsule_mm >= 0.0 && squared_length(way.inwards) > 0.0;
  });
}

/// Whether a tick could have left it.
[[nodiscard]] inline bool is_possible(const MakingState& state) noexcept {
  const Worked& worked = state.worked;
  bool is_sound = worked.ink_count <= kMaxInk && worked.cut_count <= kMaxCuts &&
                  state.facts.made <= procedure::kPortalsMade;
  for (std::size_t i = 0; is_sound && i < worked.cut_count; ++i) {
    const SkinCut& cut = worked.cuts[i];
    is_sound = cut.portal < procedure::kPortalsMade && cut.deepest_mm >= 0.0;
  }
  for (const UnderSkin& under : worked.hands) {
    is_sound = is_sound && (under.cut == kNoCut || under.cut < worked.cut_count) &&
               under.portal < procedure::kPortalsMade && under.travel_mm >= 0.0;
  }
  return is_sound;
}

}  // namespace carpus::simulation::detail
