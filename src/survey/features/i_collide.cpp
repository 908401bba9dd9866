// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "survey/features/i_collide.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "convex/features/voronoi_features.hpp"
#include "core/check.hpp"
#include "geometry/tolerance.hpp"
#include "survey/features/lin_canny.hpp"

namespace carpus::survey {
namespace {

class SceneOfTwo final : public convex::PairQuery {
 public:
  explicit SceneOfTwo(const std::array<convex::ConvexBody, 2>& bodies) : scene_(bodies) {}
  convex::Verdict meets(const convex::PairPose& first_from_second) noexcept override {
    // Boxes would part bodies whose distance the walk could not square; no method answers there.
    if (!std::isfinite(squared_length(first_from_second.translation))) {
      return convex::Verdict::Unknown;
    }
    const std::array<BodyPose, 2> world_from_body{
        BodyPose{Mat3::identity(), {}},
        BodyPose{first_from_second.rotation, first_from_second.translation}};
    (void)scene_.update(world_from_body);
    return scene_.verdicts()[0];
  }
  void forget() noexcept override { scene_.forget(); }

 private:
  ICollide scene_;
};

}  // namespace

ICollide::ICollide(std::span<const convex::ConvexBody> bodies)
    : boxes_(bodies.size()),
      verdicts_(pair_count_of(bodies.size()), convex::Verdict::Unknown),
      sweep_(bodies.size()) {
  std::vector<std::shared_ptr<const convex::VoronoiFeatures>> graphs;
  for (const convex::ConvexBody& body : bodies) {
    shapes_.emplace_back(body.vertices());
    graphs.push_back(std::make_shared<const convex::VoronoiFeatures>(body));
  }
  for (std::size_t i = 0; i < graphs.size(); ++i) {
    for (std::size_t j = i + 1; j < graphs.size(); ++j) {
      walks_.push_back(make_lin_canny(graphs[i], graphs[j]));
    }
  }
}

SceneTick ICollide::update(std::span<const BodyPose> world_from_body) noexcept {
  CARPUS_CHECK(world_from_body.size() == boxes_.size());
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    boxes_[i] = shapes_[i].in(world_from_body[i], kContactToleranceMm);
  }
  // A box that is not a number overlaps all others, and the walk then refuses the pose.
  sweep_.update(boxes_);
  std::fill(verdicts_.begin(), verdicts_.end(), convex::Verdict::Apart);
  SceneTick tick;
  sweep_.for_each_overlapping([&](const IndexPair& pair) noexcept {
    const std::size_t number = pair_number(pair.first, pair.second, boxes_.size());
    const convex::Verdict verdict = walks_[number]->meets(
        relative_pose(world_from_body[pair.first], world_from_body[pair.second]));
    verdicts_[number] = verdict;
    ++tick.queries;
    tick.meeting += verdict == convex::Verdict::Meet ? 1 : 0;
    tick.unknown += verdict == convex::Verdict::Unknown ? 1 : 0;
  });
  return tick;
}

void ICollide::forget() noexcept {
  sweep_.forget();
  for (const auto& walk : walks_) walk->forget();
  std::fill(verdicts_.begin(), verdicts_.end(), convex::Verdict::Unknown);
}

std::unique_ptr<convex::PairQuery> make_i_collide(const convex::ConvexBody& first,
                                                  const convex::ConvexBody& second) {
  return std::make_unique<SceneOfTwo>(std::array<convex::ConvexBody, 2>{first, second});
}

}  // namespace carpus::survey
