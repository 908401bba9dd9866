// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A sheet of soft tissue that yields: some hundred particles held by springs, in fixed memory, by
// extended position-based dynamics [macklin2016xpbd] with several small steps a tick
// [macklin2019small]. Deterministic: + - * / and sqrt alone, one fixed order. Without input its
// energy never grows. Chosen by a measured comparison: docs/decisions/0069.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/triangle_mesh.hpp"
#include "geometry/vec3.hpp"

namespace carpus::yielding {

inline constexpr std::size_t kMaxParticles = 160;

/// How stiff it is [E where nothing else is said].
struct Material {
  double along_n_per_mm = 6.0;         ///< of a spring between neighbours
  double foundation_n_per_mm2 = 0.05;  ///< of what lies under a mm2 of it
  /// More than it weighs, so that a tick's small steps resolve its springs; against a hand it is
  /// nothing still.
  double mass_g_per_mm2 = 0.4;
  double damping_per_s = 60.0;
};

/// What does not change: where the particles rest and what holds them.
class Net {
 public:
  struct Spring {
    std::uint16_t a = 0;
    std::uint16_t b = 0;
    double rest_mm = 0;
    double compliance_mm_per_n = 0;
  };

  Net() = default;
  /// Particles about `spacing_mm` apart on the sheet; those nearer than that to its rim are held.
  /// @param sheet  its middle, turned one way all over. @param towards  the side that is touched.
  Net(const TriangleMesh& sheet, const Vec3& towards, const Material& material, double spacing_mm);

  [[nodiscard]] std::size_t size() const noexcept { return rest_.size(); }
  [[nodiscard]] const std::vector<Vec3>& rest() const noexcept { return rest_; }
  [[nodiscard]] const std::vector<Vec3>& normals() const noexcept { return normals_; }
  [[nodiscard]] const std::vector<Spring>& springs() const noexcept { return springs_; }
  [[nodiscard]] bool is_held(std::size_t i) const noexcept { return is_held_[i]; }
  [[nodiscard]] double spacing_mm() const noexcept { return spacing_mm_; }

  /// A tear: particles within `radius_mm` of the line come off what holds them, foundation and rim.
  /// @param left_share  of the foundation and of the springs there. @param rests_off_mm  by how
  /// much they stand off there.
  void come_off(const Vec3& from,
                const Vec3& to,
                double radius_mm,
                double left_share,
                double rests_off_mm);

 private:
  friend class NetState;
  void join(double left_share);

  double spacing_mm_ = 1;
  double along_mm_per_n_ = 0;
  double mass_g_ = 0;
  double damping_per_s_ = 0;
  std::vector<Vec3> rest_;
  std::vector<Vec3> normals_;
  std::vector<bool> is_held_;
  std::vector<bool> has_come_off_;
  std::vector<double> foundation_mm_per_n_;  ///< compliance; 0: none
  std::vector<Spring> springs_;
};

/// A round tip on the sheet.
struct Tip {
  bool is_there = false;
  Vec3 at;
  double radius_mm = 0;
  /// The hook holds this particle; kMaxParticles: none.
  std::size_t hooked = kMaxParticles;
};

/// What changes.
class NetState {
 public:
  void reset(const Net& net) noexcept;
  /// One tick of 1 ms. Real-time: no allocation, bounded.
  void step(const Net& net, std::span<const Tip> tips) noexcept;
  /// A particle is taken out for good, and the springs that it held with it. What is left is joined
  /// as before: a hole. Is no part of visit(): whoever reads a state back cuts again.
  void cut(const Net& net, std::size_t i) noexcept;
  [[nodiscard]] bool is_cut(std::size_t i) const noexcept { return is_cut_[i]; }
  /// With which the tissue pushes a tip away, of the last tick [N].
  [[nodiscard]] Vec3 force_on(std::size_t tip) const noexcept { return force_[tip]; }
  /// Of springs and motion [N mm]: what would be left without tips.
  [[nodiscard]] double energy_n_mm(const Net& net) const noexcept;
  [[nodiscard]] Vec3 at(std::size_t i) const noexcept { return at_[i]; }
  [[nodiscard]] bool is_still() const noexcept { return is_still_; }

  template <typename SomeState, typename Visitor>
  static void visit(SomeState& state, std::size_t count, Visitor&& v) noexcept {
    v(state.is_still_);
    for (std::size_t i = 0; i < count && !state.is_still_; ++i) {
      v(state.at_[i]);
      v(state.velocity_[i]);
    }
  }

 private:
  static constexpr std::size_t kTips = 2;
  void small_step(const Net& net, std::span<const Tip> tips, double h) noexcept;
  std::array<Vec3, kMaxParticles> at_{};
  std::array<Vec3, kMaxParticles> velocity_{};  ///< mm/s
  std::array<Vec3, kMaxParticles> before_{};
  std::array<Vec3, kMaxParticles> start_{};  ///< of the tick
  std::array<Vec3, kMaxParticles> start_velocity_{};
  std::array<Vec3, kTips> force_{};
  std::array<bool, kMaxParticles> is_cut_{};
  bool is_still_ = true;
};

/// The particle nearest to a place.
[[nodiscard]] std::size_t nearest(const Net& net, const Vec3& at) noexcept;

}  // namespace carpus::yielding
