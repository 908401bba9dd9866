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
}

void BentFan::read_row(std::size_t j, std::vector<Knot>& row) const {
  row.resize(columns_ * depths_);
  const double y = static_cast<double>(j) / cell_px_;
  const auto r = std::min(static_cast<std::size_t>(y), columns_ - 2);
  const auto t = static_cast<float>(y - static_cast<double>(r));
  for (std::size_t n = 0; n < row.size(); ++n) {
    row[n] = between(nodes_[column(0, r) + n], nodes_[column(0, r + 1) + n], t);
  }
}

void BentFan::read_ray(std::size_t i, const std::vector<Knot>& row, std::vector<Knot>& ray) const {
  ray.resize(depths_);
  const double x = static_cast<double>(i) / cell_px_;
  const auto c = std::min(static_cast<std::size_t>(x), columns_ - 2);
  const auto t = static_cast<float>(x - static_cast<double>(c));
  const Knot* const left = row.data() + c * depths_;
  for (std::size_t k = 0; k < depths_; ++k) ray[k] = between(left[k], left[depths_ + k], t);
}

}  // namespace carpus::fluoroscopy::detail
