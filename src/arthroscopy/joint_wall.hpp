// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The inside of the joint as a scope's picture draws it: one closed wall, what lines it, which way
// its fibres run, and how it goes with the bones when they are pulled apart.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "arthroscopy/carried.hpp"
#include "cases/case_data.hpp"
#include "soft_tissue/soft_tissue.hpp"

namespace carpus::arthroscopy {

struct JointWall {
  std::string joint;     ///< id: "radiocarpal"
  TriangleMesh surface;  ///< outward from the joint's space, frame Patient as scanned [mm]
  // By vertex:
  std::vector<soft_tissue::Lining> lining;
  /// Across and along a ligament's strands [mm], far apart for two ligaments; z: 1 well on one,
  /// less towards another, 0 on none.
  std::vector<Vec3> fibre;
  std::vector<std::uint8_t> proximal;  ///< nearest body of the proximal side ...
  std::vector<std::uint8_t> distal;    ///< ... and of the distal one
  std::vector<float> distal_share;     ///< which side it is: 0 the proximal one, 1 the distal one
  std::vector<Carried> carried;        ///< how it goes with the bodies as they move
  double simplified_by_mm = 0;         ///< against the space's surface, however the joint is opened
  std::size_t parted =
      0;  ///< places where both sides touched as scanned, cut through so that they can part
};

/// Of the joints that a scope looks into (data/portals.json), as far as their spaces could be made;
/// at most 13 500 facets each.
[[nodiscard]] std::vector<JointWall> make_joint_walls(const cases::CaseData& data,
                                                      const soft_tissue::SoftTissue& tissue);

}  // namespace carpus::arthroscopy
