// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/grow_paint.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "imaging/binary_mask.hpp"
#include "imaging/distance_transform.hpp"
#include "imaging/edge_excess.hpp"
#include "imaging/gaussian.hpp"
#include "imaging/peak_markers.hpp"
#include "imaging/watershed.hpp"

namespace carpus::reconstruct {
namespace {

using imaging::BoneSegmentationOptions;
using imaging::RegionLabel;
using Labels = Grid<std::uint8_t>;
using Flags = std::array<bool, 256>;

/// A bone all of whose parts hold foreign paint keeps what lies farther from it.
constexpr double kAwayFromPaintMm = 2;
/// The rim is found anew only so near to what changes: farther off a person may have drawn it.
constexpr double kNewRimMm = 2;
/// The outside's marker keeps so far off the bones, whose labels may be a little too small [mm].
constexpr double kOutsideFromBoneMm = 0.5;
/// Label of what is no bone, in the second flood.
constexpr RegionLabel kOutside = 256;

class Growth {
 public:
  Growth(const Grid<std::int16_t>& hu,
         const Grid<float>& smoothed,
         const Labels& before,
         const Labels& painted,
         const BoneSegmentationOptions& options)
      : hu_(hu), smoothed_(smoothed), before_(before), painted_(painted), options_(options) {
    for (std::size_t i = 0; i < before.values().size(); ++i) {
      if (!is_paint(i)) continue;
      touched_[before[i]] = touched_[painted[i]] = true;
      if (painted[i] != 0) loses_[before[i]] = true;
    }
    touched_[0] = loses_[0] = false;
  }

  Labels run() {
    find_mask();
    depth_ = imaging::distance_to_background(mask_.view());
    Grid<RegionLabel> regions = markers_by_depth();
    Grid<float> relief(depth_.geometry());
    for (std::size_t i = 0; i < relief.values().size(); ++i) relief[i] = -depth_[i];
    imaging::flood_from_markers(relief.view(), mask_.values(), {}, regions.view());
    find_what_changes(regions);
    keep_inner_parts(regions);
    const Grid<float> gradient = imaging::gradient_magnitude(hu_.view(), options_.edge_sigma_mm);
    imaging::flood_from_markers(gradient.view(), {}, {}, regions.view());
    return trimmed(regions);
  }

 private:
  [[nodiscard]] bool is_paint(std::size_t i) const { return before_[i] != painted_[i]; }

  /// Bones, and dense tissue that belongs to none and hangs together with the paint; not what was
  /// rubbed out.
  void find_mask() {
    Labels dense(before_.geometry());
    const auto threshold = static_cast<float>(options_.bone_threshold_hu);
    for (std::size_t i = 0; i < dense.values().size(); ++i) {
      const bool is_free = before_[i] == 0 && painted_[i] == 0;
      dense[i] = (is_free && smoothed_[i] > threshold) || is_paint(i) ? 1 : 0;
    }
    const imaging::Components components = imaging::connected_components(dense.view());
    std::vector<char> is_painted(components.voxels.size(), 0);
    for (std::size_t i = 0; i < dense.values().size(); ++i) {
      if (is_paint(i) && painted_[i] != 0) is_painted[components.labels[i]] = 1;
    }
    is_painted.front() = 0;
    mask_ = Labels(before_.geometry());
    for (std::size_t i = 0; i < mask_.values().size(); ++i) {
      const bool is_new = is_painted[components.labels[i]] != 0;
      const bool is_rubbed_out = is_paint(i) && painted_[i] == 0;
      mask_[i] = (painted_[i] != 0 || is_new) && !is_rubbed_out ? 1 : 0;
    }
  }

  Grid<RegionLabel> markers_by_depth() {
    Grid<RegionLabel> markers(before_.geometry());
    for (std::size_t i = 0; i < markers.values().size(); ++i) {
      const std::uint8_t label = painted_[i];
      if (label != 0 && (is_paint(i) || !loses_[label])) markers[i] = label;
    }
    for (std::size_t label = 1; label < loses_.size(); ++label) {
      if (loses_[label]) keep_deepest_part(static_cast<std::uint8_t>(label), markers);
    }
    return markers;
  }

  /// The deepest peak of a bone in whose surroundings nobody painted another one.
  void keep_deepest_part(std::uint8_t label, Grid<RegionLabel>& markers) const {
    Labels own(before_.geometry());
    for (std::size_t i = 0; i < own.values().size(); ++i) own[i] = before_[i] == label ? 1 : 0;
    const std::vector<std::size_t> peaks = imaging::prominent_peaks(
        depth_.view(), own.view(), {options_.peak_prominence_mm, options_.peak_height_mm});
    constexpr std::size_t kMostPeaks = 60000;  // fits a RegionLabel
    Grid<RegionLabel> basins(before_.geometry());
    const std::size_t count = std::min(peaks.size(), kMostPeaks);
    for (std::size_t k = 0; k < count; ++k) basins[peaks[k]] = static_cast<RegionLabel>(k + 1);
    Grid<float> relief(depth_.geometry());
    for (std::size_t i = 0; i < relief.values().size(); ++i) relief[i] = -depth_[i];
    imaging::flood_from_markers(relief.view(), own.values(), {}, basins.view());
    std::vector<char> is_foreign(count + 1, 0);
    for (std::size_t i = 0; i < basins.values().size(); ++i) {
      if (own[i] != 0 && is_paint(i) && painted_[i] != 0) is_foreign[basins[i]] = 1;
    }
    for (std::size_t k = 0; k < count; ++k) {  // deepest first
      if (is_foreign[k + 1] != 0) continue;
      markers[peaks[k]] = label;
      return;
    }
    keep_what_is_away(label, markers);
  }

  void keep_what_is_away(std::uint8_t label, Grid<RegionLabel>& markers) const {
    Labels unpainted(before_.geometry());
    for (std::size_t i = 0; i < unpainted.values().size(); ++i) unpainted[i] = is_paint(i) ? 0 : 1;
    const Grid<float> away = imaging::distance_to_background(unpainted.view());
    for (std::size_t i = 0; i < markers.values().size(); ++i) {
      if (painted_[i] == label && static_cast<double>(away[i]) > kAwayFromPaintMm) {
        markers[i] = label;
      }
    }
  }

  void find_what_changes(const Grid<RegionLabel>& regions) {
    Labels is_same(before_.geometry());
    for (std::size_t i = 0; i < is_same.values().size(); ++i) {
      is_same[i] = !is_paint(i) && regions[i] == before_[i] ? 1 : 0;
    }
    from_change_ = imaging::distance_to_background(is_same.view());
  }

  /// What was painted, other bones, and what lies far from any change.
  [[nodiscard]] bool is_fixed(std::size_t i) const {
    const std::uint8_t label = painted_[i];
    return is_paint(i) || (label != 0 && !touched_[label]) ||
           static_cast<double>(from_change_[i]) > kNewRimMm;
  }

  /// For the second flood: bones that were touched keep their inside.
  void keep_inner_parts(Grid<RegionLabel>& regions) const {
    const Grid<float> from_bone = imaging::distance_to_value(mask_.view(), 1);
    for (std::size_t i = 0; i < regions.values().size(); ++i) {
      if (is_fixed(i)) {
        regions[i] = painted_[i] == 0 ? kOutside : painted_[i];
      } else if (mask_[i] == 0) {
        regions[i] =
            static_cast<double>(from_bone[i]) > kOutsideFromBoneMm ? kOutside : RegionLabel{0};
      } else if (!(static_cast<double>(depth_[i]) > options_.marker_depth_mm)) {
        regions[i] = 0;
      }
    }
  }

  [[nodiscard]] Labels trimmed(const Grid<RegionLabel>& regions) const {
    const float soft_tissue = imaging::median_soft_tissue(smoothed_.view(), mask_.view());
    const Grid<float> excess =
        imaging::measure_edge_excess(smoothed_.view(), mask_.view(), soft_tissue, options_);
    Labels labels(before_.geometry());
    for (std::size_t i = 0; i < labels.values().size(); ++i) {
      const RegionLabel region = regions[i];
      if (region == 0 || region == kOutside) continue;
      const auto label = static_cast<std::uint8_t>(region);
      const bool is_rim = static_cast<double>(depth_[i]) <= options_.rim_depth_mm && excess[i] < 0;
      if (is_fixed(i) || !is_rim) labels[i] = label;
    }
    return without_crumbs(labels);
  }

  /// Of a bone that was touched stays what hangs together with the largest piece or with paint.
  [[nodiscard]] Labels without_crumbs(const Labels& labels) const {
    Labels kept = labels;
    for (std::size_t label = 1; label < touched_.size(); ++label) {
      if (!touched_[label]) continue;
      Labels own(labels.geometry());
      for (std::size_t i = 0; i < own.values().size(); ++i) own[i] = labels[i] == label ? 1 : 0;
      const imaging::Components pieces = imaging::connected_components(own.view());
      std::vector<char> stays(pieces.voxels.size(), 0);
      stays[pieces.largest()] = 1;
      for (std::size_t i = 0; i < own.values().size(); ++i) {
        if (is_paint(i) && painted_[i] == label) stays[pieces.labels[i]] = 1;
      }
      for (std::size_t i = 0; i < own.values().size(); ++i) {
        if (own[i] != 0 && stays[pieces.labels[i]] == 0) kept[i] = 0;
      }
    }
    return kept;
  }

  const Grid<std::int16_t>& hu_;
  const Grid<float>& smoothed_;
  const Labels& before_;
  const Labels& painted_;
  const BoneSegmentationOptions& options_;
  Flags touched_{};
  Flags loses_{};  ///< bones of which another one was painted on a part
  Labels mask_;
  Grid<float> depth_;
  Grid<float> from_change_;  ///< [mm]
};

}  // namespace

Labels grow_paint(const Grid<std::int16_t>& hu,
                  const Grid<float>& smoothed,
                  const Labels& before,
                  const Labels& painted,
                  const BoneSegmentationOptions& options) {
  return Growth(hu, smoothed, before, painted, options).run();
}

}  // namespace carpus::reconstruct
