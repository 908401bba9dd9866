// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>

#include "bench/collision/report.hpp"

namespace carpus::bench {
namespace {

constexpr double kWidth = 980;
constexpr double kHeight = 600;
constexpr double kLeft = 80;
constexpr double kRight = 210;
constexpr double kTop = 50;
constexpr double kBottom = 70;

/// Colours that differ in lightness too, so that a grey print can be read.
constexpr std::array<const char*, 12> kColours{"#0b5fa5", "#c2571a", "#2a8a57", "#8a2be2",
                                               "#444444", "#b8860b", "#d6336c", "#1098ad",
                                               "#7a4419", "#000000", "#5c940d", "#364fc7"};

struct Range {
  double low = 1e300;
  double high = -1e300;
  void include(double v) {
    low = std::min(low, v);
    high = std::max(high, v);
  }
  [[nodiscard]] double share(double v) const { return (v - low) / (high - low); }
};

struct Line {
  bool is_peer = false;
  std::vector<std::pair<double, double>> points;
};

double px(const Range& x, double v) { return kLeft + x.share(v) * (kWidth - kLeft - kRight); }
double py(const Range& y, double v) {
  return kHeight - kBottom - y.share(v) * (kHeight - kTop - kBottom);
}

std::string axes(const std::string& title,
                 const Range& x,
                 const Range& y,
                 const std::string& label) {
  std::string svg = format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" "
      "font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"100%%\" height=\"100%%\" "
      "fill=\"white\"/>\n<text x=\"%.0f\" y=\"28\" font-size=\"17\">%s</text>\n",
      kWidth, kHeight, kLeft, title.c_str());
  for (double power = y.low; power <= y.high + 1e-9; ++power) {
    svg += format(
        "<line x1=\"%.0f\" x2=\"%.0f\" y1=\"%.1f\" y2=\"%.1f\" stroke=\"#ddd\"/><text x=\"%.0f\" "
        "y=\"%.1f\" text-anchor=\"end\">%g</text>\n",
        kLeft, kWidth - kRight, py(y, power), py(y, power), kLeft - 8, py(y, power) + 5,
        std::pow(10.0, power));
  }
  svg += format("<text x=\"%.0f\" y=\"%.0f\" text-anchor=\"middle\">%s</text>\n",
                (kLeft + kWidth - kRight) / 2, kHeight - 12, label.c_str());
  svg += format(
      "<text transform=\"translate(20 %.0f) rotate(-90)\" "
      "text-anchor=\"middle\">microseconds, median</text>\n",
      kHeight / 2);
  (void)x;
  return svg;
}

std::string x_label(const Range& x, double at, const std::string& text) {
  return format(
      "<line x1=\"%.1f\" x2=\"%.1f\" y1=\"%.0f\" y2=\"%.0f\" stroke=\"#ddd\"/><text x=\"%.1f\" "
      "y=\"%.0f\" text-anchor=\"middle\">%s</text>\n",
      px(x, at), px(x, at), kTop, kHeight - kBottom, px(x, at), kHeight - kBottom + 20,
      text.c_str());
}

}  // namespace

std::string collision_plot_svg(const std::string& title,
                               const std::vector<CollisionRow>& rows,
                               CollisionAxis axis) {
  const bool against_facets = axis != CollisionAxis::Cases;
  std::map<std::string, Line> lines;
  std::vector<std::string> cases;
  Range x;
  Range y;
  for (const CollisionRow& row : rows) {
    if (!row.ran || row.timing.median <= 0) continue;
    if (axis == CollisionAxis::Vertices && row.pose_case.ends_with(" warm")) continue;
    const std::string column = row.pose_case + (row.query == "tick_distance" ? ", distance" : "");
    auto at = std::find(cases.begin(), cases.end(), column);
    if (at == cases.end()) at = cases.insert(cases.end(), column);
    const double place =
        against_facets
            ? std::log10(axis == CollisionAxis::Facets ? row.facets
                                                       : static_cast<double>(row.original_vertices))
            : static_cast<double>(at - cases.begin());
    const double height = std::log10(row.timing.median * 1e6);
    Line& line = lines[row.engine + (axis == CollisionAxis::Facets ? " " + row.pose_case : "")];
    line.is_peer = row.is_peer;
    line.points.emplace_back(place, height);
    x.include(place);
    y.include(height);
  }
  if (lines.empty()) return {};
  y = {std::floor(y.low), std::ceil(y.high)};
  x = {x.low - 0.05 * (x.high - x.low + 1), x.high + 0.05 * (x.high - x.low + 1)};
  std::string svg = axes(title, x, y,
                         axis == CollisionAxis::Facets     ? "facets of each body"
                         : axis == CollisionAxis::Vertices ? "vertices of the bone's surface"
                                                           : "");
  if (against_facets) {
    for (const double value : {100.0, 200.0, 500.0, 1e3, 2e3, 3e3, 1e4, 3e4, 1e5}) {
      const double at = std::log10(value);
      if (at >= x.low && at <= x.high) svg += x_label(x, at, format("%.0f", value));
    }
  } else {
    for (std::size_t i = 0; i < cases.size(); ++i) {
      svg += x_label(x, static_cast<double>(i), cases[i]);
    }
  }
  std::size_t colour = 0;
  double legend_y = kTop;
  const double spacing = std::min(18.0, (kHeight - kTop - 10) / static_cast<double>(lines.size()));
  for (auto& [engine, line] : lines) {
    std::sort(line.points.begin(), line.points.end());
    const char* stroke = kColours[colour++ % kColours.size()];
    svg += format("<polyline fill=\"none\" stroke-width=\"2\" stroke=\"%s\"%s points=\"", stroke,
                  line.is_peer ? " stroke-dasharray=\"6 4\"" : "");
    for (const auto& [px_at, py_at] : line.points) {
      svg += format("%.1f,%.1f ", px(x, px_at), py(y, py_at));
    }
    svg += "\"/>\n";
    svg += format("<text x=\"%.0f\" y=\"%.1f\" fill=\"%s\" font-size=\"%.0f\">%s%s</text>\n",
                  kWidth - kRight + 14, legend_y, stroke, std::min(13.0, spacing), engine.c_str(),
                  line.is_peer ? " (peer)" : "");
    legend_y += spacing;
  }
  return svg + "</svg>\n";
}

}  // namespace carpus::bench
