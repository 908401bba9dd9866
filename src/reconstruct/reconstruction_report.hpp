// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What `carpus reconstruct` prints and writes about a reconstruction.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reconstruct/ground_truth.hpp"
#include "reconstruct/reconstruct_case.hpp"
#include "reconstruct/surface_truth.hpp"

namespace carpus::reconstruct {

/// One line of the table: a bone or a part of one.
struct BoneLine {
  std::string name;
  std::optional<double> dice;              ///< against the truth, where there is one
  std::optional<SurfaceDistance> surface;  ///< from the true one, where there is one
  bool is_found = true;                    ///< false: the truth has it, the case does not
  std::size_t vertices = 0;
  std::size_t facets = 0;
  std::size_t hull_vertices = 0;
  std::size_t hull_facets = 0;
  double hull_seconds = 0;
  double naming_cost = 0;
  BoneTrust trust;
  /// How far simplification moved the surface at most, measured [mm]; none where it was not.
  std::optional<double> simplification_error_mm;
  int genus = 0;                       ///< handles of the surface; a bone has none
  std::size_t self_intersections = 0;  ///< pairs of its facets that cross
};

struct ReconstructionReport {
  std::string side;
  std::vector<BoneLine> bones;
  std::optional<double> dice_mean;  ///< over the truth's bones; one that was not found counts as 0
  std::optional<double> dice_min;
  std::optional<double> surface_mean_mm;  ///< the mean of the bones', and the worst bone's 95 %
  std::optional<double> surface_p95_mm;
  std::vector<StageTime> stages;
  std::optional<double> peak_memory_bytes;  ///< of the whole program, where it was asked for
  std::size_t voxels = 0;                   ///< of the scan
  std::vector<std::string> conventions;     ///< taken when the scan was read, in words
  double naming_cost = 0;
  double other_side_cost = 0;
  std::size_t structures = 0;  ///< tendons, arteries and nerves that were generated
  cases::StructureFigures structure_figures;
};

/// Gathers the figures; `dice` as compare_labels gives it and `surfaces` as compare_surfaces, empty
/// without a truth.
[[nodiscard]] ReconstructionReport make_report(const Reconstruction& reconstruction,
                                               const std::vector<LabelDice>& dice,
                                               const std::vector<SurfaceDistance>& surfaces = {});

/// The thesis's table (bone, vertices, facets, hull vertices, hull facets, time), Dice, what was
/// generated with its distances beside published ones, and the time of each stage with its share,
/// for people.
[[nodiscard]] std::string text_of(const ReconstructionReport& report);

/// {"side", "bones": [{"name", "dice", "vertices", "facets", "hull_vertices", "hull_facets",
/// "confidence", "flagged", "why", "simplification_error_mm", "genus",
/// "self_intersections"}],
/// "dice_mean", "dice_min", "stages": [{"name", "seconds"}], "conventions": [], "structures":
/// {"generated": true, "count", "in_bone_mm", "in_another_mm", "under_skin_mm", "portals":
/// [{"portal", "nerve", "mm"}]}}; the Dice figures are null without a truth. A bone that was not
/// found is not in "bones", but counts in the mean and the minimum. With true surfaces bones have
/// "surface_mean_mm", "surface_p95_mm" and "surface_most_mm", and the whole the first two.
[[nodiscard]] std::string json_of(const ReconstructionReport& report);

}  // namespace carpus::reconstruct
