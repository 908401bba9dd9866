// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A PairQuery around the steps of a walking method: keeps the pair of features at which the last
// walk ended.
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "convex/features/voronoi_features.hpp"
#include "convex/pair_query.hpp"
#include "geometry/tolerance.hpp"
#include "survey/features/detail/walk.hpp"

namespace carpus::survey::detail {

/// @tparam Steps  has `static Step step(const FixedBody&, const MovedBody&, FeaturePair&)
/// noexcept`.
template <typename Steps>
class WalkingQuery final : public convex::PairQuery {
 public:
  WalkingQuery(std::shared_ptr<const convex::VoronoiFeatures> first,
               std::shared_ptr<const convex::VoronoiFeatures> second)
      : first_(std::move(first)), second_(std::move(second)) {}

  [[nodiscard]] convex::Verdict meets(const convex::PairPose& first_from_second) noexcept override {
    std::optional<convex::Closest> unused;
    return run(first_from_second, unused);
  }
  [[nodiscard]] std::optional<convex::Closest> closest(
      const convex::PairPose& first_from_second) noexcept override {
    std::optional<convex::Closest> found;
    if (run(first_from_second, found) != convex::Verdict::Apart || !found) return std::nullopt;
    return convex::moved_by(*found, first_->centre());
  }
  void forget() noexcept override { pair_ = {}; }

 private:
  [[nodiscard]] convex::Verdict run(const convex::PairPose& pose,
                                    std::optional<convex::Closest>& found) noexcept {
    const convex::FixedBody first{first_.get()};
    const convex::MovedBody second(*first_, *second_, pose);
    if (!second.is_usable()) return convex::Verdict::Unknown;
    convex::Verdict verdict = walk_once(first, second, found);
    if (verdict == convex::Verdict::Unknown) {  // another way in may avoid the cycle
      pair_ = {};
      verdict = walk_once(first, second, found);
    }
    if (verdict == convex::Verdict::Unknown) pair_ = {};
    return verdict;
  }

  [[nodiscard]] convex::Verdict walk_once(const convex::FixedBody& first,
                                          const convex::MovedBody& second,
                                          std::optional<convex::Closest>& found) noexcept {
    const WalkEnd end = walk(first, second, pair_, kMaxSteps, Steps::step);
    const WalkAnswer answer = answer_of(first, second, pair_, end, Steps::step);
    if (answer.kind == WalkEnd::Kind::Overlap) return convex::Verdict::Meet;
    found = answer.closest;
    if (!found) return convex::Verdict::Unknown;
    return found->distance_mm > kContactToleranceMm ? convex::Verdict::Apart
                                                    : convex::Verdict::Meet;
  }

  std::shared_ptr<const convex::VoronoiFeatures> first_;
  std::shared_ptr<const convex::VoronoiFeatures> second_;
  convex::FeaturePair pair_;
};

}  // namespace carpus::survey::detail
