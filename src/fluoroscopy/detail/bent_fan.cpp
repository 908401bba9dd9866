// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "fluoroscopy/detail/bent_fan.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/parallel.hpp"

namespace carpus::fluoroscopy::detail {
namespace {

/// Between nodes, across the beam at the target and along it [mm].
constexpr double kAcrossMm = 3.0;
constexpr double kAlongMm = 4.0;
/// Nothing nearer to the source than this share of the way is seen.
constexpr double kNearestShare = 0.05;
/// A ray that strays from a straight line by less is one [mm]: a tenth of a voxel, in soft tissue.
constexpr double kStraightMm = 0.03;

struct Shares {
  double low = 1.0;
  double high = kNearestShare;
};

/// Between which shares of the way to the receptor the tissue lies, at any of its motions.
Shares depth_range(const CArmPose& pose,
                   const AttenuationVolume& scan,
                   const std::vector<Pose<frame::Patient, frame::Bone>>& motions) {
  Shares range;
  const IndexBox& box = scan.occupied();
  if (box.is_empty()) return {kNearestShare, 1.0};
  const double distance = pose.geometry.source_to_receptor_mm;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 v;
    for (std::size_t a = 0; a < 3; ++a) {
      v[a] = ((corner >> a) & 1) == 0 ? box.low[a] : box.high[a] - 1.0;
    }
    const Point<frame::Bone> p{scan.geometry().patient_from_voxel(v)};
    for (const Pose<frame::Patient, frame::Bone>& motion : motions) {
      const double share = ((pose.carm_from_patient * (motion * p)).v.z + distance) / distance;
      range.low = std::min(range.low, share);
      range.high = std::max(range.high, share);
    }
  }
  range.low = std::clamp(range.low - 1.0 / distance, kNearestShare, 1.0);
  range.high = std::clamp(range.high + 1.0 / distance, kNearestShare, 1.0);
  if (!(range.low < range.high)) range = {kNearestShare, 1.0};
  return range;
}

BentFan::Knot between(const BentFan::Knot& a, const BentFan::Knot& b, float t) noexcept {
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z)};
}

}  // namespace

BentFan::BentFan(const CArmPose& pose,
                 const BentTissue& tissue,
                 const AttenuationVolume& scan,
                 const std::vector<Pose<frame::Patient, frame::Bone>>& motions) {
  const CArmGeometry& geometry = pose.geometry;
  const Shares range = depth_range(pose, scan, motions);
  std::size_t cells = 1;
  depths_ = 2;
  if (!tissue.is_rigid()) {
    const double across = geometry.field_mm / geometry.magnification() / kAcrossMm;
    const double along = (range.high - range.low) * geometry.source_to_receptor_mm / kAlongMm;
    cells = static_cast<std::size_t>(std::ceil(std::max(1.0, across)));
    depths_ = static_cast<std::size_t>(std::ceil(std::max(1.0, along))) + 1;
  }
  columns_ = cells + 1;
  cell_px_ = std::max(1.0, geometry.pixels - 1.0) / static_cast<double>(cells);
  nearest_ = range.low;
  step_ = (range.high - range.low) / static_cast<double>(depths_ - 1);
  nodes_.resize(columns_ * columns_ * depths_);
  const RayFan fan = fan_in_patient(pose);
  parallel_for(columns_ * columns_, 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      const Vec3 pixel = fan.pixel(cell_px_ * static_cast<double>(n % columns_),
                                   cell_px_ * static_cast<double>(n / columns_));
      for (std::size_t k = 0; k < depths_; ++k) {
        const Vec3 now = fan.source + (pixel - fan.source) * share(k);
        const Vec3 v = scan.geometry().voxel_from_patient(tissue.source_of({now}));
        nodes_[n * depths_ + k] = {static_cast<float>(v.x), static_cast<float>(v.y),
                                   static_cast<float>(v.z)};
      }
    }
  });
  find_bends(scan.geometry().spacing);
}

/// From each bend as far on as all four columns of a cell stay straight.
void BentFan::find_bends(const Vec3& spacing) {
  bends_.resize((columns_ - 1) * (columns_ - 1));
  parallel_for(bends_.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t cell = begin; cell < end; ++cell) {
      const std::size_t c = cell % (columns_ - 1);
      const std::size_t r = cell / (columns_ - 1);
      const std::array<const Knot*, 4> corners{
          nodes_.data() + column(c, r), nodes_.data() + column(c + 1, r),
          nodes_.data() + column(c, r + 1), nodes_.data() + column(c + 1, r + 1)};
      const auto is_straight = [&](std::size_t from, std::size_t to) {
        for (const Knot* const knots : corners) {
          for (std::size_t k = from + 1; k < to; ++k) {
            const float t = static_cast<float>(k - from) / static_cast<float>(to - from);
            const Vec3 off = between(knots[from], knots[to], t).voxel() - knots[k].voxel();
            if (length({off.x * spacing.x, off.y * spacing.y, off.z * spacing.z}) > kStraightMm) {
              return false;
            }
          }
        }
        return true;
      };
      std::vector<std::uint16_t>& bends = bends_[cell];
      bends.push_back(0);
      for (std::size_t k = 1; k + 1 < depths_; ++k) {
        if (!is_straight(bends.back(), k + 1)) bends.push_back(static_cast<std::uint16_t>(k));
      }
      bends.push_back(static_cast<std::uint16_t>(depths_ - 1));
    }
  });
}

std::size_t BentFan::cell_of(std::size_t pixel) const noexcept {
  return std::min(static_cast<std::size_t>(static_cast<double>(pixel) / cell_px_), columns_ - 2);
}

void BentFan::read_row(std::size_t j, std::vector<Knot>& row) const {
  row.resize(columns_ * depths_);
  const std::size_t r = cell_of(j);
  const auto t = static_cast<float>(static_cast<double>(j) / cell_px_ - static_cast<double>(r));
  for (std::size_t n = 0; n < row.size(); ++n) {
    row[n] = between(nodes_[column(0, r) + n], nodes_[column(0, r + 1) + n], t);
  }
}

std::span<const std::uint16_t> BentFan::read_ray(std::size_t i,
                                                 std::size_t j,
                                                 const std::vector<Knot>& row,
                                                 std::vector<Knot>& ray) const {
  const std::size_t c = cell_of(i);
  const auto t = static_cast<float>(static_cast<double>(i) / cell_px_ - static_cast<double>(c));
  const Knot* const left = row.data() + c * depths_;
  const std::vector<std::uint16_t>& bends = bends_[cell_of(j) * (columns_ - 1) + c];
  ray.clear();
  for (const std::uint16_t k : bends) ray.push_back(between(left[k], left[depths_ + k], t));
  return bends;
}

}  // namespace carpus::fluoroscopy::detail
