// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/chart/dot_chart.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "bench/chart/ink.hpp"
#include "bench/chart/log_scale.hpp"

namespace carpus::bench {
namespace {

constexpr double kWidth = 1180;
constexpr double kLabels = 190;  ///< of the rows, left of the panels
constexpr double kMargin = 20;
constexpr double kGap = 22;  ///< between panels
constexpr double kRow = 16;
constexpr double kRadius = 4;
constexpr double kHead = 28;      ///< a panel's title
constexpr double kFoot = 40;      ///< a panel's axis
constexpr double kTop = 78;       ///< title and legend
constexpr double kSpacing = 46;   ///< between labels of an axis
constexpr std::size_t kMost = 3;  ///< panels side by side
constexpr double kGlyph = 7;      ///< width of a letter, generously
constexpr const char* kStripe = "#f4f5f7";

struct Row {
  std::string name;
  bool is_peer = false;
  double sum = 0;
  int panels = 0;
};

double fastest_of(const DotPanel& panel, bool peers_only) {
  double least = 0;
  for (const Dot& d : panel.dots) {
    if (d.seconds <= 0 || (peers_only && !d.is_peer)) continue;
    if (least == 0 || d.seconds < least) least = d.seconds;
  }
  return least;
}

std::vector<Row> rows_of(const DotBlock& block) {
  std::map<std::string, Row> found;
  for (const DotPanel& panel : block.panels) {
    const double least = fastest_of(panel, false);
    for (const Dot& d : panel.dots) {
      Row& row = found[d.row];
      row.name = d.row;
      row.is_peer = d.is_peer;
      if (d.seconds <= 0) continue;
      row.sum += std::log(d.seconds / least);
      ++row.panels;
    }
  }
  std::vector<Row> rows;
  for (auto& [name, row] : found) rows.push_back(row);
  std::stable_sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) {
    if (a.panels == 0 || b.panels == 0) return a.panels > b.panels;  // never run: last
    return a.sum / a.panels < b.sum / b.panels;
  });
  return rows;
}

std::string legend(const std::string& figure, bool has_p99) {
  std::string svg;
  double x = kMargin + 6;
  const double y = 54;
  const auto say = [&](const std::string& text, const char* colour) {
    svg += text_at(x + 10, y + 4, text, {.colour = colour});
    x += 34 + kGlyph * static_cast<double>(text.size());
  };
  svg += mark_at(x, y, kRadius, false, true, kOwnColour);
  say("ours, " + figure, kOwnColour);
  svg += mark_at(x, y, kRadius, true, true, kPeerColour);
  say("peer, " + figure, kPeerColour);
  svg += mark_at(x, y, kRadius, false, false, kQuietColour);
  x += 12;
  svg += mark_at(x, y, kRadius, true, false, kQuietColour);
  say("hollow: answers differ", kQuietColour);
  if (has_p99) {
    svg += line_from(x, y, x + 18, y, kQuietColour);
    x += 18;
    svg += line_from(x, y - 4, x, y + 4, kQuietColour, 2);
    say("p99", kQuietColour);
  }
  svg += line_from(x, y - 8, x, y + 8, kPeerColour);
  say("fastest peer by " + figure, kPeerColour);
  return svg;
}

/// A panel's place: left and right of its axis, top and bottom of its rows.
struct Frame {
  double left, right, top, bottom;
};

std::string draw_panel(const DotPanel& panel,
                       const std::vector<Row>& rows,
                       const ValueRange& range,
                       const Frame& at) {
  const LogScale scale(range, at.left, at.right);
  std::string svg = text_at(at.left, at.top - 10, panel.title, {.size = 13, .is_bold = true});
  for (const double tick : scale.ticks(kSpacing)) {
    svg += line_from(scale.at(tick), at.top, scale.at(tick), at.bottom, kGridColour);
    svg += text_at(scale.at(tick), at.bottom + 15, time_label(tick),
                   {Anchor::Middle, kQuietColour, 11});
  }
  svg += line_from(at.left, at.bottom, at.right, at.bottom, kQuietColour);
  if (const double peer = fastest_of(panel, true); peer > 0) {
    svg += line_from(scale.at(peer), at.top, scale.at(peer), at.bottom, kPeerColour);
  }
  for (const Dot& d : panel.dots) {
    const auto row =
        std::find_if(rows.begin(), rows.end(), [&](const Row& r) { return r.name == d.row; });
    const double y = at.top + kRow * (static_cast<double>(row - rows.begin()) + 0.5);
    if (d.seconds <= 0) {
      svg += text_at(at.left + 4, y + 4, "not run", {Anchor::Start, kQuietColour, 10});
      continue;
    }
    const char* colour = d.is_peer ? kPeerColour : kOwnColour;
    const double x = scale.at(d.seconds);
    if (d.p99 > 0) {
      svg += line_from(x, y, scale.at(d.p99), y, colour);
      svg += line_from(scale.at(d.p99), y - 4, scale.at(d.p99), y + 4, colour, 2);
    }
    svg += mark_at(x, y, kRadius, d.is_peer, d.agrees, colour);
  }
  return svg;
}

/// Rows' names and stripes of one line of panels.
std::string draw_rows(const std::vector<Row>& rows, double top, double right) {
  std::string svg;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double y = top + kRow * static_cast<double>(i);
    if (i % 2 == 0) {
      svg += line_from(kMargin, y + kRow / 2, right, y + kRow / 2, kStripe, kRow);
    }
    svg += text_at(kLabels, y + kRow / 2 + 4, rows[i].name + (rows[i].is_peer ? " (peer)" : ""),
                   {Anchor::End, rows[i].is_peer ? kPeerColour : kOwnColour});
  }
  return svg;
}

}  // namespace

std::string dot_chart_svg(const std::string& title,
                          const std::string& figure,
                          const std::vector<DotBlock>& blocks,
                          const std::vector<std::string>& notes) {
  std::string svg;
  bool has_p99 = false;
  double y = kTop;
  for (const DotBlock& block : blocks) {
    ValueRange range;
    for (const DotPanel& panel : block.panels) {
      for (const Dot& d : panel.dots) {
        range.include(d.seconds);
        range.include(d.p99);
        has_p99 = has_p99 || d.p99 > 0;
      }
    }
    if (range.is_empty()) continue;
    range = range.widened(1.3);
    const std::vector<Row> rows = rows_of(block);
    const std::size_t count = block.panels.size();
    const std::size_t lines = (count + kMost - 1) / kMost;
    const std::size_t columns = (count + lines - 1) / lines;
    const double panel_width = (kWidth - kLabels - kMargin) / static_cast<double>(columns) - kGap;
    svg += text_at(kMargin, y + 14, block.title, {.size = 15, .is_bold = true});
    y += 24;
    for (std::size_t line = 0; line < lines; ++line) {
      const double top = y + kHead;
      const double bottom = top + kRow * static_cast<double>(rows.size());
      svg += draw_rows(rows, top, kWidth - kMargin);
      for (std::size_t c = 0; c < columns && line * columns + c < count; ++c) {
        const double left = kLabels + kGap + static_cast<double>(c) * (panel_width + kGap);
        svg += draw_panel(block.panels[line * columns + c], rows, range,
                          {left, left + panel_width, top, bottom});
      }
      y = bottom + kFoot;
    }
  }
  if (svg.empty()) return svg;
  svg += notes_at(kMargin + 6, y, notes);
  return sheet(kWidth, y + kNoteHeight * static_cast<double>(notes.size()), title,
               legend(figure, has_p99) + svg);
}

}  // namespace carpus::bench
