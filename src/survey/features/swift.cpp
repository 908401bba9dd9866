// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "survey/features/swift.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "convex/features/feature_pair.hpp"
#include "convex/features/placement.hpp"
#include "geometry/tolerance.hpp"
#include "survey/features/detail/lin_canny_steps.hpp"
#include "survey/features/detail/v_clip_steps.hpp"
#include "survey/features/detail/walk.hpp"

namespace carpus::survey {
namespace {

using convex::FeaturePair;
using convex::FixedBody;
using convex::MovedBody;
using detail::WalkEnd;

/// A coherent walk takes one to four steps; a longer one is shorter by way of a coarser level.
constexpr unsigned kCoherentSteps = 12;
/// So many verdicts in a row must have been given on a level before a coarser one is tried: a walk
/// there that decides nothing is lost.
constexpr unsigned kCalmVerdicts = 8;

class SwiftQuery final : public convex::PairQuery {
 public:
  SwiftQuery(std::shared_ptr<const BodyLevels> first, std::shared_ptr<const BodyLevels> second)
      : first_(std::move(first)),
        second_(std::move(second)),
        top_(std::max(first_->size(), second_->size()) - 1) {
    SwiftQuery::forget();
  }

  [[nodiscard]] convex::Verdict meets(const convex::PairPose& pose) noexcept override {
    convex::MovedBody second((*first_)[0].features, (*second_)[0].features, pose);
    if (!second.is_usable()) return convex::Verdict::Unknown;
    bool coherent = true;
    for (std::size_t level = level_;;) {
      const Found found = search(level, second, coherent);
      coherent = coherent && found.coherent;
      level = found.level;
      const convex::Verdict verdict = verdict_at(level, found);
      if (verdict != convex::Verdict::Unknown || level == 0) {
        remember(level, found, verdict);
        return verdict;
      }
      calm_ = 0;
      pair_ = finer(level, pair_);
      --level;
    }
  }

  [[nodiscard]] std::optional<convex::Closest> closest(
      const convex::PairPose& pose) noexcept override {
    convex::MovedBody second((*first_)[0].features, (*second_)[0].features, pose);
    if (!second.is_usable()) return std::nullopt;
    bool coherent = true;
    for (std::size_t level = level_;;) {
      Found found = search(level, second, coherent);
      coherent = coherent && found.coherent;
      level = found.level;
      const bool overlap = found.kind == WalkEnd::Kind::Overlap;
      if (overlap || level == 0) {
        level_ = level;
        const bool apart =
            !overlap && found.closest && found.closest->distance_mm > kContactToleranceMm;
        if (!apart) return std::nullopt;
        return convex::moved_by(*found.closest, (*first_)[0].features.centre());
      }
      pair_ = finer(level, pair_);
      --level;
    }
  }

  void forget() noexcept override {
    pair_ = {};
    level_ = top_;
    calm_ = 0;
  }

 private:
  struct Found {
    WalkEnd::Kind kind = WalkEnd::Kind::OutOfSteps;
    std::size_t level = 0;
    bool coherent = true;
    std::optional<convex::Closest> closest;
  };

  [[nodiscard]] const BodyLevels::Level& of_first(std::size_t level) const noexcept {
    return (*first_)[std::min(level, first_->size() - 1)];
  }
  [[nodiscard]] const BodyLevels::Level& of_second(std::size_t level) const noexcept {
    return (*second_)[std::min(level, second_->size() - 1)];
  }
  [[nodiscard]] double deviation(std::size_t level) const noexcept {
    return of_first(level).deviation_mm + of_second(level).deviation_mm;
  }

  /// The same vertices one level finer (from `level`, which is not 0).
  [[nodiscard]] convex::FeaturePair finer(std::size_t level,
                                          const convex::FeaturePair& pair) const noexcept {
    const auto move = [level](const BodyLevels& levels, const convex::Feature& feature) noexcept {
      if (level >= levels.size()) return feature;
      return convex::Feature::vertex(
          levels[level].finer[convex::vertex_of(levels[level].features, feature)]);
    };
    return {move(*first_, pair.first), move(*second_, pair.second)};
  }
  /// Near vertices one level coarser (from `level`, which is not the last).
  [[nodiscard]] convex::FeaturePair coarser(std::size_t level,
                                            const convex::FeaturePair& pair) const noexcept {
    const auto move = [level](const BodyLevels& levels, const convex::Feature& feature) noexcept {
      if (level + 1 >= levels.size()) return feature;
      return convex::Feature::vertex(
          levels[level].coarser[convex::vertex_of(levels[level].features, feature)]);
    };
    return {move(*first_, pair.first), move(*second_, pair.second)};
  }

  /// Walks on `level`, or on a coarser one where that takes too long.
  [[nodiscard]] Found search(std::size_t level, convex::MovedBody& second, bool coherent) noexcept {
    Found found;
    for (;; ++level) {
      const convex::FixedBody first{&of_first(level).features};
      second.features = &of_second(level).features;
      const bool is_last_resort = !coherent || level == top_;
      const WalkEnd end =
          detail::walk(first, second, pair_, is_last_resort ? detail::kMaxSteps : kCoherentSteps,
                       detail::LinCannySteps::step);
      if (end.kind != WalkEnd::Kind::OutOfSteps || is_last_resort) {
        settle(level, first, second, end, found);
        return found;
      }
      pair_ = coarser(level, pair_);
      found.coherent = false;
    }
  }

  /// Fills in what the end of the walk is worth.
  void settle(std::size_t level,
              const convex::FixedBody& first,
              const convex::MovedBody& second,
              const WalkEnd& end,
              Found& found) noexcept {
    found.level = level;
    detail::WalkAnswer answer =
        detail::answer_of(first, second, pair_, end, detail::LinCannySteps::step);
    if (answer.kind != WalkEnd::Kind::Overlap && !answer.closest && level == 0) {
      const WalkEnd clip =
          detail::walk(first, second, pair_, detail::kMaxSteps, detail::VClipSteps::step);
      answer = detail::answer_of(first, second, pair_, clip, detail::VClipSteps::step);
    }
    found.kind = answer.kind;
    found.closest = answer.closest;
  }

  /// Unknown: a finer level must tell.
  [[nodiscard]] convex::Verdict verdict_at(std::size_t level, const Found& found) const noexcept {
    if (found.kind == WalkEnd::Kind::Overlap) return convex::Verdict::Meet;
    if (!found.closest) return convex::Verdict::Unknown;
    if (found.closest->distance_mm <= kContactToleranceMm) return convex::Verdict::Meet;
    const double least = found.closest->distance_mm - deviation(level);
    return level == 0 || least > kContactToleranceMm ? convex::Verdict::Apart
                                                     : convex::Verdict::Unknown;
  }

  /// Where the next verdict is looked for: on this level, or one coarser if that can tell.
  void remember(std::size_t level, const Found& found, convex::Verdict verdict) noexcept {
    level_ = level;
    if (level == top_ || verdict == convex::Verdict::Unknown || ++calm_ < kCalmVerdicts) return;
    const bool can_tell =
        verdict == convex::Verdict::Meet ||
        (found.closest && found.closest->distance_mm - deviation(level + 1) > kContactToleranceMm);
    if (!can_tell) return;
    pair_ = coarser(level, pair_);
    level_ = level + 1;
    calm_ = 0;
  }

  std::shared_ptr<const BodyLevels> first_;
  std::shared_ptr<const BodyLevels> second_;
  std::size_t top_;
  convex::FeaturePair pair_;  ///< of level_
  std::size_t level_ = 0;     ///< where the last query ended
  unsigned calm_ = 0;
};

}  // namespace

std::unique_ptr<convex::PairQuery> make_swift(const convex::ConvexBody& first,
                                              const convex::ConvexBody& second) {
  return make_swift(std::make_shared<const BodyLevels>(first),
                    std::make_shared<const BodyLevels>(second));
}

std::unique_ptr<convex::PairQuery> make_swift(std::shared_ptr<const BodyLevels> first,
                                              std::shared_ptr<const BodyLevels> second) {
  return std::make_unique<SwiftQuery>(std::move(first), std::move(second));
}

}  // namespace carpus::survey
