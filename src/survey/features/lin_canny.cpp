// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "survey/features/lin_canny.hpp"

#include <utility>

#include "survey/features/detail/lin_canny_steps.hpp"
#include "survey/features/detail/walking_query.hpp"

namespace carpus::survey {

std::unique_ptr<convex::PairQuery> make_lin_canny(const convex::ConvexBody& first,
                                                  const convex::ConvexBody& second) {
  return make_lin_canny(std::make_shared<const convex::VoronoiFeatures>(first),
                        std::make_shared<const convex::VoronoiFeatures>(second));
}

std::unique_ptr<convex::PairQuery> make_lin_canny(
    std::shared_ptr<const convex::VoronoiFeatures> first,
    std::shared_ptr<const convex::VoronoiFeatures> second) {
  return std::make_unique<detail::WalkingQuery<detail::LinCannySteps>>(std::move(first),
                                                                       std::move(second));
}

}  // namespace carpus::survey
