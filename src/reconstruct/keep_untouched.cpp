// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/keep_untouched.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/check.hpp"

namespace carpus::reconstruct {

void keep_untouched(const EarlierVersion& earlier,
                    const Grid<std::uint8_t>& given,
                    cases::CaseData& data) {
  CARPUS_CHECK(earlier.labels.values().size() == given.values().size());
  CARPUS_CHECK(data.labels.values().size() == given.values().size());
  std::array<bool, 256> is_kept{};
  for (cases::Bone& bone : data.bones) {
    const auto had = std::find_if(earlier.surfaces.begin(), earlier.surfaces.end(),
                                  [&](const auto& each) { return each.label == bone.label; });
    is_kept[bone.label] = had != earlier.surfaces.end();
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
    for (const EarlierSurface& had : earlier.surfaces) {
      if (had.label == bone.label) bone.surface = MeshIn<frame::Bone>(had.surface);
    }
  }
}

}  // namespace carpus::reconstruct
