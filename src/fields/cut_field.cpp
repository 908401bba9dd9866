// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "fields/cut_field.hpp"

namespace carpus::fields {

CutField::CutField(const ContactField& bone, const CutBrick* bricks)
    : spacing_(bone.spacing_mm() / kCutCellsPerCell),
      per_spacing_(bone.per_spacing() * kCutCellsPerCell),
      error_(kFieldErrorPerSpacing * spacing_ + kCutRoundingMm),
      steepest_(1 + 2 * kCutRoundingMm * per_spacing_),
      origin_(bone.origin()),
      bricks_(bricks) {
  std::size_t count = 1;
  for (std::size_t a = 0; a < 3; ++a) {
    cells_[a] = bone.cell_count()[a] * kCutCellsPerCell;
    bricks_by_axis_[a] = (cells_[a] + CutBrick::kCells - 1) / CutBrick::kCells;
    count *= static_cast<std::size_t>(bricks_by_axis_[a]);
  }
  table_.assign(count, kNoBrick);
}

double CutField::lowest_distance(double sample) const noexcept {
  const double by_way = sample - error_;
  const double f = sample - kCutRoundingMm;
  const double rest = f * f - 0.75 * spacing_ * spacing_;
  return f > 0 && rest > 0 ? std::max(by_way, std::sqrt(rest)) : by_way;
}

double CutField::sample(const Vec3& point_in_bone) const noexcept {
  const Vec3 p = (point_in_bone - origin_) * per_spacing_;
  std::array<int, 3> cell{};
  for (std::size_t a = 0; a < 3; ++a) {
    if (!(p[a] >= 0 && p[a] <= cells_[a])) return -kCutDepthMm;
    cell[a] = std::min(static_cast<int>(p[a]), cells_[a] - 1);
  }
  CellPolynomial polynomial;
  (void)load({cell[0], cell[1], cell[2]}, polynomial);
  return polynomial.value({p.x - cell[0], p.y - cell[1], p.z - cell[2]});
}

}  // namespace carpus::fields
