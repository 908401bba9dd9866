// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/detail/tissue.hpp"

#include <algorithm>
#include <array>

#include "geometry/trilinear.hpp"

namespace carpus::simulation::detail {
namespace {

constexpr double kVoxelMm = 0.4;  // a share of removed bone is told over this width
constexpr double kSoftTissueHu = 40.0;

/// Eight directions around an axis, by halves and quarters of a turn: no sine is needed.
constexpr double kHalfRoot = 0.70710678118654752;
constexpr std::array<std::array<double, 2>, 8> kAround{{{1, 0},
                                                        {kHalfRoot, kHalfRoot},
                                                        {0, 1},
                                                        {-kHalfRoot, kHalfRoot},
                                                        {-1, 0},
                                                        {-kHalfRoot, -kHalfRoot},
                                                        {0, -1},
                                                        {kHalfRoot, -kHalfRoot}}};

}  // namespace

bool Tissue::is_near(std::uint8_t body, const Vec3& point) const noexcept {
  const fields::ContactField& field = bones_[body];
  const Vec3 cell = field.cells_from_point(point);
  const std::array<int, 3>& size = field.cell_count();
  return cell.x >= 0 && cell.y >= 0 && cell.z >= 0 && cell.x < size[0] && cell.y < size[1] &&
         cell.z < size[2];
}

Vec3 Tissue::untouched_normal(std::uint8_t body, const Vec3& point) const noexcept {
  const fields::ContactField& field = bones_[body];
  const Vec3 cells = field.cells_from_point(point);
  const VoxelIndex cell{static_cast<int>(cells.x), static_cast<int>(cells.y),
                        static_cast<int>(cells.z)};
  fields::CellPolynomial polynomial;
  if (!field.load(cell, polynomial)) return {};
  const Vec3 low{static_cast<double>(cell.x), static_cast<double>(cell.y),
                 static_cast<double>(cell.z)};
  return normalized_or(polynomial.slope(cells - low), {});
}

double Tissue::density_hu(const CtView& ct, std::uint8_t body, const Vec3& point) const noexcept {
  const double hu = sample_at(ct, point, kSoftTissueHu);
  const double removed = cuts_.field(body).removed_share(point, kVoxelMm);
  return removed > 0.0 ? hu + (kSoftTissueHu - hu) * removed : hu;
}

Vec3 Tissue::pull_to_removed(std::uint8_t body,
                             const Vec3& tip,
                             const Vec3& direction,
                             double radius_mm) const noexcept {
  const fields::CutField& cut = cuts_.field(body);
  if (!cut.is_cut()) return {};
  const Vec3 a = any_perpendicular(direction);
  const Vec3 b = cross(direction, a);
  const double own = cut.removed_share(tip, kVoxelMm);
  Vec3 pull;
  for (const auto& [x, y] : kAround) {
    const Vec3 aside = a * x + b * y;
    // Just beyond what the tip itself takes away.
    const double there = cut.removed_share(tip + aside * (1.5 * radius_mm), kVoxelMm);
    if (there > own) pull += aside * (there - own);
  }
  constexpr double kShareOfAll = 1.0 / kAround.size();
  return pull * (4.0 * kShareOfAll);
}

double Tissue::holding_share(const CtView& ct,
                             std::uint8_t body,
                             const Vec3& entry,
                             const Vec3& direction,
                             double depth_mm,
                             const instruments::Instrument& screw) const noexcept {
  constexpr int kStations = 48;
  constexpr int kRadii = 3;
  constexpr double kOutside = 0.0;
  const Vec3 a = any_perpendicular(direction);
  const Vec3 b = cross(direction, a);
  const double length = screw.length_mm;
  const double crest = screw.shape.greatest_radius_mm();
  const double core = std::max(screw.cut_tip_radius_mm, screw.cut_tail_radius_mm);
  double left = 0;
  double stood = 0;
  for (int i = 0; i < kStations; ++i) {
    const Vec3 on_axis = entry + direction * (depth_mm - length * (i + 0.5) / kStations);
    for (const auto& [x, y] : kAround) {
      for (int k = 0; k < kRadii; ++k) {
        const double radius = core + (crest - core) * (k + 0.5) / kRadii;
        const Vec3 p = on_axis + (a * x + b * y) * radius;
        if (!is_near(body, p) || untouched_distance_mm(body, p) > kOutside) continue;
        const double bone = std::max(0.0, sample_at(ct, p, kSoftTissueHu) - kSoftTissueHu);
        stood += bone;
        left += bone * (1.0 - cuts_.field(body).removed_share(p, kVoxelMm));
      }
    }
  }
  return stood > 0 ? left / stood : 1.0;
}

}  // namespace carpus::simulation::detail
