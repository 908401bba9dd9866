// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A PairQuery around the steps of a walking method: keeps the pair of features at which the last
// walk ended.
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "collision/features/detail/walk.hpp"
#include "collision/features/voronoi_features.hpp"
#include "collision/pair_query.hpp"
#include "geometry/tolerance.hpp"

namespace carpus::collision::detail {

/// @tparam Steps  has `static Step step(const FixedBody&, const MovedBody&, FeaturePair&)
/// noexcept`.
template <typename Steps>
class WalkingQuery final : public PairQuery {
 public:
  WalkingQuery(std::shared_ptr<const VoronoiFeatures> first,
               std::shared_ptr<const VoronoiFeatures> second)
      : first_(std::move(first)), second_(std::move(second)) {}

  [[nodiscard]] Verdict meets(const PairPose& first_from_second) noexcept override {
    std::optional<Closest> unused;
    return run(first_from_second, unused);
  }
  [[nodiscard]] std::optional<Closest> closest(
      const PairPose& first_from_second) noexcept override {
    std::optional<Closest> found;
    if (run(first_from_second, found) != Verdict::Apart || !found) return std::nullopt;
    return moved_by(*found, first_->centre());
  }
  void forget() noexcept override { pair_ = {}; }

 private:
  [[nodiscard]] Verdict run(const PairPose& pose, std::optional<Closest>& found) noexcept {
    const FixedBody first{first_.get()};
    const MovedBody second(*first_, *second_, pose);
    if (!second.is_usable()) return Verdict::Unknown;
    Verdict verdict = walk_once(first, second, found);
    if (verdict == Verdict::Unknown) {  // another way in may avoid the cycle
      pair_ = {};
      verdict = walk_once(first, second, found);
    }
    if (verdict == Verdict::Unknown) pair_ = {};
    return verdict;
  }

  [[nodiscard]] Verdict walk_once(const FixedBody& first,
                                  const MovedBody& second,
                                  std::optional<Closest>& found) noexcept {
    const WalkEnd end = walk(first, second, pair_, kMaxSteps, Steps::step);
    const WalkAnswer answer = answer_of(first, second, pair_, end, Steps::step);
    if (answer.kind == WalkEnd::Kind::Overlap) return Verdict::Meet;
    found = answer.closest;
    if (!found) return Verdict::Unknown;
    return found->distance_mm > kContactToleranceMm ? Verdict::Apart : Verdict::Meet;
  }

  std::shared_ptr<const VoronoiFeatures> first_;
  std::shared_ptr<const VoronoiFeatures> second_;
  FeaturePair pair_;
};

}  // namespace carpus::collision::detail
