// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Markers for a watershed as a table of points, which a person can write by hand or save from a
// viewer.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "geometry/vec3.hpp"

namespace carpus::case_io {

struct MarkerPoint {
  int label = 1;  ///< 1 to 255
  Vec3 place;     ///< Patient (LPS) [mm]
  double radius_mm = 0;
};

/// Reads a .csv: a line holds label, x, y, z and, where the marker is a ball, its radius; in mm of
/// the Patient frame (LPS), separated by commas, semicolons or blanks. The first line may hold
/// names.
/// @throws IoError naming file and line: no file, a missing or odd number, a label or a radius out
/// of range, or no marker at all.
[[nodiscard]] std::vector<MarkerPoint> read_marker_points(const std::filesystem::path& file);

/// The same of bytes at hand.
[[nodiscard]] std::vector<MarkerPoint> parse_marker_points(std::string_view content,
                                                           const std::filesystem::path& file);

}  // namespace carpus::case_io
