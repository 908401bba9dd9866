// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/hull/plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>

namespace carpus::bench {
namespace {

constexpr double kWidth = 900;
constexpr double kHeight = 560;
constexpr double kLeft = 80;
constexpr double kRight = 170;
constexpr double kTop = 50;
constexpr double kBottom = 60;

/// Colours that differ in lightness too, so that a grey print can be read.
constexpr std::array<const char*, 10> kColours{"#0b5fa5", "#c2571a", "#2a8a57", "#8a2be2",
                                               "#444444", "#b8860b", "#d6336c", "#1098ad",
                                               "#7a4419", "#000000"};

template <typename... Values>
std::string format(const char* pattern, Values... values) {
  std::array<char, 512> text{};
  std::snprintf(text.data(), text.size(), pattern, values...);
  return text.data();
}

struct Range {
  double low = 1e300;
  double high = -1e300;
  void include(double v) {
    low = std::min(low, v);
    high = std::max(high, v);
  }
};

std::string tick_label(double power) {
  return std::abs(power) <= 6
             ? format("%.*f", std::max(0, static_cast<int>(-power)), std::pow(10.0, power))
             : format("1e%.0f", power);
}

}  // namespace

std::string plot_svg(const std::string& title, const std::vector<HullRow>& rows, PlotAxis axis) {
  std::map<std::string, std::vector<std::pair<double, double>>> lines;
  Range x_range;
  Range y_range;
  for (const HullRow& row : rows) {
    if (!row.ran || row.h == 0) continue;
    const double x = std::log10(static_cast<double>(axis == PlotAxis::Points ? row.n : row.h));
    const double y = std::log10(row.seconds * 1e3);
    lines[row.engine].push_back({x, y});
    x_range.include(x);
    y_range.include(y);
  }
  if (lines.empty()) return {};
  y_range = {std::floor(y_range.low), std::ceil(y_range.high)};
  const double margin = std::max(0.05, 0.04 * (x_range.high - x_range.low));
  x_range = {x_range.low - margin, x_range.high + margin};
  const auto px = [&](double x) {
    return kLeft + (x - x_range.low) / (x_range.high - x_range.low) * (kWidth - kLeft - kRight);
  };
  const auto py = [&](double y) {
    return kHeight - kBottom -
           (y - y_range.low) / (y_range.high - y_range.low) * (kHeight - kTop - kBottom);
  };

  std::string svg = format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" "
      "font-family=\"sans-serif\" font-size=\"14\">\n<rect width=\"100%%\" height=\"100%%\" "
      "fill=\"white\"/>\n",
      kWidth, kHeight);
  svg += format("<text x=\"%.0f\" y=\"28\" font-size=\"17\">%s</text>\n", kLeft, title.c_str());
  for (double power = y_range.low; power <= y_range.high; ++power) {
    svg += format(
        "<line x1=\"%.0f\" x2=\"%.0f\" y1=\"%.1f\" y2=\"%.1f\" stroke=\"#ddd\"/><text x=\"%.0f\" "
        "y=\"%.1f\" text-anchor=\"end\">%s</text>\n",
        kLeft, kWidth - kRight, py(power), py(power), kLeft - 8, py(power) + 5,
        tick_label(power).c_str());
  }
  for (double power = std::ceil(x_range.low); power <= x_range.high; ++power) {
    svg += format(
        "<line x1=\"%.1f\" x2=\"%.1f\" y1=\"%.0f\" y2=\"%.0f\" stroke=\"#ddd\"/><text x=\"%.1f\" "
        "y=\"%.0f\" text-anchor=\"middle\">%s</text>\n",
        px(power), px(power), kTop, kHeight - kBottom, px(power), kHeight - kBottom + 20,
        tick_label(power).c_str());
  }
  svg += format("<text x=\"%.0f\" y=\"%.0f\" text-anchor=\"middle\">%s</text>\n",
                (kLeft + kWidth - kRight) / 2, kHeight - 14,
                axis == PlotAxis::Points ? "points n" : "hull vertices h");
  svg += format(
      "<text transform=\"translate(20 %.0f) rotate(-90)\" "
      "text-anchor=\"middle\">milliseconds</text>\n",
      kHeight / 2);
  std::size_t colour = 0;
  double legend_y = kTop + 10;
  for (auto& [engine, points] : lines) {
    std::sort(points.begin(), points.end());
    const char* stroke = kColours[colour++ % kColours.size()];
    svg += format("<polyline fill=\"none\" stroke-width=\"2\" stroke=\"%s\" points=\"", stroke);
    for (const auto& [x, y] : points) svg += format("%.1f,%.1f ", px(x), py(y));
    svg += "\"/>\n";
    for (const auto& [x, y] : points)
      svg += format("<circle r=\"3\" cx=\"%.1f\" cy=\"%.1f\" fill=\"%s\"/>", px(x), py(y), stroke);
    svg += format("\n<text x=\"%.0f\" y=\"%.0f\" fill=\"%s\">%s</text>\n", kWidth - kRight + 16,
                  legend_y, stroke, engine.c_str());
    legend_y += 20;
  }
  return svg + "</svg>\n";
}

}  // namespace carpus::bench
