// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/chart/ink.hpp"

#include <algorithm>

#include "bench/text_format.hpp"

namespace carpus::bench {
namespace {

constexpr double kTitleSize = 18;
constexpr double kBoldLetter = 0.6;  ///< mean width of one, of the size

/// Names of folders may hold what SVG means otherwise.
std::string escaped(const std::string& text) {
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

}  // namespace

std::string sheet(double width, double height, const std::string& title, const std::string& body) {
  const double fitting =
      (width - 40) / (kBoldLetter * static_cast<double>(std::max<std::size_t>(title.size(), 1)));
  return format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" "
             "font-family=\"sans-serif\">\n<rect width=\"100%%\" height=\"100%%\" "
             "fill=\"white\"/>\n",
             width, height) +
         text_at(20, 30, title, {.size = std::min(kTitleSize, fitting), .is_bold = true}) + body +
         "</svg>\n";
}

std::string text_at(double x, double y, const std::string& text, TextStyle style) {
  const char* anchor = style.anchor == Anchor::Start    ? "start"
                       : style.anchor == Anchor::Middle ? "middle"
                                                        : "end";
  return format(
      "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\" fill=\"%s\" font-size=\"%.4g\"%s>%s</text>\n",
      x, y, anchor, style.colour, style.size, style.is_bold ? " font-weight=\"bold\"" : "",
      escaped(text).c_str());
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

std::string notes_at(double x, double top, const std::vector<std::string>& notes) {
  std::string svg;
  for (std::size_t i = 0; i < notes.size(); ++i) {
    svg += text_at(x, top + kNoteHeight * (static_cast<double>(i) + 0.6), notes[i],
                   {.colour = kQuietColour});
  }
  return svg;
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
