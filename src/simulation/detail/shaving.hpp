// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A shaver takes tissue away piece by piece: what lies in its mouth while it runs is drawn in and
// cut, the nearest first. Pure.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "cases/tissue_piece.hpp"
#include "geometry/vec3.hpp"
#include "instruments/instrument.hpp"
#include "procedure/shaving.hpp"
#include "procedure/situation.hpp"
#include "simulation/detail/operation_state.hpp"

namespace carpus::simulation::detail {

struct ShavingState {
  /// Of each piece, for how long it was in a running mouth; of ticks_to_cut() it is gone.
  std::array<std::uint16_t, cases::kMaxPieces> cut_ticks{};
  std::array<double, procedure::kHands> mouth_deg{};            ///< as a scope's shaft is turned
  std::array<std::uint32_t, cases::kMaxPatches> patch_ticks{};  ///< since it came into view
  procedure::ShavingFacts done;
};

template <Is<ShavingState> SomeState, typename Visitor>
void visit(SomeState& state, Visitor&& v) noexcept {
  for (auto& ticks : state.cut_ticks) v(ticks);
  for (auto& deg : state.mouth_deg) v(deg);
  for (auto& ticks : state.patch_ticks) v(ticks);
  auto& done = state.done;
  v(done.ill);
  v(done.ill_removed);
  v(done.sound);
  v(done.sound_removed);
  v(done.rim_removed);
  v(done.patches);
  v(done.patches_seen);
  v(done.running_ticks);
  v(done.unseen_ticks);
  v(done.cartilage_ticks);
  v(done.lining_ticks);
  v(done.scope_ticks);
  v(done.way_ticks);
  v(done.ticks_since_cut);
  v(done.seen_since);
}

/// How long a piece takes.
[[nodiscard]] std::uint16_t ticks_to_cut(cases::TissueKind kind) noexcept;
/// 1 while nothing has touched it, 0 once it is gone.
[[nodiscard]] double left_share(const ShavingState& state,
                                std::span<const cases::TissuePiece> pieces,
                                std::size_t i) noexcept;
[[nodiscard]] bool is_gone(const ShavingState& state,
                           std::span<const cases::TissuePiece> pieces,
                           std::size_t i) noexcept;

/// As it is before anything is done.
[[nodiscard]] ShavingState untouched(std::span<const cases::TissuePiece> pieces) noexcept;
/// Whether a tick could have left it.
[[nodiscard]] bool is_possible(const ShavingState& state,
                               std::span<const cases::TissuePiece> pieces) noexcept;

/// Where a shaver cuts.
struct MouthPlace {
  Vec3 at;       ///< its middle, on the shaft's surface
  Vec3 towards;  ///< unit, out of it
};
/// @param level  as of arthroscopy::ScopeHold: at 0 degrees the mouth is turned there
[[nodiscard]] MouthPlace mouth_place(const instruments::Mouth& mouth,
                                     double radius_mm,
                                     const Vec3& tip,
                                     const Vec3& shaft,
                                     double turn_deg,
                                     const Vec3& level) noexcept;

/// How far a piece is from the mouth's middle; kNotBefore where it does not lie before it.
inline constexpr double kNotBefore = 1e9;
[[nodiscard]] double before_mouth_mm(const MouthPlace& mouth,
                                     const Vec3& base,
                                     const Vec3& inwards,
                                     double height_mm,
                                     double radius_mm) noexcept;

/// A tick of cutting. @returns whether the piece came off by it.
bool cut_piece(ShavingState& state,
               std::span<const cases::TissuePiece> pieces,
               std::size_t i) noexcept;
/// All that is left of it at once; nothing where it is gone.
void take_piece(ShavingState& state,
                std::span<const cases::TissuePiece> pieces,
                std::size_t i) noexcept;

}  // namespace carpus::simulation::detail
