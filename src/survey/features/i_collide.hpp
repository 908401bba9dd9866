// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// I-COLLIDE: many moving bodies, boxes kept sorted, and Lin and Canny's walk for the pairs whose
// boxes overlap [cohen1995icollide].
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "convex/convex_body.hpp"
#include "convex/pair_query.hpp"
#include "survey/scene.hpp"
#include "survey/volumes/moved_box.hpp"
#include "survey/volumes/sweep_and_prune.hpp"

namespace carpus::survey {

/// Every pair of a scene under the paper's two levels. Each pair keeps its closest features, also
/// while its boxes are apart. All pairs of a body share one graph of features, which is what this
/// has over a Scene of `lin_canny` with sweep and prune: for n bodies n graphs, not n (n - 1).
/// Boxes are those of moved_box.hpp, not the paper's cubes or climbed extreme vertices.
/// Limits: those of lin_canny.hpp (a pair that overlaps may be Unknown).
/// Real-time: update() is noexcept and allocates nothing.
class ICollide {
 public:
  /// @param bodies  not needed after construction.
  /// @throws InvalidInput for more bodies than SweepAndPrune takes.
  explicit ICollide(std::span<const convex::ConvexBody> bodies);

  [[nodiscard]] std::size_t body_count() const noexcept { return boxes_.size(); }
  [[nodiscard]] std::size_t pair_count() const noexcept { return verdicts_.size(); }

  /// @param world_from_body  one for each body; of a body whose pose is not finite all pairs are
  /// Unknown.
  SceneTick update(std::span<const BodyPose> world_from_body) noexcept;

  /// By pair_number(), of the last update; Unknown before the first.
  [[nodiscard]] std::span<const convex::Verdict> verdicts() const noexcept { return verdicts_; }

  /// The next update is cold.
  void forget() noexcept;

 private:
  std::vector<MovedBox> shapes_;
  std::vector<Aabb> boxes_;
  std::vector<std::unique_ptr<convex::PairQuery>> walks_;  ///< by pair
  std::vector<convex::Verdict> verdicts_;
  SweepAndPrune sweep_;
};

/// A scene of two: the boxes first, the walk where they overlap.
[[nodiscard]] std::unique_ptr<convex::PairQuery> make_i_collide(const convex::ConvexBody& first,
                                                                const convex::ConvexBody& second);

}  // namespace carpus::survey
