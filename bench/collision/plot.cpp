// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "bench/chart/curve_chart.hpp"
#include "bench/chart/dot_chart.hpp"
#include "bench/collision/report.hpp"

namespace carpus::bench {
namespace {

/// The one with that title, appended where there is none: panels keep the rows' order.
template <typename Titled>
Titled& titled(std::vector<Titled>& all, const std::string& title) {
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Titled& t) { return t.title == title; });
  if (found != all.end()) return *found;
  all.push_back({title, {}});
  return all.back();
}

Curve& curve_of(CurvePanel& panel, const CollisionRow& row) {
  const auto found = std::find_if(panel.curves.begin(), panel.curves.end(),
                                  [&](const Curve& c) { return c.name == row.engine; });
  if (found != panel.curves.end()) return *found;
  panel.curves.push_back({row.engine, row.is_peer, {}});
  return panel.curves.back();
}

std::string block_title(const std::string& query) {
  if (query == "boolean") return "boolean: do two bodies meet? Time of a query";
  if (query == "distance") return "distance: how far apart? Time of a query";
  if (query == "depth") return "depth: how deep in each other? Time of a query";
  if (query == "tick_boolean") return "tick_boolean: which pairs meet? Time of a tick of all pairs";
  return "tick_distance: how far apart? Time of a tick of all pairs";
}

std::string curves(const std::string& title,
                   const std::vector<CollisionRow>& rows,
                   CollisionAxis axis) {
  const bool is_facets = axis == CollisionAxis::Facets;
  std::vector<CurvePanel> panels;
  for (const CollisionRow& row : rows) {
    if (!row.ran || (!is_facets && row.pose_case.ends_with(" warm"))) continue;
    CurvePanel& panel = titled(panels, is_facets ? row.pose_case : "cold");
    const double count = is_facets ? row.facets : static_cast<double>(row.original_vertices);
    curve_of(panel, row).points.push_back({count, row.timing.mean, row.agrees});
  }
  return curve_chart_svg(title,
                         is_facets ? "facets of each body" : "vertices of the bone's surface",
                         "mean of a query", panels);
}

}  // namespace

std::string collision_plot_svg(const std::string& title,
                               const std::vector<CollisionRow>& rows,
                               CollisionAxis axis) {
  if (axis != CollisionAxis::Cases) return curves(title, rows, axis);
  std::vector<DotBlock> blocks;
  for (const CollisionRow& row : rows) {
    DotPanel& panel = titled(titled(blocks, block_title(row.query)).panels, row.pose_case);
    panel.dots.push_back({row.engine, row.is_peer, row.ran ? row.timing.mean : 0,
                          row.ran ? row.timing.p99 : 0, row.agrees});
  }
  return dot_chart_svg(title, "mean", blocks);
}

}  // namespace carpus::bench
