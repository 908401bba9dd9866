// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What makes and tells a joint in which much happens at once: hands that lean on what they meet, a
// pull at the fingers that is not quite still, what is in contact and what yields. Pure.
#pragma once

#include <cstddef>
#include <vector>

#include "geometry/vec3.hpp"
#include "simulation/snapshot.hpp"

namespace carpus::cli {

/// Of a course of ticks those at which something happened, and those near them.
class TicksAbout {
 public:
  TicksAbout(std::size_t before, std::size_t after) : before_(before), after_(after) {}
  /// The next tick of the course.
  void add(float us, bool happened);
  [[nodiscard]] const std::vector<float>& at() const noexcept { return at_; }
  /// Those of at() too, each tick once.
  [[nodiscard]] const std::vector<float>& about() const noexcept { return about_; }

 private:
  std::size_t before_;
  std::size_t after_;
  std::size_t left_ = 0;  ///< ticks after the last one that are still near
  std::vector<float> waiting_;
  std::vector<float> at_;
  std::vector<float> about_;
};

/// A hand that presses on what it meets one way, about as hard as a light hand does; it lets go
/// where it is not wanted to. From the snapshots alone.
class Leaning {
 public:
  /// By how much the hand is to be led off where it would be [mm].
  [[nodiscard]] Vec3 next(const simulation::Snapshot& now,
                          std::size_t hand,
                          const Vec3& way,
                          bool is_wanted);

 private:
  double by_mm_ = 0.0;
};

/// Pull at the fingers [N], as a hand holds it that is not quite still: at least `least_n`, for
/// bones that come together wedge a scope.
[[nodiscard]] double unsteady_traction_n(double least_n, double seconds) noexcept;

/// In a joint, held back by bone, wall or a sheet that yields.
[[nodiscard]] bool is_in_contact(const simulation::Snapshot& now, std::size_t hand) noexcept;

/// Whether the disc moves, and how many of the ligaments that yield.
[[nodiscard]] bool is_disc_moving(const simulation::Snapshot& now) noexcept;
[[nodiscard]] std::size_t moving_ligaments(const simulation::Snapshot& now) noexcept;

}  // namespace carpus::cli
