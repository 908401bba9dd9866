// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/chart/curve_chart.hpp"

#include <algorithm>
#include <tuple>

#include "bench/chart/engine_pens.hpp"
#include "bench/chart/ink.hpp"
#include "bench/chart/log_scale.hpp"
#include "bench/chart/spread_labels.hpp"
#include "core/text_format.hpp"

namespace carpus::bench {
namespace {

constexpr double kMargin = 20;
constexpr double kTop = 76;       ///< title and legend
constexpr double kAxis = 56;      ///< left of a panel, its labels
constexpr double kHead = 28;      ///< a panel's title
constexpr double kFoot = 46;      ///< a panel's axis
constexpr double kPlot = 470;     ///< width of a panel's frame
constexpr double kLeader = 34;    ///< from the frame to the names
constexpr double kNames = 160;    ///< room for the names
constexpr double kLabel = 14;     ///< between names
constexpr double kLeast = 320;    ///< height of a panel's frame
constexpr double kCurve = 20;     ///< and no less than this for each curve
constexpr double kAcross = 56;    ///< between labels of the axis of counts
constexpr double kUpward = 30;    ///< and of that of seconds
constexpr std::size_t kMost = 2;  ///< panels side by side

std::string legend() {
  const double y = 52;
  double x = kMargin + 6;
  std::string svg;
  for (const auto& [text, is_peer, agrees] :
       {std::tuple{"ours", false, true}, std::tuple{"peer", true, true},
        std::tuple{"hollow: answers differ", false, false}}) {
    svg += mark_at(x, y, 3.5, is_peer, agrees, kQuietColour);
    svg += text_at(x + 10, y + 4, text, {.colour = kQuietColour});
    x += 36 + 6.6 * static_cast<double>(std::string_view(text).size());
  }
  return svg;
}

struct Frame {
  double left, right, top, bottom;
};

std::string draw_axes(const CurvePanel& panel,
                      const Frame& at,
                      const LogScale& x,
                      const LogScale& y,
                      const std::string& counted) {
  std::string svg = text_at(at.left, at.top - 10, panel.title, {.size = 13, .is_bold = true});
  for (const double tick : x.ticks(kAcross)) {
    svg += line_from(x.at(tick), at.top, x.at(tick), at.bottom, kGridColour);
    svg += text_at(x.at(tick), at.bottom + 16, count_label(tick), {Anchor::Middle, kQuietColour});
  }
  for (const double tick : y.ticks(kUpward)) {
    svg += line_from(at.left, y.at(tick), at.right, y.at(tick), kGridColour);
    svg += text_at(at.left - 6, y.at(tick) + 4, time_label(tick), {Anchor::End, kQuietColour});
  }
  svg += text_at((at.left + at.right) / 2, at.bottom + 34, counted, {Anchor::Middle});
  return svg;
}

std::string draw_curves(const CurvePanel& panel,
                        const Frame& at,
                        const LogScale& x,
                        const LogScale& y) {
  std::vector<double> wanted;
  for (const Curve& c : panel.curves) wanted.push_back(y.at(c.points.back().seconds));
  const std::vector<double> heights = spread_labels(wanted, kLabel, at.top, at.bottom);
  std::string svg;
  for (std::size_t i = 0; i < panel.curves.size(); ++i) {
    const Curve& c = panel.curves[i];
    const Pen pen = pen_of(c.name);
    std::string path;
    for (const CurvePoint& p : c.points)
      path += format("%.1f,%.1f ", x.at(p.count), y.at(p.seconds));
    svg += format("<polyline fill=\"none\" stroke-width=\"1.8\" stroke=\"%s\"%s points=\"%s\"/>\n",
                  pen.colour, pen.dash, path.c_str());
    for (const CurvePoint& p : c.points) {
      svg += mark_at(x.at(p.count), y.at(p.seconds), 2.6, c.is_peer, p.agrees, pen.colour);
    }
    // To its name: level to the frame, then to where there is room.
    svg += format(
        "<polyline fill=\"none\" stroke-width=\"0.7\" stroke=\"%s\" stroke-opacity=\"0.5\" "
        "points=\"%.1f,%.1f %.1f,%.1f %.1f,%.1f\"/>\n",
        pen.colour, x.at(c.points.back().count), wanted[i], at.right + 4, wanted[i],
        at.right + kLeader - 4, heights[i]);
    svg += text_at(at.right + kLeader, heights[i] + 4, c.name + (c.is_peer ? " (peer)" : ""),
                   {.colour = pen.colour});
  }
  return svg;
}

}  // namespace

std::string curve_chart_svg(const std::string& title,
                            const std::string& counted,
                            const std::string& measured,
                            const std::vector<CurvePanel>& panels,
                            const std::vector<std::string>& notes) {
  ValueRange counts;
  ValueRange seconds;
  std::vector<CurvePanel> shown;
  std::size_t most = 0;
  for (CurvePanel panel : panels) {
    std::erase_if(panel.curves, [](const Curve& c) { return c.points.empty(); });
    if (panel.curves.empty()) continue;
    most = std::max(most, panel.curves.size());
    for (Curve& c : panel.curves) {
      std::sort(c.points.begin(), c.points.end(),
                [](const CurvePoint& a, const CurvePoint& b) { return a.count < b.count; });
      for (const CurvePoint& p : c.points) {
        counts.include(p.count);
        seconds.include(p.seconds);
      }
    }
    shown.push_back(std::move(panel));
  }
  if (counts.is_empty() || seconds.is_empty()) return {};
  counts = counts.widened(1.15);
  seconds = seconds.widened(1.4);
  const std::size_t columns = std::min(kMost, shown.size());
  const double plot = shown.size() == 1 ? 1.5 * kPlot : kPlot;
  const double pitch = kAxis + plot + kLeader + kNames;
  const double tall = std::max(kLeast, kCurve * static_cast<double>(most));
  std::string svg = legend() + text_at(kMargin + 290, 56, measured, {.colour = kQuietColour});
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const double left = kMargin + kAxis + static_cast<double>(i % columns) * pitch;
    const double top = kTop + kHead + static_cast<double>(i / columns) * (kHead + tall + kFoot);
    const Frame at{left, left + plot, top, top + tall};
    const LogScale x(counts, at.left, at.right);
    const LogScale y(seconds, at.bottom, at.top);
    svg += draw_axes(shown[i], at, x, y, counted);
    svg += draw_curves(shown[i], at, x, y);
  }
  const std::size_t lines = (shown.size() + columns - 1) / columns;
  const double bottom = kTop + static_cast<double>(lines) * (kHead + tall + kFoot);
  return sheet(2 * kMargin + static_cast<double>(columns) * pitch,
               bottom + kNoteHeight * static_cast<double>(notes.size()) + kMargin / 2, title,
               svg + notes_at(kMargin + 6, bottom, notes));
}

}  // namespace carpus::bench
