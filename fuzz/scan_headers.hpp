// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a parser of a scan's header promises.
#pragma once

#include "image_formats/volume_header.hpp"
#include "refusals.hpp"

namespace carpus::fuzz {

/// True where `parse` accepted; a refusal must name the file.
template <typename Parse>
bool accepts(const Parse& parse) {
  return reads_or_refuses("fuzzed: ", [&] { parse(image_formats::Refuser("fuzzed")); });
}

/// What every accepted header promises to those who read the voxels.
inline void require_usable(const image_formats::VolumeHeader& header) {
  const GridGeometry& g = header.geometry;
  double voxels = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    require(g.size[i] >= 1 && g.spacing[i] > 0.004 && g.spacing[i] < 21);
    voxels *= g.size[i];
  }
  require(voxels <= static_cast<double>(image_formats::kMostVoxels));
  require(is_finite(g.origin));
  for (std::size_t i = 0; i < 3; ++i) {
    require(length(g.direction.column(i)) > 0.999 && length(g.direction.column(i)) < 1.001);
  }
  require(header.data_file.empty() || image_formats::is_plain_file_name(header.data_file));
  require(header.slope != 0);
}

}  // namespace carpus::fuzz
