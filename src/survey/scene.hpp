// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Many bodies that all move every tick, and every pair of them asked by one method: the tick of a
// whole wrist. Nothing is rebuilt when bodies move; hulls stay in their own frames.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "convex/convex_body.hpp"
#include "convex/pair_query.hpp"
#include "geometry/aabb.hpp"
#include "geometry/pose.hpp"
#include "survey/methods.hpp"
#include "survey/volumes/moved_box.hpp"
#include "survey/volumes/sweep_and_prune.hpp"

namespace carpus::survey {

namespace scene_frame {
struct World;
struct Body;  ///< any one of the bodies: the frame of its vertices
}  // namespace scene_frame
/// Named `world_from_body`; its matrix is a rotation up to rounding.
using BodyPose = Pose<scene_frame::World, scene_frame::Body>;

/// inverse(world_from_first) * world_from_second, with the inverse of a rotation, its transpose.
/// The difference of the translations is taken first, so that bodies far from the origin lose
/// nothing more. A point v of the second body lands within 9 u |v| + 7 u |t_2 - t_1| of its exact
/// place, u = kRoundoff: 2e-13 mm for a wrist of 150 mm.
[[nodiscard]] constexpr convex::PairPose relative_pose(const BodyPose& world_from_first,
                                                       const BodyPose& world_from_second) noexcept {
  const auto& a = world_from_first.rotation.rows;
  const auto& b = world_from_second.rotation.rows;
  const Vec3 d = world_from_second.translation - world_from_first.translation;
  convex::PairPose pose;
  for (std::size_t i = 0; i < 3; ++i) {
    pose.rotation.rows[i] = b[0] * a[0][i] + b[1] * a[1][i] + b[2] * a[2][i];
  }
  pose.translation = a[0] * d.x + a[1] * d.y + a[2] * d.z;
  return pose;
}

/// How pairs are chosen that the method need not see.
enum class BroadPhase : std::uint8_t {
  None,           ///< the method sees every pair
  AllBoxes,       ///< boxes of all pairs
  SweepAndPrune,  ///< boxes, kept sorted
};

/// What one update did.
struct SceneTick {
  std::size_t meeting = 0;
  std::size_t unknown = 0;  ///< a pose that is not finite, or the method could not tell
  std::size_t queries = 0;  ///< pairs that the method saw
};

/// All pairs of bodies under one method. Pairs are numbered (0, 1), (0, 2), ... as pair_number().
/// The broad phase changes the cost, never a verdict: boxes enclose what the method is shown, with
/// rounding and kContactToleranceMm.
/// Real-time: updates are noexcept and allocate nothing.
class Scene {
 public:
  /// @param bodies  stay where they are for the life of the scene.
  /// @throws InvalidInput for a method that makes no query, or for too many bodies.
  Scene(std::span<const convex::ConvexBody> bodies, const Method& method, BroadPhase broad_phase);

  [[nodiscard]] std::size_t body_count() const noexcept { return bodies_.size(); }
  [[nodiscard]] std::size_t pair_count() const noexcept { return queries_.size(); }
  [[nodiscard]] IndexPair pair(std::size_t number) const noexcept { return pairs_[number]; }

  /// Asks whether the bodies meet, pair by pair. @param world_from_body  one for each body.
  SceneTick update(std::span<const BodyPose> world_from_body) noexcept;
  /// Asks for distances too. Pairs whose boxes are more than `limit_mm` apart on some axis (which
  /// there are only with a broad phase) get infinity.
  SceneTick update_distances(std::span<const BodyPose> world_from_body,
                             double limit_mm = std::numeric_limits<double>::infinity()) noexcept;

  /// By pair, of the last update; Unknown before the first.
  [[nodiscard]] std::span<const convex::Verdict> verdicts() const noexcept { return verdicts_; }
  /// By pair, of the last update_distances [mm]: 0 where bodies meet, NaN where not known (or the
  /// method gives no distances).
  [[nodiscard]] std::span<const double> distances_mm() const noexcept { return distances_mm_; }
  /// For what else the method can tell of a pair.
  [[nodiscard]] convex::PairQuery& query(std::size_t number) noexcept { return *queries_[number]; }

  /// Every query and the broad phase forget: the next update is cold.
  void forget() noexcept;

 private:
  void take(std::span<const BodyPose> world_from_body, double limit_mm) noexcept;
  void find_candidates(double limit_mm) noexcept;
  template <typename Visit>
  SceneTick visit_candidates(Visit&& visit) noexcept;

  std::vector<MovedBox> bodies_;
  std::vector<IndexPair> pairs_;
  std::vector<std::unique_ptr<convex::PairQuery>> queries_;
  std::optional<SweepAndPrune> sweep_;
  BroadPhase broad_phase_;
  std::vector<BodyPose> poses_;
  std::vector<std::uint8_t> is_finite_;
  std::vector<Aabb> boxes_;
  std::vector<std::uint64_t> candidates_;  ///< one bit a pair
  std::vector<convex::Verdict> verdicts_;
  std::vector<double> distances_mm_;
};

}  // namespace carpus::survey
