// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A punch bites as its jaws close, once: what lies nearest to their middle and what stands about
// that comes off at once. Pure.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "geometry/vec3.hpp"
#include "instruments/instrument.hpp"
#include "procedure/punching.hpp"
#include "procedure/situation.hpp"
#include "simulation/detail/operation_state.hpp"
#include "simulation/input.hpp"
#include "simulation/snapshot.hpp"

namespace carpus::simulation::detail {

/// Of procedures with a punch on their tray alone.
struct PunchState {
  std::array<bool, procedure::kHands> are_closed{};  ///< jaws
  std::array<ScuffView, kMaxScuffs> scuffs{};        ///< the first `scuff_count`
  std::uint8_t scuff_count = 0;
  procedure::PunchFacts done;
};

template <Is<PunchState> SomeState, typename Visitor>
void visit(SomeState& state, Visitor&& v) noexcept {
  for (auto& is_closed : state.are_closed) v(is_closed);
  for (auto& scuff : state.scuffs) {
    v(scuff.joint);
    v(scuff.at_as_scanned);
  }
  v(state.scuff_count);
  v(state.done.bites);
  v(state.done.unseen);
  v(state.done.empty);
  v(state.done.cartilage);
  v(state.done.lining);
}

/// Whether a tick could have left it. @param joints  how many the case has
[[nodiscard]] bool is_possible(const PunchState& state, std::size_t joints) noexcept;

/// Whether jaws are closed after a tick. They stay as they are while nothing is heard of the hand.
/// @param has_jaws  of what the hand holds; without any nothing is closed
[[nodiscard]] bool are_closed_after(bool were_closed, bool has_jaws, Driver wished) noexcept;

/// The middle of the open jaws. @param shaft  unit, from the tip towards the hand
[[nodiscard]] Vec3 jaws_middle(const instruments::Bite& bite,
                               const Vec3& tip,
                               const Vec3& shaft) noexcept;

/// How far a piece of tissue is from there: a post of that radius and height; 0 within it [mm].
[[nodiscard]] double from_jaws_mm(const Vec3& middle,
                                  const Vec3& base,
                                  const Vec3& inwards,
                                  double height_mm,
                                  double radius_mm) noexcept;

enum class Bitten : std::uint8_t { Nothing, Tissue, Cartilage, Lining };

/// What the jaws close on: of tissue that comes off and cartilage the nearer one, else what lines
/// the joint, each if within the bite's reach. Distances from the jaws' middle [mm].
[[nodiscard]] Bitten bitten(const instruments::Bite& bite,
                            double tissue_mm,
                            double cartilage_mm,
                            double lining_mm) noexcept;

/// A bite is counted. @param is_seen  its jaws, by the scope
void count_bite(procedure::PunchFacts& done, Bitten what, bool is_seen) noexcept;

/// Cartilage is scuffed there for good; of more than are kept the places are not.
void scuff(PunchState& state, std::uint8_t joint, const Vec3& at) noexcept;

}  // namespace carpus::simulation::detail
