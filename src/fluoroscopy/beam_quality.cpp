// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "fluoroscopy/beam_quality.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace carpus::fluoroscopy {
namespace {

struct Row {
  double kev;
  double water;  ///< cm2/g
  double bone;   ///< cortical, ICRU-44
  double iron;
};
constexpr std::array<Row, 3> kTable{
    {{30, 0.3756, 1.331, 8.176}, {40, 0.2683, 0.6655, 3.629}, {50, 0.2269, 0.4242, 1.958}}};
constexpr double kBoneDensity = 1.92;
constexpr double kUsualKev = 40;

struct Setting {
  double kv;
  double kev;
};
constexpr std::array<Setting, 3> kSettings{{{50, 35}, {60, kUsualKev}, {70, 44}}};

/// On the straight line through two points of a log-log plot.
double between(double kev, double kev_a, double a, double kev_b, double b) noexcept {
  const double share = std::log(kev / kev_a) / std::log(kev_b / kev_a);
  return a * std::pow(b / a, share);
}

Row row_at(double kev) noexcept {
  const std::size_t i = kev < kTable[1].kev ? 0 : 1;
  const Row& a = kTable[i];
  const Row& b = kTable[i + 1];
  return {kev, between(kev, a.kev, a.water, b.kev, b.water),
          between(kev, a.kev, a.bone, b.kev, b.bone), between(kev, a.kev, a.iron, b.kev, b.iron)};
}

double bone_above_water(const Row& row) noexcept { return kBoneDensity * row.bone - row.water; }

BeamQuality quality_at(double kev) noexcept {
  if (kev == kUsualKev) return {};
  const Row now = row_at(kev);
  const Row usual = row_at(kUsualKev);
  return {now.water / usual.water, bone_above_water(now) / bone_above_water(usual),
          now.iron / usual.iron};
}

}  // namespace

BeamQuality beam_quality(double tube_kv) noexcept {
  for (std::size_t i = 0; i + 1 < kSettings.size(); ++i) {
    const Setting& low = kSettings[i];
    const Setting& high = kSettings[i + 1];
    if (!(tube_kv < high.kv)) continue;
    const double share = std::clamp((tube_kv - low.kv) / (high.kv - low.kv), 0.0, 1.0);
    return quality_at(low.kev + share * (high.kev - low.kev));
  }
  return quality_at(kSettings.back().kev);
}

}  // namespace carpus::fluoroscopy
