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
#include "geometry/triangle_mesh.hpp"
#include "imaging/region_merging.hpp"

namespace carpus::reconstruct {

/// What is measured on one bone, or one part of a broken one. Nothing in it counts voxels, so that
/// coarse and fine scans are judged alike. "Of its surface" means of its vertices, which lie
/// evenly.
struct BoneEvidence {
  std::uint8_t label = 0;
  double volume_mm3 = 0;
  double misfit = 0;        ///< of place and shape to the model's bone (anatomy::RegionName)
  double volume_ratio = 1;  ///< to the model's bone at this wrist's size; 1 for a part or a stump
  double relative_volume = 1;  ///< volume_ratio over its median among this scan's carpal bones
  double solidity = 1;         ///< volume over that of its convex hull
  double detached = 0;         ///< part that hangs together with the rest nowhere
  double roughness = 0;        ///< surface's area over that of a ball of the same volume
  double contact = 0;          ///< part of its surface beyond which another bone lies at once
  double dense_beyond = 0;     ///< part of it beyond which the CT is still as dense as bone
  double no_edge = 0;          ///< part of it that has no edge in the CT within 1.25 mm
  double faint = 0;            ///< part of it across which the CT hardly falls
  double off_edge = 0;  ///< mean distance from it to the CT's edge, times area over volume: a share
  double blur = 0;      ///< mean width of the CT's edge, where it has one within 1.25 mm, likewise
  double edge_mm = 0;   ///< that width itself [mm]
  double coarseness = 0;  ///< the voxels' width across it, likewise
  double dark = 0;        ///< part of the bone no denser than soft tissue
  double severed = 0;     ///< volume of nameless bodies that grow on it without a gap, over its own
  double metal_mm3 = 0;   ///< denser than any bone, in the bone and within 4 mm of its extent
  double noise_hu = 0;    ///< of the scan, in the soft tissue around
  double wrist_misfit = 0;  ///< of the scan's naming as a whole
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
inline constexpr double kTrustedConfidence = 0.44;

struct LabelSurface {
  std::uint8_t label = 0;
  const TriangleMesh* surface = nullptr;  ///< [Patient, mm], closed, outwards
};

/// Measures each label of `labels` but 0, in their order, with the naming that made them.
///
/// @param labels  bones, by their numbers (anatomy/bone_id.hpp), on the segmented part of the scan
/// @param regions  imaging::measure_regions of imaging::BoneSegmentation::regions, with those that
/// have
///     no name; heights do not matter
/// @param edge_excess  imaging::BoneSegmentation::edge_excess, same grid
/// @param smoothed_hu  likewise
/// @param surfaces  of the labels; where one is missing, nothing is known of its edge
[[nodiscard]] std::vector<BoneEvidence> measure_evidence(const GridView<const std::uint8_t>& labels,
                                                         const imaging::RegionTable& regions,
                                                         const GridView<const float>& edge_excess,
                                                         const GridView<const float>& smoothed_hu,
                                                         std::span<const LabelSurface> surfaces,
                                                         const anatomy::BoneNaming& naming);

/// The confidence by a logistic function of the evidence, with weights that were fitted on
/// simulated scans and judged on others (`carpus study segmentation`,
/// docs/decisions/0061-trust.md), and the reasons in words.
[[nodiscard]] BoneTrust judge(const BoneEvidence& evidence);

/// What the logistic function weighs, each 0 where a bone is as it should be; in a fixed order.
[[nodiscard]] std::vector<double> concerns_of(const BoneEvidence& evidence);
[[nodiscard]] const std::vector<std::string>& concern_names();

}  // namespace carpus::reconstruct
