// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// All pairs of many moving bodies by the growth program: poses in the world in, verdicts out. What
// one pair alone cannot have: a proof tells how far both bodies may move before it could fail, and
// until then the pair costs one comparison.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "convex/growth/growth_counts.hpp"
#include "convex/growth/growth_memory.hpp"
#include "convex/growth/proof_body.hpp"
#include "convex/growth/ready_proof.hpp"
#include "survey/scene.hpp"

namespace carpus::survey {

struct GrowthSceneCounts {
  convex::GrowthCounts pairs;   ///< of the pairs that were asked
  std::uint64_t by_budget = 0;  ///< pairs not asked: the bodies have not moved far enough
  std::uint64_t by_spheres = 0;
};

/// The verdict of every pair is exact for the bodies' vertices and their poses in the world as
/// given. Pairs are numbered (0, 1), (0, 2), ...
/// Real-time: update() is noexcept and allocates nothing. Cost: one bound of the motion a body, one
/// comparison a pair that it spares, some 30 ns a pair whose last proof still holds.
class GrowthScene {
 public:
  /// @param bodies  stay where they are for the life of the scene.
  /// @param uses_budget  false: every pair is asked at every update; the verdicts are the same.
  explicit GrowthScene(std::span<const convex::ConvexBody* const> bodies, bool uses_budget = true);

  [[nodiscard]] std::size_t pair_count() const noexcept { return pairs_.size(); }
  [[nodiscard]] IndexPair pair(std::size_t number) const noexcept { return pairs_[number].bodies; }

  /// @param world_from_body  one for each body.
  SceneTick update(std::span<const BodyPose> world_from_body) noexcept;
  /// By pair, of the last update; Unknown before the first, and where a pose is not finite or
  /// larger than kLargestCoordinate.
  [[nodiscard]] std::span<const convex::Verdict> verdicts() const noexcept { return verdicts_; }
  void forget() noexcept;
  [[nodiscard]] const GrowthSceneCounts& counts() const noexcept { return counts_; }

 private:
  struct Body {
    const convex::ConvexBody* body = nullptr;
    convex::ProofBody proofs;
    Vec3 origin;  ///< of the graph, in the body
    double radius_mm = 0;
    bool is_usable = false;  ///< the graph is
    BodyPose pose;
    Vec3 centre;  ///< of the graph's origin, in the world
    double centre_error_mm = 0;
    double rigidity_error = 0;  ///< of the rotation times its transpose from 1
    double path_mm = 0;         ///< no point of the body has moved further since the start
    bool is_ordinary = false;   ///< proofs in doubles are possible
    bool has_moved = false;     ///< pose holds one that was given
  };
  struct Pair {
    IndexPair bodies{};
    convex::ReadyProof ready;
    convex::GrowthMemory memory;
  };

  void place(Body& body, const BodyPose& pose) const noexcept;
  void find_asked() noexcept;
  void fetch(std::size_t number) const noexcept;
  [[nodiscard]] convex::Verdict decide(std::size_t number) noexcept;
  [[nodiscard]] static convex::RelativePose relative(const Body& first,
                                                     const Body& second) noexcept;

  std::vector<Body> bodies_;
  std::vector<Pair> pairs_;
  /// By pair: the verdict holds until both bodies' paths add up to this [mm]. Apart from the rest
  /// of a pair, which is not read while that is so.
  std::vector<double> limits_mm_;
  std::vector<std::uint32_t> asked_;  ///< pairs that this update has to ask
  std::vector<convex::Verdict> verdicts_;
  bool uses_budget_;
  GrowthSceneCounts counts_;
};

}  // namespace carpus::survey
