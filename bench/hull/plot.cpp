// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/hull/plot.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "bench/chart/curve_chart.hpp"
#include "bench/chart/dot_chart.hpp"
#include "bench/chart/log_scale.hpp"
#include "bench/hull/growth.hpp"

namespace carpus::bench {
namespace {

/// How sets of points are told apart.
enum class Sets {
  OneSizeEach,  ///< each of its own size: the thesis's bones, one curve through all
  SameSize,     ///< each of one size that others have too: bones, a panel each
  ManySizes,    ///< several sizes of each: distributions
};

Sets kind_of(const std::vector<HullRow>& rows) {
  std::set<std::pair<std::string, std::size_t>> engines_and_sizes;
  std::map<std::string, std::set<std::size_t>> sizes;
  bool shares = false;
  for (const HullRow& row : rows) {
    shares = !engines_and_sizes.emplace(row.engine, row.n).second || shares;
    sizes[row.set].insert(row.n);
  }
  if (!shares) return Sets::OneSizeEach;
  const bool many = std::any_of(sizes.begin(), sizes.end(),
                                [](const auto& set) { return set.second.size() > 1; });
  return many ? Sets::ManySizes : Sets::SameSize;
}

/// To one digit: a lattice cannot have every number of points.
std::string about(std::size_t n) {
  const double power = std::pow(10, std::floor(std::log10(static_cast<double>(n))));
  return "n about " + count_label(std::round(static_cast<double>(n) / power) * power);
}

template <typename All, typename Matches, typename New>
auto& found_or_appended(All& all, Matches matches, New fresh) {
  const auto found = std::find_if(all.begin(), all.end(), matches);
  if (found != all.end()) return *found;
  all.push_back(fresh);
  return all.back();
}

/// One for each set that is not what its name says.
std::vector<std::string> notes_on(const std::vector<HullRow>& rows) {
  std::vector<std::string> notes;
  for (const HullRow& row : rows) {
    const std::string note = note_on(row.origin, row.n);
    if (note.empty()) continue;
    const std::string line = row.set + ": " + note;
    if (std::find(notes.begin(), notes.end(), line) == notes.end()) notes.push_back(line);
  }
  return notes;
}

std::string dots(const std::string& title, const std::vector<HullRow>& rows) {
  DotBlock block{"time of a hull", {}};
  for (const HullRow& row : rows) {
    DotPanel& panel = found_or_appended(
        block.panels, [&](const DotPanel& p) { return p.title == row.set; }, DotPanel{row.set, {}});
    panel.dots.push_back({row.engine, row.is_peer, row.ran ? row.seconds : 0, 0, row.agrees});
  }
  return dot_chart_svg(title, "median", {block}, notes_on(rows));
}

}  // namespace

std::string plot_svg(const std::string& title, const std::vector<HullRow>& rows, PlotAxis axis) {
  const Sets sets = kind_of(rows);
  const bool by_points = axis == PlotAxis::Points;
  if (sets == Sets::SameSize && by_points) return dots(title, rows);
  const ExactCorners corners(rows);
  std::vector<CurvePanel> panels;
  for (const HullRow& row : rows) {
    const std::size_t h = corners.of(row);
    if (!row.ran || h == 0) continue;
    const std::string name = sets != Sets::ManySizes ? "" : by_points ? row.set : about(row.n);
    CurvePanel& panel = found_or_appended(
        panels, [&](const CurvePanel& p) { return p.title == name; }, CurvePanel{name, {}});
    Curve& curve = found_or_appended(
        panel.curves, [&](const Curve& c) { return c.name == row.engine; },
        Curve{row.engine, row.is_peer, {}});
    curve.points.push_back({static_cast<double>(by_points ? row.n : h), row.seconds, row.agrees});
  }
  return curve_chart_svg(title, by_points ? "points n" : "corners h of the exact hull",
                         "median of repeated runs", panels, notes_on(rows));
}

}  // namespace carpus::bench
