// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Elements of SVG as text. Coordinates are units of the page's view box, y down, written to a
// tenth.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "geometry/predicates.hpp"

namespace carpus::drawing {

using Colour = std::array<double, 3>;  ///< red, green, blue, 0 to 1

/// #rrggbb; components are clamped to 0 to 1.
[[nodiscard]] std::string hex(const Colour& colour);

/// `body` on a white page, sans serif.
[[nodiscard]] std::string page(double width, double height, const std::string& body);

enum class Anchor { Start, Middle, End };

struct TextStyle {
  Anchor anchor = Anchor::Start;
  std::string_view colour = "#222222";
  double size = 12;
  bool is_bold = false;
  /// A white rim, so that the text can be read over lines.
  bool has_rim = false;
};

/// On the baseline y; what SVG means otherwise (names may hold < and &) is escaped.
[[nodiscard]] std::string text_at(double x,
                                  double y,
                                  std::string_view text,
                                  const TextStyle& style = {});

/// The largest size, at most `size`, at which a text is no wider than `width`, judged by the mean
/// width of bold letters: there is no font at hand to measure.
[[nodiscard]] double fitting_size(std::string_view text, double size, double width);

[[nodiscard]] std::string line_from(double x1,
                                    double y1,
                                    double x2,
                                    double y2,
                                    std::string_view colour,
                                    double width = 1);

[[nodiscard]] std::string disc_at(const Vec2& centre, double radius, std::string_view colour);

/// For the `d` of a path: one closed polygon, one line.
[[nodiscard]] std::string polygon_path(std::span<const Vec2> corners);
[[nodiscard]] std::string line_path(const Vec2& from, const Vec2& to);

struct Pen {
  std::string_view colour;
  double width = 1;
  double opacity = 1;
};
/// Strokes of one path with round ends; nothing for an empty path.
[[nodiscard]] std::string strokes(const std::string& path, const Pen& pen);

}  // namespace carpus::drawing
