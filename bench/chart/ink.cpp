// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/chart/ink.hpp"

#include "bench/text_format.hpp"

namespace carpus::bench {

std::string sheet(double width, double height, const std::string& title, const std::string& body) {
  return format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" "
             "font-family=\"sans-serif\">\n<rect width=\"100%%\" height=\"100%%\" "
             "fill=\"white\"/>\n",
             width, height) +
         text_at(20, 30, title, {.size = 18, .is_bold = true}) + body + "</svg>\n";
}

std::string text_at(double x, double y, const std::string& text, TextStyle style) {
  const char* anchor = style.anchor == Anchor::Start    ? "start"
                       : style.anchor == Anchor::Middle ? "middle"
                                                        : "end";
  return format(
      "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\" fill=\"%s\" font-size=\"%.0f\"%s>%s</text>\n",
      x, y, anchor, style.colour, style.size, style.is_bold ? " font-weight=\"bold\"" : "",
      text.c_str());
}

std::string line_from(double x1,
                      double y1,
                      double x2,
                      double y2,
                      const char* colour,
                      double width) {
  return format(
      "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"%s\" "
      "stroke-width=\"%.1f\"/>\n",
      x1, y1, x2, y2, colour, width);
}

std::string mark_at(double x,
                    double y,
                    double radius,
                    bool is_peer,
                    bool agrees,
                    const char* colour) {
  const std::string paint = format("fill=\"%s\" stroke=\"%s\" stroke-width=\"1.5\"/>\n",
                                   agrees ? colour : "white", colour);
  if (!is_peer) return format("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" ", x, y, radius) + paint;
  const double half = radius * 0.9;  // a square of the circle's area looks as large
  return format("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" ", x - half, y - half,
                2 * half, 2 * half) +
         paint;
}

}  // namespace carpus::bench
