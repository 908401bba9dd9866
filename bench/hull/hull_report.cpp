// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/hull/hull_report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "bench/text_format.hpp"

namespace carpus::bench {
namespace {

std::vector<std::string> engines_of(const std::vector<HullRow>& rows) {
  std::vector<std::string> names;
  for (const HullRow& row : rows) {
    if (std::find(names.begin(), names.end(), row.engine) == names.end())
      names.push_back(row.engine);
  }
  return names;
}

std::string cell(const HullRow* row) {
  if (row == nullptr || !row->ran) return format("%14s", "not run");
  return format("%11.3f ms%s", row->seconds * 1e3, row->agrees ? " " : "!");
}

/// Slope of log(seconds) over log(n).
double exponent(const std::vector<std::pair<double, double>>& samples) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (const auto& [n, seconds] : samples) {
    const double x = std::log(n);
    const double y = std::log(seconds);
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  const auto count = static_cast<double>(samples.size());
  return (count * sxy - sx * sy) / (count * sxx - sx * sx);
}

}  // namespace

std::string text_of(const std::vector<HullRow>& rows) {
  const std::vector<std::string> engines = engines_of(rows);
  std::string text = format("%-18s %9s %8s", "points", "n", "h");
  for (const std::string& engine : engines) text += format("%14s", engine.c_str());
  text += "   fast against the best exact peer, any peer\n";
  using Key = std::pair<std::string, std::size_t>;
  std::vector<Key> order;
  std::map<Key, std::map<std::string, const HullRow*>> table;
  for (const HullRow& row : rows) {
    const Key key{row.set, row.n};
    if (table.find(key) == table.end()) order.push_back(key);
    table[key][row.engine] = &row;
  }
  for (const Key& key : order) {
    const auto& by_engine = table[key];
    std::size_t h = 0;
    double fast = 0;
    const HullRow& any = *by_engine.begin()->second;
    const std::string note = note_on(any.origin, any.n);
    double best_exact = std::numeric_limits<double>::infinity();
    double best = best_exact;
    for (const auto& [name, row] : by_engine) {
      if (!row->ran) continue;
      if (name == "fast") fast = row->seconds;
      if (name == "quickhull") h = row->h;
      if (row->is_peer) best = std::min(best, row->seconds);
      if (row->is_peer && name != "bullet") best_exact = std::min(best_exact, row->seconds);
    }
    text += format("%-18s %9zu %8zu", key.first.c_str(), key.second, h);
    for (const std::string& engine : engines) {
      const auto found = by_engine.find(engine);
      text += cell(found == by_engine.end() ? nullptr : found->second);
    }
    const auto ratio = [fast](double peer) {
      return fast > 0 && std::isfinite(peer) ? format("  %6.2f x", peer / fast) : "         -";
    };
    text += ratio(best_exact) + ratio(best) + (note.empty() ? "" : "  " + note) + "\n";
  }
  return text + "!: not the same corners, facets and volume as the exact answer\n";
}

std::string growth_of(const std::vector<HullRow>& rows) {
  using Samples = std::vector<std::pair<double, double>>;
  std::map<std::pair<std::string, std::string>, Samples> over_n;
  std::map<std::pair<std::string, std::size_t>, Samples> over_h;
  for (const HullRow& row : rows) {
    if (!row.ran || row.h == 0) continue;
    over_n[{row.set, row.engine}].push_back({static_cast<double>(row.n), row.seconds});
    // A lattice has as many points as is nearest to a cube; its n is that of no other set.
    if (row.set != "lattice" && row.set != "scaphoid")
      over_h[{row.engine, row.n}].push_back({static_cast<double>(row.h), row.seconds});
  }
  std::string text = "growth with the number of points n, each distribution alone:\n";
  for (const auto& [key, samples] : over_n) {
    if (samples.size() < 3) continue;
    text += format("%-10s %-14s seconds grow with n^%.2f\n", key.first.c_str(), key.second.c_str(),
                   exponent(samples));
  }
  text += "growth with the number of corners h, over ball, cube, gaussian and sphere of one n:\n";
  for (const auto& [key, samples] : over_h) {
    if (samples.size() < 3) continue;
    text += format("n = %-9zu %-14s seconds grow with h^%.2f\n", key.second, key.first.c_str(),
                   exponent(samples));
  }
  return text;
}

std::string brute_force_growth_of(const std::vector<HullRow>& rows, std::size_t whole) {
  std::vector<std::pair<double, double>> samples;
  for (const HullRow& row : rows) {
    if (row.ran && row.engine == "brute_force")
      samples.push_back({static_cast<double>(row.n), row.seconds});
  }
  if (samples.size() < 3) return {};
  const double power = exponent(samples);
  const auto& [n, seconds] = samples.back();
  return format(
      "brute force: run on part of the points only (rows above); its seconds grow with n^%.2f, "
      "so that %zu points would take it about %.0f s (extrapolated, not run)\n",
      power, whole, seconds * std::pow(static_cast<double>(whole) / n, power));
}

}  // namespace carpus::bench
