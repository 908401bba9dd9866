// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A ligament that yields, laid on the wall of the joint that it is seen from.
#pragma once

#include <optional>

#include "arthroscopy/band_table.hpp"
#include "arthroscopy/detail/space_walls.hpp"
#include "cases/case_data.hpp"
#include "cases/ligament_band.hpp"
#include "soft_tissue/soft_tissue.hpp"

namespace carpus::arthroscopy::detail {

/// None where too little of it lies on the wall, or its bones are not there.
/// @param wall  signed distance to it, negative in the joint
[[nodiscard]] std::optional<cases::LigamentBand> lay_band(const cases::CaseData& data,
                                                          const soft_tissue::SoftTissue& tissue,
                                                          const SpaceWalls& walls,
                                                          const Grid<float>& wall,
                                                          const TabledBand& band,
                                                          const BandTable& table);

}  // namespace carpus::arthroscopy::detail
