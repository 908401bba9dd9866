// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "collision/features/v_clip.hpp"

#include <utility>

#include "collision/features/detail/v_clip_steps.hpp"
#include "collision/features/detail/walking_query.hpp"

namespace carpus::collision {

std::unique_ptr<PairQuery> make_v_clip(const ConvexBody& first, const ConvexBody& second) {
  return make_v_clip(std::make_shared<const VoronoiFeatures>(first),
                     std::make_shared<const VoronoiFeatures>(second));
}

std::unique_ptr<PairQuery> make_v_clip(std::shared_ptr<const VoronoiFeatures> first,
                                       std::shared_ptr<const VoronoiFeatures> second) {
  return std::make_unique<detail::WalkingQuery<detail::VClipSteps>>(std::move(first),
                                                                    std::move(second));
}

}  // namespace carpus::collision
