// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/chart/ink.hpp"

#include "core/text_format.hpp"

namespace carpus::bench {
namespace {

constexpr double kTitleSize = 18;

}  // namespace

std::string sheet(double width, double height, const std::string& title, const std::string& body) {
  const double size = drawing::fitting_size(title, kTitleSize, width - 40);
  return drawing::page(width, height,
                       text_at(20, 30, title, {.size = size, .is_bold = true}) + body);
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
