// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "survey/features/v_clip.hpp"

#include <utility>

#include "survey/features/detail/v_clip_steps.hpp"
#include "survey/features/detail/walking_query.hpp"

namespace carpus::survey {

std::unique_ptr<convex::PairQuery> make_v_clip(const convex::ConvexBody& first,
                                               const convex::ConvexBody& second) {
  return make_v_clip(std::make_shared<const convex::VoronoiFeatures>(first),
                     std::make_shared<const convex::VoronoiFeatures>(second));
}

std::unique_ptr<convex::PairQuery> make_v_clip(
    std::shared_ptr<const convex::VoronoiFeatures> first,
    std::shared_ptr<const convex::VoronoiFeatures> second) {
  return std::make_unique<detail::WalkingQuery<detail::VClipSteps>>(std::move(first),
                                                                    std::move(second));
}

}  // namespace carpus::survey
