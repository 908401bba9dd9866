// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where on a joint's wall a point of the tour lies in a case: bone, between two bones, a ligament's
// course, the disc, or a mere place.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "arthroscopy/detail/space_walls.hpp"
#include "arthroscopy/detail/wrist_axes.hpp"
#include "arthroscopy/portal_table.hpp"
#include "cases/case_data.hpp"
#include "geometry/vec3.hpp"
#include "soft_tissue/soft_tissue.hpp"

namespace carpus::arthroscopy::detail {

class TourPlaces {
 public:
  /// Keeps references to all of them.
  /// @param walls  by joint of the map
  TourPlaces(const cases::CaseData& data,
             const soft_tissue::SoftTissue& tissue,
             const WristAxes& axes,
             std::span<const SpaceWalls> walls)
      : data_(data), tissue_(tissue), axes_(axes), walls_(walls) {}

  /// A vertex of this joint's wall, frame Patient as scanned; none where the case does not have
  /// what it lies on.
  [[nodiscard]] std::optional<Vec3> place_of(const TabledPoint& point, std::uint8_t joint) const;

 private:
  const cases::CaseData& data_;
  const soft_tissue::SoftTissue& tissue_;
  const WristAxes& axes_;
  std::span<const SpaceWalls> walls_;
};

}  // namespace carpus::arthroscopy::detail
