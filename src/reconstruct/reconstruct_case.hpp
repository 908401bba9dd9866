// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// From a CT to a case that can be operated on: bones segmented, named, as surfaces, hulls and
// distance fields, with the skin, the scaphoid's landmarks, the hand's motion, and tendons,
// arteries and nerves as the generic wrist has them. Fully automatic.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cases/case_data.hpp"
#include "cases/make_structures.hpp"
#include "core/progress.hpp"
#include "imaging/bone_segmentation.hpp"
#include "reconstruct/bone_surface.hpp"
#include "reconstruct/bone_trust.hpp"
#include "reconstruct/keep_untouched.hpp"
#include "reconstruct/stage_clock.hpp"

namespace carpus::reconstruct {

struct ReconstructOptions {
  std::string pseudonym = "wrist";
  cases::Provenance provenance;
  imaging::BoneSegmentationOptions segmentation;
  BoneSurfaceOptions surface;
  Progress progress = no_progress;
};

/// What was found out about one bone, beside what the case holds.
struct BoneFigures {
  double naming_cost = 0;  ///< see anatomy::BoneNaming
  double hull_seconds = 0;
  BoneTrust trust;
  /// Measured (build_bone_surface); none where the surface is an earlier version's [mm].
  std::optional<double> simplification_error_mm = {};
};

struct Reconstruction {
  cases::CaseData data;
  std::vector<BoneFigures> figures;  ///< in the order of data.bones
  std::vector<StageTime> stages;
  std::vector<std::string> warnings;  ///< in words for the user; empty when all is well
  std::vector<std::string> of_scan;   ///< those of them that are of the scan as a whole
  double naming_cost = 0;
  double other_side_cost = 0;          ///< the margin to naming_cost is the confidence in the side
  double size = 1;                     ///< relative to the model wrist
  cases::StructureFigures structures;  ///< what was measured of the generated structures
};

/// Makes a case of `ct` [HU].
/// @throws InvalidInput, saying what was seen and what to do, where there is no bone, where the
/// bones
///     make no wrist (anatomy::NamingStatus::NotAWrist), or where radius, lunate, capitate or
///     scaphoid are missing, without which nothing can be operated on. Other missing bones and a
///     doubtful fit are warnings.
[[nodiscard]] Reconstruction reconstruct_case(Grid<std::int16_t> ct,
                                              const ReconstructOptions& options);

/// The same of bones that are outlined and named already (given_labels.hpp): nothing is segmented.
/// @param earlier  the version of which a person changed these labels: bones that are the same in
///     both stay as they are there; nullptr where there is none
/// @throws as reconstruct_case and describe_labels.
[[nodiscard]] Reconstruction reconstruct_labelled(Grid<std::int16_t> ct,
                                                  const Grid<std::uint8_t>& labels,
                                                  const ReconstructOptions& options,
                                                  const EarlierVersion* earlier = nullptr);

}  // namespace carpus::reconstruct
