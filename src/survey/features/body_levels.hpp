// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A convex body at several levels of detail, for walks that start coarse [ehmann2000accelerated].
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "convex/convex_body.hpp"
#include "convex/features/voronoi_features.hpp"

namespace carpus::survey {

/// Level 0 is the body; each next level is the hull of what remains of the vertices after two
/// rounds of removing an independent set of those of low degree, flattest first (as the hierarchy
/// of Dobkin and Kirkpatrick removes one set a level); down to about a dozen vertices. Every level
/// lies within the finer ones, and the body nowhere farther than `deviation_mm` outside of it. So
/// bodies meet if two of their levels do, and are apart if two levels are farther apart than their
/// deviations together. (SWIFT's levels enclose the body instead; within, both verdicts can be
/// given early.)
class BodyLevels {
 public:
  /// O(n log n) for the hulls and O(n * faces) for the deviations: some milliseconds for a bone.
  explicit BodyLevels(const convex::ConvexBody& body);

  struct Level {
    convex::VoronoiFeatures features;  ///< about the body's centre on every level
    double deviation_mm = 0;
    std::vector<std::uint32_t> finer;    ///< [v]: the same vertex one level finer; empty for 0
    std::vector<std::uint32_t> coarser;  ///< [v]: the same or a near vertex one level coarser;
                                         ///< empty for the last
  };
  [[nodiscard]] std::size_t size() const noexcept { return levels_.size(); }
  [[nodiscard]] const Level& operator[](std::size_t i) const noexcept { return levels_[i]; }

 private:
  std::vector<Level> levels_;
};

}  // namespace carpus::survey
