// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "soft_tissue/detail/force_lines.hpp"

#include <algorithm>

namespace carpus::soft_tissue::detail {
namespace {

double slack_of(const Ligament& l, const LineOptions& options) {
  if (l.group == "radiocarpal" || l.group == "ulnocarpal") return options.radiocarpal_slack_mm;
  return l.group == "midcarpal" ? options.midcarpal_slack_mm : 0;
}

/// Its parts between bodies; slack is shared by length.
void add_stretches(const ForceLine& line, std::vector<ForceLine>& lines) {
  const double whole = length_as_scanned(line);
  for (std::size_t i = 1; i < line.points.size(); ++i) {
    const double share = distance(line.points[i - 1].second, line.points[i].second) / whole;
    if (line.points[i - 1].first == line.points[i].first || !(share > 0)) continue;
    lines.push_back({line.ligament,
                     {line.points[i - 1], line.points[i]},
                     line.rest_mm * share,
                     line.stiffness_n_per_mm / share});
  }
}

}  // namespace

std::vector<ForceLine> make_force_lines(const cases::CaseData& data,
                                        const SoftTissue& tissue,
                                        const LineOptions& options) {
  std::vector<ForceLine> lines;
  for (std::size_t index = 0; index < tissue.ligaments.size(); ++index) {
    const Ligament& l = tissue.ligaments[index];
    if (std::any_of(options.without.begin(), options.without.end(),
                    [&](std::string_view cut) { return l.id.starts_with(cut); })) {
      continue;
    }
    for (const Strand& s : l.strands) {
      ForceLine line;
      line.ligament = index;
      line.stiffness_n_per_mm = s.stiffness_n_per_mm * options.stiffness_factor;
      for (const Anchor& anchor : s.anchors) {
        line.points.emplace_back(body_of_label(data, anchor.label), s.course[anchor.point]);
      }
      line.rest_mm = slack_of(l, options);
      for (std::size_t i = 1; i < line.points.size(); ++i) {
        line.rest_mm += distance(line.points[i - 1].second, line.points[i].second);
      }
      if (options.is_held_on_its_way) {
        add_stretches(line, lines);
      } else {
        lines.push_back(std::move(line));
      }
    }
  }
  return lines;
}

double length_as_scanned(const ForceLine& line) noexcept {
  double length = 0;
  for (std::size_t i = 1; i < line.points.size(); ++i) {
    length += distance(line.points[i - 1].second, line.points[i].second);
  }
  return length;
}

double length_now(const ForceLine& line, const Bodies& bodies) noexcept {
  double length = 0;
  for (std::size_t i = 1; i < line.points.size(); ++i) {
    const auto& [a, p] = line.points[i - 1];
    const auto& [b, q] = line.points[i];
    length += distance(bodies[a].at(p), bodies[b].at(q));
  }
  return length;
}

void pull_lines(std::span<const ForceLine> lines, const Bodies& bodies, Load& load) noexcept {
  for (const ForceLine& line : lines) {
    const double stretch = length_now(line, bodies) - line.rest_mm;
    if (stretch <= 0) continue;
    load.energy += 0.5 * line.stiffness_n_per_mm * stretch * stretch;
    for (std::size_t i = 1; i < line.points.size(); ++i) {
      const auto& [a, p] = line.points[i - 1];
      const auto& [b, q] = line.points[i];
      const Vec3 from = bodies[a].at(p);
      const Vec3 to = bodies[b].at(q);
      const Vec3 tension = normalized_or(to - from, {}) * (line.stiffness_n_per_mm * stretch);
      load.push(bodies, a, from, tension);
      load.push(bodies, b, to, -tension);
    }
  }
}

}  // namespace carpus::soft_tissue::detail
