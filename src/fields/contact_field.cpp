// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "fields/contact_field.hpp"

#include <limits>
#include <string>

#include "core/error.hpp"

namespace carpus::fields {
namespace {

constexpr int kFullScale = 32767;

/// Rounding of what build_distance_field stores as float, relative to the band.
constexpr double kFloatRoundoff = 0x1.0p-24;

/// A field of exact distances may be steeper than this by rounding only.
constexpr double kSteepestDistance = 1.001;

[[noreturn]] void refuse(const std::string& what) { throw InvalidInput("contact field: " + what); }

}  // namespace

ContactField::ContactField(const Grid<float>& field, const TriangleMesh& surface) {
  if (field.values().empty()) refuse("the grid is empty");
  if (surface.vertices.empty()) refuse("the surface is empty");
  const GridGeometry& grid = field.geometry();
  const Vec3 h = grid.spacing;
  if (!(h.x > 0 && h.x == h.y && h.x == h.z)) refuse("the spacing must be the same on all axes");
  if (!(grid.direction == Mat3::identity())) refuse("the grid is turned against its frame");
  if (std::min({grid.size[0], grid.size[1], grid.size[2]}) < 2) {
    refuse("the grid needs at least two voxels on each axis");
  }
  measure_grid(field, surface);
  fill_bricks(field);
  check_against(surface);
}

void ContactField::measure_grid(const Grid<float>& field, const TriangleMesh& surface) {
  const GridGeometry& grid = field.geometry();
  spacing_ = grid.spacing.x;
  per_spacing_ = 1 / spacing_;
  origin_ = grid.origin;
  for (std::size_t a = 0; a < 3; ++a) cells_[a] = grid.size[a] - 1;

  std::array<std::size_t, 3> stride{1, 0, 0};
  stride[1] = static_cast<std::size_t>(grid.size[0]);
  stride[2] = stride[1] * static_cast<std::size_t>(grid.size[1]);
  double steepest = 0;
  for (std::size_t i = 0; i < field.values().size(); ++i) {
    const double value = field[i];
    if (!std::isfinite(value)) refuse("a value is not finite");
    band_ = std::max(band_, std::abs(value));
    const VoxelIndex v = grid.index_of(i);
    const std::array<int, 3> index{v.x, v.y, v.z};
    for (std::size_t a = 0; a < 3; ++a) {
      if (index[a] > 0)
        steepest = std::max(steepest, std::abs(value - double{field[i - stride[a]]}));
    }
  }
  if (!(band_ > 0)) refuse("every value is zero");
  unit_ = band_ / kFullScale;
  steepest_ = (steepest + unit_) * per_spacing_;
  if (steepest_ > kSteepestDistance + unit_ * per_spacing_) {
    refuse("it changes by " + std::to_string(steepest_) +
           " mm per mm, a distance by at most 1; build it with build_distance_field");
  }
  error_ = kFieldErrorPerSpacing * spacing_ + unit_ / 2 + band_ * kFloatRoundoff;

  surface_box_ = bounds_of(surface.vertices);
  ball_centre_ = surface_box_.centre();
  for (const Vec3& v : surface.vertices) {
    ball_radius_ = std::max(ball_radius_, distance(v, ball_centre_));
  }
  double margin = std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; a < 3; ++a) {
    const double high = origin_[a] + cells_[a] * spacing_;
    margin = std::min({margin, surface_box_.low[a] - origin_[a], high - surface_box_.high[a]});
  }
  // Half a node's step: rounding of box and grid.
  reach_ = std::min(band_, margin) - unit_ / 2;
  if (!(reach_ > error_)) refuse("the grid ends too near to the surface; choose a larger band_mm");
}

void ContactField::fill_bricks(const Grid<float>& field) {
  std::size_t count = 1;
  for (std::size_t a = 0; a < 3; ++a) {
    bricks_by_axis_[a] = (cells_[a] + kBrick - 1) / kBrick;
    count *= static_cast<std::size_t>(bricks_by_axis_[a]);
  }
  table_.resize(count);
  const std::array<int, 3>& size = field.geometry().size;
  for (std::size_t b = 0; b < count; ++b) {
    const auto nx = static_cast<std::size_t>(bricks_by_axis_[0]);
    const auto ny = static_cast<std::size_t>(bricks_by_axis_[1]);
    const VoxelIndex low{static_cast<int>(b % nx) * kBrick, static_cast<int>(b / nx % ny) * kBrick,
                         static_cast<int>(b / (nx * ny)) * kBrick};
    Brick brick;
    std::size_t at = 0;
    int least = kFullScale;
    int greatest = -kFullScale;
    for (int k = 0; k < kBrickNodes; ++k) {
      for (int j = 0; j < kBrickNodes; ++j) {
        for (int i = 0; i < kBrickNodes; ++i) {
          const VoxelIndex v{std::min(low.x + i, size[0] - 1), std::min(low.y + j, size[1] - 1),
                             std::min(low.z + k, size[2] - 1)};
          const int node = static_cast<int>(std::floor(double{field[v]} / unit_ + 0.5));
          least = std::min(least, node);
          greatest = std::max(greatest, node);
          brick.node[at++] = static_cast<std::int16_t>(node);
        }
      }
    }
    if (least == kFullScale) {
      table_[b] = kFarOutside;
    } else if (greatest == -kFullScale) {
      table_[b] = kFarInside;
    } else {
      table_[b] = static_cast<std::int32_t>(bricks_.size());
      bricks_.push_back(brick);
    }
  }
  bricks_.shrink_to_fit();
}

void ContactField::check_against(const TriangleMesh& surface) const {
  for (const Vec3& v : surface.vertices) {
    if (std::abs(sample(v)) <= error_) continue;
    refuse("it says " + std::to_string(sample(v)) +
           " mm at a vertex of the surface; is it the field of another surface?");
  }
}

double ContactField::lowest_distance(double sample) const noexcept {
  const double rounding = unit_ / 2 + band_ * kFloatRoundoff;
  const double by_way = sample - error_;
  const double f = sample - rounding;
  const double rest = f * f - 0.75 * spacing_ * spacing_;
  return f > 0 && rest > 0 ? std::max(by_way, std::sqrt(rest)) : by_way;
}

std::size_t ContactField::byte_count() const noexcept {
  return table_.size() * sizeof(table_[0]) + bricks_.size() * sizeof(Brick);
}

double ContactField::sample(const Vec3& point) const noexcept {
  const Vec3 p = cells_from_point(point);
  std::array<int, 3> cell{};
  for (std::size_t a = 0; a < 3; ++a) {
    if (!(p[a] >= 0 && p[a] <= cells_[a])) return reach_;
    cell[a] = std::min(static_cast<int>(p[a]), cells_[a] - 1);
  }
  CellPolynomial polynomial;
  (void)load({cell[0], cell[1], cell[2]}, polynomial);
  return polynomial.value({p.x - cell[0], p.y - cell[1], p.z - cell[2]});
}

}  // namespace carpus::fields
