// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The portals of a map, one after another: some are measured from those before them, and all keep
// apart from them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "arthroscopy/detail/bone_landmarks.hpp"
#include "arthroscopy/detail/portal_search.hpp"
#include "arthroscopy/detail/pulled_bones.hpp"
#include "arthroscopy/detail/tour_places.hpp"
#include "arthroscopy/detail/wrist_axes.hpp"
#include "arthroscopy/portal_table.hpp"
#include "cases/arthroscopic_map.hpp"
#include "cases/case_data.hpp"
#include "geometry/vec3.hpp"

namespace carpus::arthroscopy::detail {

class PortalPlacement {
 public:
  /// Keeps references to all of them.
  /// @param map  has its joints; gets portals, and problems for what cannot be placed well
  PortalPlacement(const cases::CaseData& data,
                  const WristAxes& axes,
                  const PulledBones& bones,
                  const TourPlaces& places,
                  cases::ArthroscopicMap& map)
      : data_(data),
        bones_(bones),
        places_(places),
        map_(map),
        search_(axes, bones),
        marks_(bone_landmarks(data, axes)) {}

  /// In the table's order; to be called once.
  void place_all(const PortalTable& table);

 private:
  /// Where a point of the tour lies as the hand is pulled.
  [[nodiscard]] std::optional<Vec3> under_traction(const PortalTable& table,
                                                   const std::string& id) const;
  /// @return where it was placed, in the frame of the generic wrist.
  std::optional<Vec3> place(const PortalTable& table,
                            const TabledPortal& portal,
                            std::uint8_t in,
                            const Vec3& nominal);
  /// The portal of this way but for its number, as scanned.
  [[nodiscard]] cases::Portal portal_by(const TabledPortal& portal,
                                        std::uint8_t in,
                                        const WayIn& way) const;
  /// No way near the landmark is clear: said, for the portal is used all the same.
  void say_what_is_cut(const cases::Portal& portal);

  const cases::CaseData& data_;
  const PulledBones& bones_;
  const TourPlaces& places_;
  cases::ArthroscopicMap& map_;
  PortalSearch search_;
  std::vector<Landmark> marks_;  ///< bones' first, then the portals that were placed
};

}  // namespace carpus::arthroscopy::detail
