// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Carries tendons, arteries and nerves of the generic wrist onto a case's own bones, and measures
// what came of it.
#pragma once

#include <string>
#include <vector>

#include "anatomy/structure_table.hpp"
#include "cases/case_data.hpp"

namespace carpus::cases {

/// How near a nerve lies to a portal, beside what is published.
struct PortalDistance {
  std::string portal;
  std::string nearest;  ///< the nerve, in words
  double mm = 0;        ///< from the portal's middle, at the nerves' depth, to the nerve's surface
  std::vector<anatomy::PublishedDistance> published;
};

struct StructureFigures {
  double scale = 1;                ///< of the radius against the generic one
  double worst_misfit_mm = 0;      ///< rms of the worst of the bones' fits
  double deepest_in_bone_mm = 0;   ///< of any tube in any bone; 0 for none
  double deepest_in_other_mm = 0;  ///< of any tube in another; 0 for none
  double least_under_skin_mm = 0;  ///< of any tube's surface, where there is skin; negative outside
  std::vector<PortalDistance> portals;
  std::vector<std::string> problems;  ///< in words; empty when all is well
};

struct MadeStructures {
  std::vector<Structure> structures;
  StructureFigures figures;
};

/// @param data  needs side, wrist frame, and bones with surfaces, the radius among them; the skin
///     keeps tubes under it where there is one. What leaves the CT's volume is cut off.
/// Runs through parallel_for, the same bits on any number of threads; a second or two.
[[nodiscard]] MadeStructures make_structures(
    const CaseData& data,
    const anatomy::StructureTable& table = anatomy::StructureTable::generic());

/// Of the structures that the case has now: whatever they gave way to since they were made.
[[nodiscard]] StructureFigures measure_structures(
    const CaseData& data,
    const anatomy::StructureTable& table = anatomy::StructureTable::generic());

struct AddedStructures {
  std::vector<std::string> names;     ///< of what was added, in the table's order
  std::vector<std::string> problems;  ///< of all that was laid; empty when all is well
};

/// Adds to a case what of `table` it lacks, laid beside all else of it; what is there stays as it
/// is. Cases of an older program have fewer.
[[nodiscard]] AddedStructures add_missing_structures(
    CaseData& data,
    const anatomy::StructureTable& table = anatomy::StructureTable::generic());

/// Deepest place of a tube in any bone of the case [mm], 0 for none. Exact triangles, five points
/// to a millimetre of the middle line.
[[nodiscard]] double deepest_in_bone_mm(const CaseData& data, const Structure& structure);

struct StructureDepth {
  double in_bone_mm = 0;  ///< deepest_in_bone_mm
  /// Of its surface, where there is skin; negative outside, infinite where there is none.
  double under_skin_mm = 0;
};

/// Of each of the case's structures, in their order.
[[nodiscard]] std::vector<StructureDepth> structure_depths(const CaseData& data);

}  // namespace carpus::cases
