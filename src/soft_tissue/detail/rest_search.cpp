// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "soft_tissue/detail/rest_search.hpp"

#include <algorithm>
#include <cmath>

namespace carpus::soft_tissue::detail {
namespace {

constexpr double kArmMm = 20;  ///< about how far a body's surface is from its middle
constexpr double kLeastDamping = 1e-9;
constexpr double kMostDamping = 1e6;
/// Of the energy: a fall by less is rounding.
constexpr double kRounding = 1e-14;

LeftOver left_over(const Load& load) {
  LeftOver left;
  left.energy = load.energy;
  for (std::size_t b = 1; b < kBodies; ++b) {
    left.force_n = std::max(left.force_n, length(load.force[b]));
    left.moment_nmm = std::max(left.moment_nmm, length(load.moment[b]));
  }
  return left;
}

Vec3 shift_of(const Unknowns& motion, std::size_t body) {
  const std::size_t i = 6 * (body - 1);
  return {motion[i], motion[i + 1], motion[i + 2]};
}

Vec3 turn_of(const Unknowns& motion, std::size_t body) {
  const std::size_t i = 6 * (body - 1) + 3;
  return {motion[i], motion[i + 1], motion[i + 2]};
}

void shorten(Unknowns& motion, double longest_mm) {
  double longest = 0;
  for (std::size_t b = 1; b < kBodies; ++b) {
    longest = std::max(longest, length(shift_of(motion, b)) + kArmMm * length(turn_of(motion, b)));
  }
  if (!(longest > longest_mm)) return;
  for (double& value : motion) value *= longest_mm / longest;
}

}  // namespace

void Stiffness::add_spring(const Unknowns& change, double stiffness) noexcept {
  for (std::size_t row = 0; row < kUnknowns; ++row) {
    if (change[row] == 0) continue;
    for (std::size_t column = 0; column <= row; ++column) {
      values_[row * kUnknowns + column] += stiffness * change[row] * change[column];
    }
  }
}

void Stiffness::add_turning(std::size_t body, const Vec3& arm, const Vec3& newtons) noexcept {
  if (body == kForearm) return;
  // Of -f.(t x (t x r)) / 2: the point's way as its body turns bends towards the middle.
  const std::size_t first = 6 * (body - 1) + 3;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      values_[(first + i) * kUnknowns + first + j] +=
          (i == j ? dot(newtons, arm) : 0.0) - 0.5 * (newtons[i] * arm[j] + arm[i] * newtons[j]);
    }
  }
}

void Stiffness::add_shift(std::size_t body, double n_per_mm) noexcept {
  const std::size_t first = 6 * (body - 1);
  for (std::size_t i = first; i < first + 3; ++i) values_[i * kUnknowns + i] += n_per_mm;
}

bool Stiffness::solve(double damping, const Load& load, Unknowns& motion) const noexcept {
  // Cholesky, in place; then forward and back.
  std::array<double, kUnknowns* kUnknowns> l = values_;
  for (std::size_t i = 0; i < kUnknowns; ++i) {
    const bool is_turn = i % 6 >= 3;
    const double least = is_turn ? kArmMm * kArmMm : 1.0;
    l[i * kUnknowns + i] += damping * (std::abs(at(i, i)) + least);
  }
  for (std::size_t i = 0; i < kUnknowns; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = l[i * kUnknowns + j];
      for (std::size_t k = 0; k < j; ++k) sum -= l[i * kUnknowns + k] * l[j * kUnknowns + k];
      if (i != j) {
        l[i * kUnknowns + j] = sum / l[j * kUnknowns + j];
      } else {
        if (!(sum > 1e-12 * std::abs(at(i, i)))) return false;
        l[i * kUnknowns + i] = std::sqrt(sum);
      }
    }
  }
  for (std::size_t i = 0; i < kUnknowns; ++i) {
    const std::size_t body = i / 6 + 1;
    double sum = i % 6 < 3 ? load.force[body][i % 6] : load.moment[body][i % 6 - 3];
    for (std::size_t k = 0; k < i; ++k) sum -= l[i * kUnknowns + k] * motion[k];
    motion[i] = sum / l[i * kUnknowns + i];
  }
  for (std::size_t i = kUnknowns; i-- > 0;) {
    double sum = motion[i];
    for (std::size_t k = i + 1; k < kUnknowns; ++k) sum -= l[k * kUnknowns + i] * motion[k];
    motion[i] = sum / l[i * kUnknowns + i];
  }
  return true;
}

void add_change(Unknowns& change,
                std::size_t body,
                const Vec3& arm,
                const Vec3& way,
                double factor) noexcept {
  if (body == kForearm) return;
  const Vec3 turn = cross(arm, way);
  const std::size_t first = 6 * (body - 1);
  for (std::size_t i = 0; i < 3; ++i) {
    change[first + i] += factor * way[i];
    change[first + 3 + i] += factor * turn[i];
  }
}

Bodies moved(const Bodies& bodies, const Unknowns& motion) noexcept {
  Bodies next = bodies;
  for (std::size_t b = 1; b < kBodies; ++b) {
    next[b].shift += shift_of(motion, b);
    const Vec3 turn = turn_of(motion, b);
    next[b].rotation =
        rotation_about(normalized_or(turn, {1, 0, 0}), length(turn)) * next[b].rotation;
  }
  return next;
}

LeftOver search_rest(Bodies& bodies,
                     const SearchOptions& options,
                     const LoadAt& load_at,
                     const StiffnessAt& stiffness_at) {
  double damping = 1e-3;
  Load load = load_at(bodies);
  LeftOver left = left_over(load);
  Stiffness stiffness;
  int round = 0;
  while (round < options.most_rounds &&
         (left.force_n > options.force_n || left.moment_nmm > options.moment_nmm)) {
    stiffness.clear();
    stiffness_at(bodies, stiffness);
    bool fell = false;
    for (; !fell && damping < kMostDamping && round < options.most_rounds; ++round) {
      Unknowns motion{};
      if (stiffness.solve(damping, load, motion)) {
        shorten(motion, options.longest_step_mm);
        const Bodies next = moved(bodies, motion);
        const Load tried = load_at(next);
        if (tried.energy < load.energy - kRounding * std::abs(load.energy)) {
          bodies = next;
          load = tried;
          fell = true;
        }
      }
      damping = fell ? std::max(kLeastDamping, damping * 0.2) : damping * 4;
    }
    left = left_over(load);
    if (!fell) break;
  }
  left.rounds = round;
  return left;
}

}  // namespace carpus::soft_tissue::detail
