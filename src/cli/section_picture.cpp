// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/section_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "drawing/svg.hpp"

namespace carpus::cli {
namespace {

using drawing::Anchor;
using drawing::line_from;
using drawing::text_at;
using soft_tissue::MomentCurve;
using soft_tissue::RestingWrist;

constexpr double kWidth = 250;
constexpr double kHeight = 210;
constexpr double kLeft = 64;
constexpr double kTop = 118;
constexpr double kGapX = 56;
constexpr double kGapY = 84;
constexpr std::size_t kAcross = 4;
constexpr double kLeastDeg = 0;
constexpr double kMostDeg = 140;
constexpr const char* kGridColour = "#dddddd";
constexpr const char* kQuietColour = "#666666";
/// By cut, in the table's order; intact is black and bolder.
constexpr std::array<const char*, 8> kColours{"#111111", "#0b5fa5", "#c2571a", "#a3123f",
                                              "#2e8b57", "#7a5aa6", "#8a8a00", "#5f9ea0"};

std::string number(double value) { return std::to_string(static_cast<int>(std::lround(value))); }

std::string spaced(std::string id) {
  std::replace(id.begin(), id.end(), '_', ' ');
  return id;
}

struct Panel {
  double x = 0;
  double y = 0;
  double most_nm = 1;
  [[nodiscard]] double at_nm(double nm) const { return x + kWidth * nm / most_nm; }
  [[nodiscard]] double at_deg(double deg) const {
    return y + kHeight * (kMostDeg - std::clamp(deg, kLeastDeg, kMostDeg)) / (kMostDeg - kLeastDeg);
  }
};

std::string axes(const Panel& panel, const std::string& title) {
  std::string body = text_at(panel.x, panel.y - 12, title, {.size = 15, .is_bold = true});
  for (double nm = 0; nm <= panel.most_nm + 1e-9; nm += panel.most_nm / 4) {
    const double x = panel.at_nm(nm);
    body += line_from(x, panel.y, x, panel.y + kHeight, kGridColour);
    std::array<char, 16> text{};
    std::snprintf(text.data(), text.size(), "%.1f", nm);
    body += text_at(x, panel.y + kHeight + 16, text.data(), {.anchor = Anchor::Middle, .size = 11});
  }
  for (double deg = kLeastDeg; deg <= kMostDeg; deg += 20) {
    const double y = panel.at_deg(deg);
    body += line_from(panel.x, y, panel.x + kWidth, y, deg == 0 ? "#888888" : kGridColour);
    body += text_at(panel.x - 7, y + 4, number(deg), {.anchor = Anchor::End, .size = 11});
  }
  return body;
}

std::string curve_of(const Panel& panel,
                     const MomentCurve& curve,
                     const soft_tissue::BenchDirection& direction,
                     const char* colour,
                     double width) {
  std::string path;
  const RestingWrist* before = nullptr;
  for (const RestingWrist& w : curve.steps) {
    if (before != nullptr && before->is_settled && w.is_settled) {
      path += drawing::line_path(
          {panel.at_nm(before->moment_nm), panel.at_deg(before->hand.along(direction))},
          {panel.at_nm(w.moment_nm), panel.at_deg(w.hand.along(direction))});
    }
    before = &w;
  }
  return drawing::strokes(path, {colour, width, 0.9});
}

}  // namespace

std::string section_picture(const soft_tissue::SectioningResult& result,
                            const soft_tissue::SectioningTable& table) {
  const std::size_t rows = (table.directions.size() + 1 + kAcross - 1) / kAcross;
  std::string body =
      text_at(kLeft, 36, "The hand's turn against the moment on it, ligaments intact and cut",
              {.size = 20, .is_bold = true});
  body += text_at(kLeft, 60,
                  "up: degrees from the scan along the moment; across: N m. Simulated: bones and "
                  "generated strands, no muscles, tendons or skin",
                  {.colour = kQuietColour, .size = 13});
  const auto panel_at = [&](std::size_t i) {
    return Panel{kLeft + static_cast<double>(i % kAcross) * (kWidth + kGapX),
                 kTop + static_cast<double>(i / kAcross) * (kHeight + kGapY), table.moment_nm};
  };
  for (std::size_t d = 0; d < table.directions.size(); ++d) {
    const Panel panel = panel_at(d);
    body += axes(panel, spaced(table.directions[d].id));
    for (std::size_t c = result.wrists.size(); c-- > 0;) {  // intact on top
      body += curve_of(panel, result.wrists[c].curves[d], table.directions[d],
                       kColours[c % kColours.size()], c == 0 ? 3 : 1.8);
    }
  }
  const Panel legend = panel_at(table.directions.size());
  for (std::size_t c = 0; c < table.cuts.size(); ++c) {
    const double y = legend.y + 14 + 24 * static_cast<double>(c);
    body +=
        line_from(legend.x, y, legend.x + 34, y, kColours[c % kColours.size()], c == 0 ? 3 : 1.8);
    body += text_at(legend.x + 44, y + 5, (c == 0 ? "" : "cut: ") + table.cuts[c].name,
                    {.size = 14, .is_bold = c == 0});
  }
  return drawing::page(kLeft + static_cast<double>(kAcross) * (kWidth + kGapX),
                       kTop + static_cast<double>(rows) * (kHeight + kGapY) - 30, body);
}

}  // namespace carpus::cli
