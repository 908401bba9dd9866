// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How far the exercises with a scope have come (procedure::ScopeDrill), tick by tick. Nothing of it
// is there where a procedure declares none.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "cases/arthroscopic_map.hpp"
#include "geometry/vec3.hpp"
#include "procedure/scope_drill.hpp"
#include "simulation/detail/operation_state.hpp"

namespace carpus::simulation::detail {

using DrillPlaces = std::array<Vec3, procedure::kMaxDrillPlaces>;
inline constexpr std::uint8_t kNothingTouched = 0;

struct DrillState {
  procedure::DrillFacts done;
  std::uint32_t hold_ticks = 0;      ///< for which the place that is asked for was kept
  std::uint32_t off_hold_ticks = 0;  ///< for which it was not, since it last was
  Vec3 held_from;                    ///< where the scope's tip was when that began
  Vec3 round_from;                   ///< ... when it last moved away from where it was
  std::uint32_t round_bits = 0;      ///< places seen from there, by number
  double round_turn_deg = 0;
  double last_turn_deg = 0;
  std::uint8_t touches = kNothingTouched;  ///< the place that is touched now
  double line_at_mm = 0;                   ///< so far along the line
  double line_share = 0;                   ///< ... of all of it
  std::uint32_t off_line_ticks = 0;
  Vec3 last_probe;
  bool was_probing = false;
  bool is_probe_seen = false;  ///< looked at now and then
};

template <Is<DrillState> SomeState, typename Visitor>
void visit(SomeState& state, Visitor&& v) noexcept {
  auto& done = state.done;
  v(done.held);
  v(done.hold_breaks);
  v(done.round_most);
  v(done.is_round_done);
  v(done.touched);
  v(done.are_touches_done);
  v(done.wrong_touches);
  v(done.line_share);
  v(done.is_line_done);
  v(done.line_breaks);
  v(done.seen_path_mm);
  v(done.unseen_path_mm);
  v(state.hold_ticks);
  v(state.off_hold_ticks);
  v(state.held_from);
  v(state.round_from);
  v(state.round_bits);
  v(state.round_turn_deg);
  v(state.last_turn_deg);
  v(state.touches);
  v(state.line_at_mm);
  v(state.line_share);
  v(state.off_line_ticks);
  v(state.last_probe);
  v(state.was_probing);
  v(state.is_probe_seen);
}

/// What a tick sees of a scope in a joint. Frame Patient [mm].
struct DrillLook {
  Vec3 tip;                          ///< of the scope
  bool is_level = false;             ///< the picture, within what counts as level
  bool has_in_middle = false;        ///< the place that is to be held, nothing before it
  std::uint32_t places_in_view = 0;  ///< for some time, by number
  double shaft_turn_deg = 0;
};

/// ... of what works beside it.
struct DrillProbe {
  Vec3 tip;
  bool touches = false;
};

/// Where in a case the places of a drill are, made before the exercise.
struct DrillPlan {
  using Points = std::array<std::uint8_t, procedure::kMaxDrillPlaces>;
  Points hold{};  ///< in ArthroscopicMap::points
  Points touch{};
  Points line{};
  double middle_cosine = 1;
};
/// @throws InvalidInput  where the case lacks one of them.
[[nodiscard]] DrillPlan drill_plan(const procedure::ScopeDrill& drill,
                                   const cases::ArthroscopicMap& map);

/// Where the places are now, in the order in which the drill has them.
struct DrillGround {
  DrillPlaces touch{};
  DrillPlaces line{};
};

/// The scope's exercises: holding, looking round. Real-time.
void watch_look(DrillState& state,
                const procedure::ScopeDrill& drill,
                const DrillLook& look) noexcept;
/// What is held is lost: the scope has come out.
void lose_look(DrillState& state) noexcept;

/// The other hand's: touching in order, following a line; how much of its way was seen. Real-time.
void watch_probe(DrillState& state,
                 const procedure::ScopeDrill& drill,
                 const DrillGround& ground,
                 const DrillProbe& probe) noexcept;
void lose_probe(DrillState& state) noexcept;

/// Of the line [mm].
[[nodiscard]] double length_of_line(const procedure::ScopeDrill& drill,
                                    const DrillPlaces& line) noexcept;

/// Whether a tick could have left it.
[[nodiscard]] bool is_possible(const DrillState& state,
                               const procedure::ScopeDrill& drill) noexcept;

}  // namespace carpus::simulation::detail
