// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "survey/scene.hpp"
#include "survey/methods.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <string>

#include "core/check.hpp"
#include "core/error.hpp"

namespace carpus::survey {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Not a number and infinity times zero are not zero.
bool is_finite(const BodyPose& pose) noexcept {
  Vec3 zero = pose.translation * 0;
  for (const Vec3& row : pose.rotation.rows) zero += row * 0;
  return zero.x + zero.y + zero.z == 0;
}

/// All comparisons rather than a branch after each: neighbours' boxes give no rhythm to predict.
/// NaN overlaps.
bool overlap(const Aabb& a, const Aabb& b) noexcept {
  const int apart = static_cast<int>(a.low.x > b.high.x) | static_cast<int>(b.low.x > a.high.x) |
                    static_cast<int>(a.low.y > b.high.y) | static_cast<int>(b.low.y > a.high.y) |
                    static_cast<int>(a.low.z > b.high.z) | static_cast<int>(b.low.z > a.high.z);
  return apart == 0;
}

}  // namespace

Scene::Scene(std::span<const convex::ConvexBody> bodies,
             const Method& method,
             BroadPhase broad_phase)
    : broad_phase_(broad_phase),
      poses_(bodies.size()),
      is_finite_(bodies.size()),
      boxes_(bodies.size()) {
  if (broad_phase == BroadPhase::SweepAndPrune) sweep_.emplace(bodies.size());
  for (const convex::ConvexBody& body : bodies) bodies_.emplace_back(body.vertices());
  for (std::uint32_t i = 0; i < bodies.size(); ++i) {
    for (std::uint32_t j = i + 1; j < bodies.size(); ++j) {
      pairs_.push_back({i, j});
      queries_.push_back(method.make == nullptr ? nullptr : method.make(bodies[i], bodies[j]));
      if (!queries_.back()) {
        throw InvalidInput("the method " + std::string(method.name) + " made no query");
      }
    }
  }
  candidates_.resize((pairs_.size() + 63) / 64);
  verdicts_.resize(pairs_.size(), convex::Verdict::Unknown);
  distances_mm_.resize(pairs_.size(), std::numeric_limits<double>::quiet_NaN());
}

void Scene::take(std::span<const BodyPose> world_from_body, double limit_mm) noexcept {
  CARPUS_CHECK(world_from_body.size() == bodies_.size());
  std::copy(world_from_body.begin(), world_from_body.end(), poses_.begin());
  for (std::size_t i = 0; i < poses_.size(); ++i) is_finite_[i] = is_finite(poses_[i]) ? 1 : 0;
  find_candidates(limit_mm);
}

void Scene::find_candidates(double limit_mm) noexcept {
  // No boxes where nothing could be left out. Bits past the last pair stay zero.
  if (broad_phase_ == BroadPhase::None || !(limit_mm < kInfinity)) {
    std::fill(candidates_.begin(), candidates_.end(), ~std::uint64_t{0});
    if (pairs_.size() % 64 != 0) candidates_.back() = (std::uint64_t{1} << pairs_.size() % 64) - 1;
    return;
  }
  const double margin_mm = limit_mm / 2 + kContactToleranceMm;
  for (std::size_t i = 0; i < boxes_.size(); ++i) boxes_[i] = bodies_[i].in(poses_[i], margin_mm);
  if (sweep_) {
    sweep_->update(boxes_);
    const std::span<const std::uint64_t> bits = sweep_->overlap_bits();
    std::copy(bits.begin(), bits.end(), candidates_.begin());
    return;
  }
  std::fill(candidates_.begin(), candidates_.end(), 0);
  std::size_t number = 0;
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    for (std::size_t j = i + 1; j < boxes_.size(); ++j, ++number) {
      const std::uint64_t bit = overlap(boxes_[i], boxes_[j]) ? 1 : 0;
      candidates_[number / 64] |= bit << (number % 64);
    }
  }
}

template <typename Visit>
SceneTick Scene::visit_candidates(Visit&& visit) noexcept {
  SceneTick tick;
  for (std::size_t w = 0; w < candidates_.size(); ++w) {
    for (std::uint64_t bits = candidates_[w]; bits != 0; bits &= bits - 1) {
      const std::size_t number = w * 64 + static_cast<std::size_t>(std::countr_zero(bits));
      const IndexPair pair = pairs_[number];
      if ((is_finite_[pair.first] & is_finite_[pair.second]) == 0) continue;
      ++tick.queries;
      const convex::Verdict verdict =
          visit(number, relative_pose(poses_[pair.first], poses_[pair.second]));
      verdicts_[number] = verdict;
      tick.meeting += verdict == convex::Verdict::Meet ? 1 : 0;
      tick.unknown += verdict == convex::Verdict::Unknown ? 1 : 0;
    }
  }
  if (std::find(is_finite_.begin(), is_finite_.end(), 0) == is_finite_.end()) return tick;
  for (std::size_t number = 0; number < pairs_.size(); ++number) {
    if ((is_finite_[pairs_[number].first] & is_finite_[pairs_[number].second]) != 0) continue;
    verdicts_[number] = convex::Verdict::Unknown;
    distances_mm_[number] = std::numeric_limits<double>::quiet_NaN();
    ++tick.unknown;
  }
  return tick;
}

SceneTick Scene::update(std::span<const BodyPose> world_from_body) noexcept {
  take(world_from_body, 0);
  std::fill(verdicts_.begin(), verdicts_.end(), convex::Verdict::Apart);
  return visit_candidates([this](std::size_t number, const convex::PairPose& pose) noexcept {
    return queries_[number]->meets(pose);
  });
}

SceneTick Scene::update_distances(std::span<const BodyPose> world_from_body,
                                  double limit_mm) noexcept {
  take(world_from_body, limit_mm);
  std::fill(verdicts_.begin(), verdicts_.end(), convex::Verdict::Apart);
  std::fill(distances_mm_.begin(), distances_mm_.end(), kInfinity);
  return visit_candidates([this](std::size_t number, const convex::PairPose& pose) noexcept {
    convex::PairQuery& query = *queries_[number];
    if (const std::optional<convex::Closest> closest = query.closest(pose)) {
      distances_mm_[number] = closest->distance_mm;
      return convex::Verdict::Apart;
    }
    const convex::Verdict verdict = query.meets(pose);
    distances_mm_[number] =
        verdict == convex::Verdict::Meet ? 0 : std::numeric_limits<double>::quiet_NaN();
    return verdict;
  });
}

void Scene::forget() noexcept {
  if (sweep_) sweep_->forget();
  for (const std::unique_ptr<convex::PairQuery>& query : queries_) query->forget();
}

}  // namespace carpus::survey
