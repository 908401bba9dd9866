// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How far a segmented bone can be trusted, from what is measured on it: no truth is asked for.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "anatomy/bone_naming.hpp"
#include "geometry/grid.hpp"

namespace carpus::reconstruct {

/// What is measured on one bone, or one part of a broken one.
struct BoneEvidence {
  std::uint8_t label = 0;
  double volume_mm3 = 0;
  double misfit = 0;        ///< of place and shape to the model's bone (anatomy::RegionName)
  double volume_ratio = 1;  ///< to the model's bone at this wrist's size; 1 for a part or a stump
  double solidity = 1;      ///< volume over that of its convex hull
  double leak = 0;          ///< part of its border that touches another bone directly
  double weak_rim = 0;      ///< part of its border without an edge in the CT
  double unsteady = 0;      ///< part of it that comes or goes as the edge is put at 0.4 or 0.6
  double detached = 0;      ///< part that hangs together with the rest nowhere
  double roughness = 0;     ///< border's area over that of a ball of the same volume
  double noise_hu = 0;      ///< of the scan, in the soft tissue around
  double relative_volume = 1;  ///< volume_ratio over its median among this scan's carpal bones
  double sharpness = 1;        ///< mean step in the CT across its border, in parts of the cortex
  double bright_rim = 0;       ///< part of its border beyond which the CT is as dense as bone
  double rim_part = 0;         ///< part of its voxels on the border: how coarse the scan is for it
  double dark = 0;             ///< part of it no denser than soft tissue
  double wrist_misfit = 0;     ///< of the scan's naming as a whole
};

/// What a row of a study keeps of the evidence, by name.
struct EvidenceField {
  std::string_view name;
  double BoneEvidence::*value;
};
[[nodiscard]] std::span<const EvidenceField> evidence_fields();

struct BoneTrust {
  double confidence = 0;  ///< 0 to 1: how sure it is that Dice is 0.95 or more
  bool flagged = false;
  std::string why;  ///< what was seen and what to do; empty where nothing is wrong
};

/// Below it a bone is flagged.
inline constexpr double kTrustedConfidence = 0.5;

/// Measures each label of `labels` but 0, in their order, with the naming that made them.
///
/// @param labels  bones, by their numbers (anatomy/bone_id.hpp), on the segmented part of the scan
/// @param edge_excess  imaging::BoneSegmentation::edge_excess, same grid
/// @param smoothed_hu  likewise
[[nodiscard]] std::vector<BoneEvidence> measure_evidence(
    const GridView<const std::uint16_t>& labels,
    const GridView<const float>& edge_excess,
    const GridView<const float>& smoothed_hu,
    const anatomy::BoneNaming& naming);

/// The confidence by a logistic function of the evidence, with weights that were set before any
/// scan of `carpus study segmentation` was seen (docs/decisions/0061-trust.md), and the reasons in
/// words.
[[nodiscard]] BoneTrust judge(const BoneEvidence& evidence);

/// What the logistic function weighs, each 0 where a bone is as it should be; in a fixed order.
[[nodiscard]] std::vector<double> concerns_of(const BoneEvidence& evidence);
[[nodiscard]] const std::vector<std::string>& concern_names();

}  // namespace carpus::reconstruct
