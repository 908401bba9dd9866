// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Bodies that float in a joint's fluid: a ball each, heavier than water by little, driven by the
// inflow of the scope, stopped by walls and instruments. Pure.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "geometry/vec3.hpp"
#include "procedure/loose_removal.hpp"
#include "procedure/situation.hpp"
#include "simulation/detail/operation_state.hpp"

namespace carpus::simulation::detail {

using procedure::kMaxLooseBodies;

struct LooseBody {
  Vec3 at;                      ///< its middle, frame Patient [mm]
  Vec3 velocity;                ///< [mm/s]
  std::uint8_t hand = kNoHand;  ///< in whose jaws it is
  bool is_afloat = false;       ///< something has come into its joint; until then it lies by a bone
  bool is_inside = true;        ///< of its joint, not in the way out
  bool is_out = false;          ///< of the skin, for good
  std::uint8_t portal = procedure::kNoBody;  ///< through which it is being drawn out
};

/// Of bodies so far as there are any.
struct LooseState {
  std::array<LooseBody, kMaxLooseBodies> bodies{};
  std::array<bool, procedure::kHands> are_closed{};  ///< jaws
  procedure::LooseFacts done;
};

template <Is<LooseState> SomeState, typename Visitor>
void visit(SomeState& state, Visitor&& v) noexcept {
  for (auto& body : state.bodies) {
    v(body.at);
    v(body.velocity);
    v(body.hand);
    v(body.is_afloat);
    v(body.is_inside);
    v(body.is_out);
    v(body.portal);
  }
  for (auto& is_closed : state.are_closed) v(is_closed);
  v(state.done.there);
  v(state.done.out);
  v(state.done.closings);
  v(state.done.unseen_closings);
  v(state.done.catches);
  v(state.done.bites);
  v(state.done.slips);
  v(state.done.seen_since);
}

/// Whether a tick could have left it.
[[nodiscard]] bool is_possible(const LooseState& state,
                               std::size_t count,
                               std::size_t portals) noexcept;

/// What acts on a body.
struct LooseSurroundings {
  Vec3 flow;              ///< of the fluid [mm/s]
  Vec3 down;              ///< unit
  bool has_wall = false;  ///< one is near
  double wall_mm = 0.0;   ///< of its middle beyond the wall; negative within the joint
  Vec3 outwards;          ///< unit, out of the joint
};

/// One tick of a body that nothing holds.
void drift(LooseBody& body, double radius_mm, const LooseSurroundings& around) noexcept;

/// A rod pushes it aside.
void push_aside(LooseBody& body,
                double radius_mm,
                const Vec3& from,
                const Vec3& to,
                double rod_radius_mm) noexcept;

/// Of the fluid that runs in along a scope's sheath, at a place.
/// @param shaft  unit, from the tip towards the hand
[[nodiscard]] Vec3 inflow_at(const Vec3& tip, const Vec3& shaft, const Vec3& at) noexcept;

}  // namespace carpus::simulation::detail
