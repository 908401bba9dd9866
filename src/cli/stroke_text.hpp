// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Words and numbers in a picture: letters of straight strokes, the project's own.
#pragma once

#include <string_view>

#include "cli/canvas.hpp"

namespace carpus::cli {

/// @param x, baseline  where the first letter stands [pixels].
/// @param height  of a capital [pixels]; letters that are not known are drawn as a box.
void draw_text(Canvas& canvas,
               double x,
               double baseline,
               double height,
               const Colour& colour,
               std::string_view text);

/// The width that draw_text takes [pixels].
[[nodiscard]] double text_width(double height, std::string_view text);

}  // namespace carpus::cli
