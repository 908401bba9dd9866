// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a parser may do with any bytes: accept, or refuse in words. Anything else ends the run.
#pragma once

#include <cstdlib>
#include <string>

#include "core/error.hpp"
#include "image_formats/volume_header.hpp"

namespace carpus::fuzz {

inline void require(bool holds) {
  if (!holds) std::abort();
}

/// True where `parse` accepted; a refusal must name the file.
template <typename Parse>
bool accepts(const Parse& parse) {
  try {
    parse(image_formats::Refuser("fuzzed"));
    return true;
  } catch (const InvalidInput& error) {
    require(std::string(error.what()).starts_with("fuzzed: "));
  } catch (const IoError& error) {
    require(std::string(error.what()).starts_with("fuzzed: "));
  }
  return false;
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
