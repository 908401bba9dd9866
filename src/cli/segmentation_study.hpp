// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Simulated scans of growing difficulty, segmented, compared with their truth, and whether what
// went wrong was told.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "anatomy/bone_id.hpp"
#include "reconstruct/bone_trust.hpp"

namespace carpus::cli {

/// A bone with less is one that went wrong.
inline constexpr double kGoodDice = 0.95;
inline constexpr int kDifficulties = 5;

/// One bone of a scan's truth.
struct StudiedBone {
  std::uint8_t label = 0;
  double dice = 0;
  bool is_found = false;  ///< otherwise it is said to be missing, or the scan was refused
  reconstruct::BoneEvidence evidence;
  reconstruct::BoneTrust trust;

  [[nodiscard]] bool is_wrong() const { return dice < kGoodDice; }
  [[nodiscard]] bool is_told() const { return !is_found || trust.flagged; }
};

struct StudiedScan {
  std::uint64_t seed = 0;
  double voxel_mm = 0;
  int difficulty = 0;                   ///< how many conditions at once, and how severe
  std::vector<std::string> conditions;  ///< with their severity
  std::string refused;                  ///< why, where it was
  bool is_side_right = false;
  double naming_cost = 0;
  std::vector<StudiedBone> bones;
};

/// Of a seed's scan, where none is asked for: of ten seeds four have 0.7 mm, and two each 0.6, 0.5
/// and 0.4.
[[nodiscard]] double study_voxel_mm(std::uint64_t seed);
/// Simulates and segments the scan of one seed, with cubic voxels of `voxel_mm`.
[[nodiscard]] StudiedScan study_scan(std::uint64_t seed, double voxel_mm);

/// How well the flag finds what went wrong.
struct FlagFigures {
  std::size_t bones = 0;
  std::size_t wrong = 0;
  std::size_t told = 0;          ///< of the wrong ones
  std::size_t wrong_found = 0;   ///< of the wrong ones, neither missing nor in a refused scan
  std::size_t flagged = 0;       ///< of those
  std::size_t false_alarms = 0;  ///< of the right ones
  double mean_dice = 0;
  double worst_dice = 1;
  std::optional<double> auc;  ///< of the confidence; none without both kinds

  [[nodiscard]] double detection() const {
    return wrong > 0 ? static_cast<double>(told) / static_cast<double>(wrong) : 1.0;
  }
  /// Of what is there, by the flag alone.
  [[nodiscard]] double flag_detection() const {
    return wrong_found > 0 ? static_cast<double>(flagged) / static_cast<double>(wrong_found) : 1.0;
  }
  [[nodiscard]] double false_alarm_rate() const {
    return bones > wrong ? static_cast<double>(false_alarms) / static_cast<double>(bones - wrong)
                         : 0.0;
  }
};

/// Over the scans that are asked for.
[[nodiscard]] FlagFigures figures_of(const std::vector<StudiedScan>& scans,
                                     const std::function<bool(const StudiedScan&)>& is_asked_for);

struct SegmentationStudy {
  std::vector<StudiedScan> scans;
};

/// One scan as one line of JSON, with all that was measured, and back: a study that was stopped
/// goes on from its lines. What was measured is judged anew.
/// @throws InvalidInput naming `file`.
[[nodiscard]] std::string row_of(const StudiedScan& scan);
[[nodiscard]] SegmentationStudy study_of_rows(const std::string& text, const std::string& file);

[[nodiscard]] std::string segmentation_study_text(const SegmentationStudy& study);
/// docs/json.md.
[[nodiscard]] std::string segmentation_study_json(const SegmentationStudy& study);
/// Each bone as a mark, confidence over Dice, as SVG.
[[nodiscard]] std::string segmentation_study_picture(const SegmentationStudy& study);

}  // namespace carpus::cli
