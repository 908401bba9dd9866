// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The pose of rigid bodies in which an energy is least, by Newton's method with a growing damping:
// of a chain that is slack in its middle, steepest descent needs thousands of rounds.
#pragma once

#include <array>
#include <functional>

#include "soft_tissue/detail/wrist_bodies.hpp"

namespace carpus::soft_tissue::detail {

/// Shift [mm] and small turn [rad] of each body but the forearm, three numbers each.
inline constexpr std::size_t kUnknowns = 6 * (kBodies - 1);
using Unknowns = std::array<double, kUnknowns>;

/// How much more the energy is for a small motion, to the second order; symmetric, the lower half
/// alone.
class Stiffness {
 public:
  void clear() noexcept { values_.fill(0); }
  [[nodiscard]] double at(std::size_t row, std::size_t column) const noexcept {
    return values_[row * kUnknowns + column];
  }
  /// Of a spring whose length changes by `change` for a unit of each unknown.
  void add_spring(const Unknowns& change, double stiffness) noexcept;
  /// Of a force [N] that keeps its direction on a body which turns, `arm` from its middle.
  void add_turning(std::size_t body, const Vec3& arm, const Vec3& newtons) noexcept;
  /// Of a body's shift in any direction.
  void add_shift(std::size_t body, double n_per_mm) noexcept;

  /// The motion that leads to rest if nothing but this holds, its diagonal made stronger by a
  /// share. False where that is not positive: no minimum lies there.
  [[nodiscard]] bool solve(double damping, const Load& load, Unknowns& motion) const noexcept;

 private:
  std::array<double, kUnknowns * kUnknowns> values_{};
};

/// Change of the place of a body's point along `way`, for a unit of each unknown; added.
void add_change(Unknowns& change,
                std::size_t body,
                const Vec3& arm,
                const Vec3& way,
                double factor) noexcept;

[[nodiscard]] Bodies moved(const Bodies& bodies, const Unknowns& motion) noexcept;

/// At rest; what is left over is the greatest force [N] and moment [N mm] on a body.
struct LeftOver {
  double energy = 0;  ///< [N mm]; to compare rests under the same load
  double force_n = 0;
  double moment_nmm = 0;
  int rounds = 0;
};

struct SearchOptions {
  double force_n = 0.05;
  double moment_nmm = 0.5;
  int most_rounds = 400;
  /// Of one round, of any body's surface [mm]: bodies are led, they do not leap.
  double longest_step_mm = 0.7;
};

/// Asked with where bodies lie, it may change what it knows of them: the energy near there must
/// stay the same.
using LoadAt = std::function<Load(const Bodies&)>;
using StiffnessAt = std::function<void(const Bodies&, Stiffness&)>;

/// Leads `bodies` downhill to rest. The same bits each time.
[[nodiscard]] LeftOver search_rest(Bodies& bodies,
                                   const SearchOptions& options,
                                   const LoadAt& load_at,
                                   const StiffnessAt& stiffness_at);

}  // namespace carpus::soft_tissue::detail
