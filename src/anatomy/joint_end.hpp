// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The end of a long bone, measured by how much of it is looked at: a scan may show 7 mm of an ulna
// or a whole metacarpal, and what is compared must be equally long on both sides.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "geometry/vec3.hpp"

namespace carpus::anatomy {

/// No more of a shaft is looked at than this [mm]: enough for the largest wrist's 17 mm of the
/// model.
inline constexpr std::size_t kLongestEndMm = 24;

/// One length of a joint end.
struct EndMeasure {
  double log_volume = 0;                ///< of mm^3
  std::array<double, 3> log_extents{};  ///< of the standard deviations along the axes [mm]
  Vec3 centroid;
};

class JointEnd {
 public:
  /// Of the points (each a piece of `piece_mm3`) within `length_mm` of the one that lies farthest
  /// along `towards_joint`.
  JointEnd(std::span<const Vec3> points,
           const Vec3& towards_joint,
           double length_mm,
           double piece_mm3);

  /// How much of it there is [mm], to whole mm; 0 where there is too little to measure.
  [[nodiscard]] double length_mm() const noexcept { return static_cast<double>(measures_.size()); }

  /// The last `length_mm`, held within 1 mm and length_mm().
  /// @pre length_mm() >= 1
  [[nodiscard]] EndMeasure measure(double length_mm) const noexcept;

 private:
  std::vector<EndMeasure> measures_;  ///< [k]: of the last k + 1 mm
};

}  // namespace carpus::anatomy
