// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "drawing/svg.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/text_format.hpp"

namespace carpus::drawing {
namespace {

constexpr double kBoldLetter = 0.6;  ///< mean width of one, of the size

std::string escaped(std::string_view text) {
  std::string svg;
  for (const char c : text) {
    if (c == '&') {
      svg += "&amp;";
    } else if (c == '<') {
      svg += "&lt;";
    } else {
      svg += c;
    }
  }
  return svg;
}

int byte(double value) { return static_cast<int>(std::lround(255 * std::clamp(value, 0.0, 1.0))); }

std::string point(const Vec2& p) { return format("%.1f %.1f", p.x, p.y); }

}  // namespace

std::string hex(const Colour& colour) {
  return format("#%02x%02x%02x", byte(colour[0]), byte(colour[1]), byte(colour[2]));
}

std::string page(double width, double height, const std::string& body) {
  return format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" "
             "font-family=\"sans-serif\">\n<rect width=\"100%%\" height=\"100%%\" "
             "fill=\"white\"/>\n",
             width, height) +
         body + "</svg>\n";
}

std::string text_at(double x, double y, std::string_view text, const TextStyle& style) {
  const char* anchor = style.anchor == Anchor::Start    ? "start"
                       : style.anchor == Anchor::Middle ? "middle"
                                                        : "end";
  return format(
             "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\" fill=\"%s\" font-size=\"%.4g\"%s%s>",
             x, y, anchor, std::string(style.colour).c_str(), style.size,
             style.is_bold ? " font-weight=\"bold\"" : "",
             style.has_rim ? " stroke=\"white\" stroke-width=\"6\" paint-order=\"stroke\"" : "") +
         escaped(text) + "</text>\n";
}

double fitting_size(std::string_view text, double size, double width) {
  const auto letters = static_cast<double>(std::max<std::size_t>(text.size(), 1));
  return std::min(size, width / (kBoldLetter * letters));
}

std::string line_from(double x1,
                      double y1,
                      double x2,
                      double y2,
                      std::string_view colour,
                      double width) {
  return format(
      "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"%s\" "
      "stroke-width=\"%.1f\"/>\n",
      x1, y1, x2, y2, std::string(colour).c_str(), width);
}

std::string disc_at(const Vec2& centre, double radius, std::string_view colour) {
  return format("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" fill=\"%s\"/>\n", centre.x, centre.y,
                radius, std::string(colour).c_str());
}

std::string polygon_path(std::span<const Vec2> corners) {
  std::string path;
  for (const Vec2& corner : corners) path += (path.empty() ? "M" : "L") + point(corner);
  return path + "Z";
}

std::string line_path(const Vec2& from, const Vec2& to) {
  return "M" + point(from) + "L" + point(to);
}

std::string strokes(const std::string& path, const Pen& pen) {
  if (path.empty()) return {};
  return format(
             "<path fill=\"none\" stroke=\"%s\" stroke-width=\"%.3g\" stroke-opacity=\"%.3g\" "
             "stroke-linecap=\"round\" d=\"",
             std::string(pen.colour).c_str(), pen.width, pen.opacity) +
         path + "\"/>\n";
}

}  // namespace carpus::drawing
