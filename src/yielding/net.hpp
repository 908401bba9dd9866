// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What does not change of a sheet of soft tissue that yields: some hundred particles, where they
// rest and what holds them. Made by net_of_sheet.hpp (all of it on one body) or net_of_band.hpp
// (between two); moved by net_state.hpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/vec3.hpp"

namespace carpus::yielding {

inline constexpr std::size_t kMaxParticles = 160;
/// A net between two bodies has at most so many: four a particle.
inline constexpr std::size_t kMaxSprings = 4 * kMaxParticles;

class Net {
 public:
  struct Particle {
    Vec3 scanned;  ///< where it lies as scanned, before anything is wrong with it
    Vec3 rest;     ///< where it rests as the bodies were scanned: off that where it bulges
    Vec3 normal;   ///< unit, towards the side that is touched
    bool is_held = false;
    double second_share = 0;         ///< of the second body's motion that it goes with, 0 to 1
    double foundation_mm_per_n = 0;  ///< compliance of what lies under it; 0: nothing does
  };
  /// Pulls and pushes along; what is under tension also draws its ends level with each other, as
  /// they rest.
  struct Spring {
    std::uint16_t a = 0;
    std::uint16_t b = 0;
    double rest_mm = 0;  ///< as scanned
    double compliance_mm_per_n = 0;
    double level_mm_per_n = 0;  ///< its length by its tension; 0: it has none
  };

  Net() = default;
  /// @param mass_g  of a particle. @param damping_per_s  of its speed
  Net(double spacing_mm, double mass_g, double damping_per_s)
      : spacing_mm_(spacing_mm), mass_g_(mass_g), damping_per_s_(damping_per_s) {}

  [[nodiscard]] std::size_t size() const noexcept { return rest_.size(); }
  [[nodiscard]] const std::vector<Vec3>& scanned() const noexcept { return scanned_; }
  [[nodiscard]] const std::vector<Vec3>& rest() const noexcept { return rest_; }
  [[nodiscard]] const std::vector<Vec3>& normals() const noexcept { return normals_; }
  [[nodiscard]] const std::vector<Spring>& springs() const noexcept { return springs_; }
  [[nodiscard]] bool is_held(std::size_t i) const noexcept { return is_held_[i]; }
  [[nodiscard]] double second_share(std::size_t i) const noexcept { return second_share_[i]; }
  [[nodiscard]] double foundation_mm_per_n(std::size_t i) const noexcept {
    return foundation_mm_per_n_[i];
  }
  [[nodiscard]] double spacing_mm() const noexcept { return spacing_mm_; }
  [[nodiscard]] double mass_g() const noexcept { return mass_g_; }
  [[nodiscard]] double damping_per_s() const noexcept { return damping_per_s_; }
  /// Whether some of it goes with a second body: then it has to be laid (NetState::lay).
  [[nodiscard]] bool is_between_two() const noexcept { return is_between_two_; }

  void add(const Particle& particle);
  /// As long as it rests. What is held at both ends needs no spring and gets none.
  /// @param tension_n  with which it is drawn as it rests; 0: with none
  void join(std::size_t a, std::size_t b, double n_per_mm, double tension_n);

 private:
  double spacing_mm_ = 1;
  double mass_g_ = 1;
  double damping_per_s_ = 0;
  bool is_between_two_ = false;
  std::vector<Vec3> scanned_;
  std::vector<Vec3> rest_;
  std::vector<Vec3> normals_;
  std::vector<bool> is_held_;
  std::vector<double> second_share_;
  std::vector<double> foundation_mm_per_n_;
  std::vector<Spring> springs_;
};

}  // namespace carpus::yielding
