// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/detail/tissue.hpp"

#include <array>

#include "contact/screw_hold.hpp"
#include "geometry/trilinear.hpp"

namespace carpus::simulation::detail {
namespace {

constexpr double kVoxelMm = 0.4;  // a share of removed bone is told over this width
constexpr double kSoftTissueHu = 40.0;

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

double Tissue::holding_share(const CtView& ct,
                             std::uint8_t body,
                             const ThreadedCylinderShape& screw,
                             const Pose<frame::Bone, frame::Tool>& pose) const noexcept {
  const contact::ScrewHold hold =
      contact::screw_hold({bones_[body], cuts_.field(body)}, ct, screw, pose);
  return hold.whole_mm3 > 0 ? hold.share() : 1.0;
}

}  // namespace carpus::simulation::detail
