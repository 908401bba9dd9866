// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What changes of a sheet that yields, in fixed memory, by extended position-based dynamics
// [macklin2016xpbd] with several small steps a tick [macklin2019small]. Deterministic: + - * / and
// sqrt alone, one fixed order. Without input its energy never grows. Chosen by a measured
// comparison: docs/decisions/0069. All of it in the frame of the net's first body.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "geometry/pose.hpp"
#include "geometry/vec3.hpp"
#include "yielding/net.hpp"

namespace carpus::yielding {

/// A round tip on the sheet.
struct Tip {
  bool is_there = false;
  bool is_behind = false;  ///< on the side that its normals do not point to
  Vec3 at;
  double radius_mm = 0;
  /// The hook holds this particle; kMaxParticles: none.
  std::size_t hooked = kMaxParticles;
};

class NetState {
 public:
  /// At rest, as scanned.
  void reset(const Net& net) noexcept;
  /// Lays what goes with two bodies where they are now; what has yielded stays so far off. What
  /// lies elsewhere is as long as it lies. Nothing to do where all of it is on one body.
  void lay(const Net& net, const Pose<frame::Bone, frame::Bone>& first_from_second) noexcept;
  /// One tick of 1 ms. Real-time: no allocation, bounded; next to nothing while it is still.
  void step(const Net& net, std::span<const Tip> tips) noexcept;
  /// A particle is taken out for good, and the springs that it held with it. What is left is joined
  /// as before: a hole. Is no part of visit(): whoever reads a state back cuts again.
  void cut(const Net& net, std::size_t i) noexcept;
  [[nodiscard]] bool is_cut(std::size_t i) const noexcept { return is_cut_[i]; }
  /// With which the tissue pushes a tip away, of the last tick [N].
  [[nodiscard]] Vec3 force_on(std::size_t tip) const noexcept { return force_[tip]; }
  /// Of springs and motion [N mm]: what would be left without tips.
  [[nodiscard]] double energy_n_mm(const Net& net) const noexcept;
  /// Where it would rest as its bodies are.
  [[nodiscard]] const Vec3& rest(std::size_t i) const noexcept { return rest_[i]; }
  /// By how much it is off that.
  [[nodiscard]] const Vec3& off(std::size_t i) const noexcept { return off_[i]; }
  [[nodiscard]] Vec3 at(std::size_t i) const noexcept { return rest_[i] + off_[i]; }
  [[nodiscard]] bool is_still() const noexcept { return is_still_; }
  /// The particle whose place of rest is nearest; kMaxParticles: the net has none.
  [[nodiscard]] std::size_t nearest(const Net& net, const Vec3& at) const noexcept;

  template <typename SomeState, typename Visitor>
  static void visit(SomeState& state, std::size_t count, Visitor&& v) noexcept {
    v(state.is_still_);
    for (std::size_t i = 0; i < count && !state.is_still_; ++i) {
      v(state.off_[i]);
      v(state.velocity_[i]);
    }
  }

 private:
  static constexpr std::size_t kTips = 2;
  void small_step(const Net& net, std::span<const Tip> tips, double h) noexcept;
  void pull_by_springs(const Net& net, double w, double per_h2) noexcept;
  void push_by_tip(const Net& net, const Tip& tip, double per_n, Vec3& force) noexcept;
  [[nodiscard]] double length_of(const Net& net, std::size_t spring) const noexcept;
  void rest_where_laid(const Net& net) noexcept;

  std::array<Vec3, kMaxParticles> off_{};
  std::array<Vec3, kMaxParticles> velocity_{};  ///< mm/s
  // Follow from the bodies' poses.
  std::array<Vec3, kMaxParticles> rest_{};
  std::array<double, kMaxSprings> laid_mm_{};  ///< of springs between two bodies
  // Within a tick.
  std::array<Vec3, kMaxParticles> at_{};
  std::array<Vec3, kMaxParticles> before_{};
  std::array<Vec3, kMaxParticles> start_velocity_{};
  std::array<Vec3, kTips> force_{};
  std::array<bool, kMaxParticles> is_cut_{};
  bool is_still_ = true;
};

}  // namespace carpus::yielding
