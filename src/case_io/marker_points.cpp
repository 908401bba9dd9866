// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/marker_points.hpp"

#include <cstdint>

#include "case_io/detail/regular_file.hpp"
#include "case_io/detail/text_lines.hpp"
#include "core/error.hpp"

namespace carpus::case_io {
namespace {

constexpr std::int64_t kMostLabel = 255;  // what a label volume holds
constexpr double kMostRadiusMm = 500;     // no scan of a wrist is larger

}  // namespace

std::vector<MarkerPoint> read_marker_points(const std::filesystem::path& file) {
  return parse_marker_points(read_whole_file(file), file);
}

std::vector<MarkerPoint> parse_marker_points(std::string_view content,
                                             const std::filesystem::path& file) {
  TextLines lines(file, content, " \t\r,;");
  std::vector<MarkerPoint> markers;
  for (bool is_first = true; lines.next(); is_first = false) {
    if (is_first && !lines.is_number(0)) continue;  // names of the columns
    const std::int64_t label = lines.integer(0);
    if (label < 1 || label > kMostLabel) lines.refuse("a label has to be from 1 to 255");
    MarkerPoint marker;
    marker.label = static_cast<int>(label);
    marker.place = {lines.number(1), lines.number(2), lines.number(3)};
    if (lines.words().size() > 4) marker.radius_mm = lines.number(4);
    if (marker.radius_mm < 0 || marker.radius_mm > kMostRadiusMm) {
      lines.refuse("a radius has to be from 0 to 500 mm");
    }
    if (lines.words().size() > 5) lines.refuse("more than label, x, y, z and radius");
    markers.push_back(marker);
  }
  if (markers.empty()) {
    throw IoError(file.string() + ": holds no marker; give lines of label, x, y, z, radius (mm)");
  }
  return markers;
}

}  // namespace carpus::case_io
