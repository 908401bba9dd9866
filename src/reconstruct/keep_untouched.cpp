// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/keep_untouched.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/check.hpp"

namespace carpus::reconstruct {
namespace {

constexpr double kBesideMm = 1.5;  ///< of the profiles that bone_trust.cpp takes across a surface

}  // namespace

std::array<bool, 256> keep_untouched(const EarlierVersion& earlier,
                                     const Grid<std::uint8_t>& given,
                                     cases::CaseData& data) {
  CARPUS_CHECK(earlier.labels.values().size() == given.values().size());
  CARPUS_CHECK(data.labels.values().size() == given.values().size());
  std::array<bool, 256> is_kept{};
  for (cases::Bone& bone : data.bones) {
    const auto had = std::find_if(earlier.bones.begin(), earlier.bones.end(),
                                  [&](const auto& each) { return each.label == bone.label; });
    is_kept[bone.label] = had != earlier.bones.end();
  }
  for (std::size_t i = 0; i < given.values().size(); ++i) {
    if (earlier.labels[i] == given[i]) continue;
    is_kept[earlier.labels[i]] = false;
    is_kept[given[i]] = false;
  }
  for (std::size_t i = 0; i < given.values().size(); ++i) {
    std::uint8_t& label = data.labels[i];
    if (is_kept[given[i]]) {
      label = given[i];
    } else if (is_kept[label]) {
      label = 0;
    }
  }
  for (cases::Bone& bone : data.bones) {
    if (!is_kept[bone.label]) continue;
    for (const EarlierBone& had : earlier.bones) {
      if (had.label == bone.label) bone.surface = MeshIn<frame::Bone>(had.surface);
    }
  }
  return is_kept;
}

std::array<bool, 256> left_alone(const Grid<std::uint8_t>& before,
                                 const Grid<std::uint8_t>& given) {
  CARPUS_CHECK(before.values().size() == given.values().size());
  const GridGeometry& g = given.geometry();
  std::array<int, 3> reach{};
  const std::array<double, 3> spacing{g.spacing.x, g.spacing.y, g.spacing.z};
  for (std::size_t a = 0; a < 3; ++a) {
    reach[a] = static_cast<int>(std::ceil(kBesideMm / spacing[a]));
  }
  std::array<bool, 256> is_alone{};
  is_alone.fill(true);
  for (std::size_t i = 0; i < given.values().size(); ++i) {
    if (before[i] == given[i]) continue;
    is_alone[before[i]] = is_alone[given[i]] = false;
    const VoxelIndex v = g.index_of(i);
    // Lines suffice: what is near a change is near many.
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      for (int by = -reach[a]; by <= reach[a]; ++by) {
        const VoxelIndex beside{v.x + (axis == 0 ? by : 0), v.y + (axis == 1 ? by : 0),
                                v.z + (axis == 2 ? by : 0)};
        if (g.contains(beside)) is_alone[before[beside]] = is_alone[given[beside]] = false;
      }
    }
  }
  return is_alone;
}

}  // namespace carpus::reconstruct
