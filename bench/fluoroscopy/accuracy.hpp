// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How far composed pictures are from slow ones.
#pragma once

#include <string>
#include <vector>

#include "bench/fluoroscopy/scene.hpp"
#include "fluoroscopy/composed_projector.hpp"
#include "fluoroscopy/render.hpp"

namespace carpus::bench {

/// Of attenuation, pixels that neither collimator covers, in percent of the oracle's range.
struct Difference {
  std::string view;
  std::string oracle;
  double flexion_deg = 0.0;
  double mean_percent = 0.0;
  double p99_percent = 0.0;
  double worst_percent = 0.0;
  double share_within_1_percent = 0.0;  ///< of the pixels, in percent
  double left_out_percent = 0.0;        ///< pixels where the oracle's bones lie in one place
  std::size_t pixels = 0;
};

[[nodiscard]] Difference difference_of(const fluoroscopy::AttenuationMap& map,
                                       const fluoroscopy::AttenuationMap& oracle);

/// The composition by steps of `step_mm`, every `stride`-th pixel of a row and column; NaN between.
[[nodiscard]] fluoroscopy::AttenuationMap stepped_map(
    const fluoroscopy::ComposedProjector& projector,
    const fluoroscopy::CArmPose& pose,
    const BodyPoses& poses,
    double step_mm,
    std::size_t stride);

}  // namespace carpus::bench
