// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/hull/growth.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/text_format.hpp"

namespace carpus::bench {
namespace {

std::string line_of(const Growth& g) {
  std::string text = format("%-10s %-14s n^%.3f (n log n: n^%.3f) ", g.set.c_str(),
                            g.engine.c_str(), exponent_of(g.samples), n_log_n_exponent(g.samples));
  const std::vector<double> steps = g.steps();
  text += format(" %.0f", g.samples.front().count);
  for (std::size_t i = 0; i < steps.size(); ++i)
    text += format(" >%5.2f > %.0f", steps[i], g.samples[i + 1].count);
  return text + "\n";
}

}  // namespace

double exponent_of(const std::vector<GrowthSample>& samples) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (const GrowthSample& s : samples) {
    const double x = std::log(s.count);
    const double y = std::log(s.seconds);
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  const auto count = static_cast<double>(samples.size());
  return (count * sxy - sx * sy) / (count * sxx - sx * sx);
}

double n_log_n_exponent(const std::vector<GrowthSample>& samples) {
  std::vector<GrowthSample> ideal = samples;
  for (GrowthSample& s : ideal) s.seconds = s.count * std::log(s.count);
  return exponent_of(ideal);
}

std::vector<double> Growth::steps() const {
  std::vector<double> exponents;
  for (std::size_t i = 1; i < samples.size(); ++i)
    exponents.push_back(exponent_of({samples[i - 1], samples[i]}));
  return exponents;
}

std::vector<Growth> growth_with_points(const std::vector<HullRow>& rows) {
  std::map<std::pair<std::string, std::string>, std::vector<GrowthSample>> found;
  for (const HullRow& row : rows) {
    if (row.ran && row.seconds > 0)
      found[{row.set, row.engine}].push_back({static_cast<double>(row.n), row.seconds});
  }
  std::vector<Growth> all;
  for (auto& [key, samples] : found) {
    if (samples.size() < 3) continue;
    std::sort(samples.begin(), samples.end(),
              [](const GrowthSample& a, const GrowthSample& b) { return a.count < b.count; });
    all.push_back({key.first, key.second, std::move(samples)});
  }
  return all;
}

ExactCorners::ExactCorners(const std::vector<HullRow>& rows) {
  for (const HullRow& row : rows) {
    if (row.ran && row.agrees) corners_[{row.set, row.n}] = row.h;
  }
}

std::size_t ExactCorners::of(const HullRow& row) const {
  const auto found = corners_.find({row.set, row.n});
  return found == corners_.end() ? 0 : found->second;
}

std::string growth_text(const std::vector<HullRow>& rows) {
  std::string text =
      "growth of seconds with the number of points n, each distribution alone: fitted exponent; "
      "that of n log n over\n"
      "the same sizes; and the exponent of each step, in which a jump shows, as where a cache is "
      "full:\n";
  for (const Growth& g : growth_with_points(rows)) text += line_of(g);
  const ExactCorners corners(rows);
  std::map<std::pair<std::string, std::size_t>, std::vector<GrowthSample>> over_h;
  for (const HullRow& row : rows) {
    // A lattice has as many points as is nearest to a cube; its n is that of no other set.
    if (!row.ran || corners.of(row) == 0 || row.set == "lattice" || row.set == "scaphoid") continue;
    over_h[{row.engine, row.n}].push_back({static_cast<double>(corners.of(row)), row.seconds});
  }
  text += "growth with the number of corners h, over ball, cube, gaussian and sphere of one n:\n";
  for (const auto& [key, samples] : over_h) {
    if (samples.size() < 3) continue;
    text += format("n = %-9zu %-14s h^%.2f\n", key.second, key.first.c_str(), exponent_of(samples));
  }
  return text;
}

std::string brute_force_growth_of(const std::vector<HullRow>& rows, std::size_t whole) {
  std::vector<GrowthSample> samples;
  for (const HullRow& row : rows) {
    if (row.ran && row.engine == "brute_force")
      samples.push_back({static_cast<double>(row.n), row.seconds});
  }
  if (samples.size() < 3) return {};
  const double power = exponent_of(samples);
  const GrowthSample& most = samples.back();
  return format(
      "brute force: run on part of the points only (rows above); its seconds grow with n^%.2f, "
      "so that %zu points would take it about %.0f s (extrapolated, not run)\n",
      power, whole, most.seconds * std::pow(static_cast<double>(whole) / most.count, power));
}

}  // namespace carpus::bench
