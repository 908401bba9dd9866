// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How well a segmentation agrees with a ground truth.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "anatomy/bone_id.hpp"
#include "geometry/grid.hpp"

namespace carpus::reconstruct {

/// A label volume in this program's numbers (anatomy/bone_id.hpp).
struct GroundTruth {
  Grid<std::uint8_t> labels;
};

/// The label of a bone as truths name it: as name_of() does, and "scaphoid_distal_fragment";
/// kBackgroundLabel for what is no bone.
[[nodiscard]] std::uint8_t label_of_true_bone(std::string_view name);

/// Reads `file` and the numbers in labels.json beside it, {"radius": 1, ...}; without that file the
/// numbers of anatomy/bone_id.hpp hold. Names are those of name_of(); "scaphoid_distal_fragment"
/// and "nonunion_gap_tissue" are known too. Gap tissue is no bone. Labels without a name are
/// background.
/// @throws IoError, InvalidInput naming the file.
[[nodiscard]] GroundTruth read_ground_truth(const std::filesystem::path& file);

/// @throws InvalidInput if the truth does not lie on the CT's grid: ask before the work.
void require_same_grid(const GridGeometry& ct, const GroundTruth& truth);
/// The same of any labels. @param what  "the labels"
void require_same_grid(const GridGeometry& ct, const GridGeometry& labels, const std::string& what);

/// Agreement of one label: 2 |A and B| / (|A| + |B|) [dice1945measures].
struct LabelDice {
  std::uint8_t label = 0;
  std::size_t truth_voxels = 0;
  std::size_t found_voxels = 0;
  double dice = 0;
};

/// For each bone label (1 to 16) that the truth holds. 0 where the bone was not found.
/// @throws InvalidInput if the two volumes do not lie on the same grid.
[[nodiscard]] std::vector<LabelDice> compare_labels(const GridView<const std::uint8_t>& found,
                                                    const GroundTruth& truth);

}  // namespace carpus::reconstruct
