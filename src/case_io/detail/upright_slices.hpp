// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Slices of a tilted gantry: each lies beside the one before. They are moved back into a box.
#pragma once

#include <cstdint>
#include <string>

#include "geometry/grid.hpp"

namespace carpus::case_io {

/// How much farther along rows and columns each slice begins than the one before [pixels].
struct SliceDrift {
  double x = 0;
  double y = 0;
};

/// The volume on an upright grid that holds all of it: as large as the slices' whole reach, values
/// between pixels by linear interpolation, what no slice reaches as dark as the darkest of them.
/// @param slanted  values slice by slice; its geometry says where the first slice lies
/// @param path  of a slice, for the error
/// @throws IoError where the upright volume, larger than the slices, does not fit into memory, and
///     where the drift is none that a gantry has
[[nodiscard]] Grid<std::int16_t> set_upright(const Grid<std::int16_t>& slanted,
                                             const SliceDrift& drift,
                                             const std::string& path);

}  // namespace carpus::case_io
