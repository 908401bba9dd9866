// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. Once: split the scan into bodies and soft tissue (tissue_split.hpp), measure distances to the
//    bodies (tissue_bending.hpp).
// 2. Soft tissue: bend the fan of rays back into the scan (detail/bent_fan.hpp); sum along each
//    straight piece, times the piece's length in the hand as it is now.
// 3. Bodies: take the fan into each body's own frame; only pixels that its box falls on.
#include "fluoroscopy/composed_projector.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "fluoroscopy/detail/bent_fan.hpp"
#include "fluoroscopy/detail/ray_fan.hpp"

namespace carpus::fluoroscopy {
namespace {

constexpr std::size_t kRowGrain = 4;
/// Soft tissue is summed for one pixel in so many; two, as the halves in `project_soft_tissue` say.
constexpr std::size_t kSoftStride = 2;

using BodyPose = Pose<frame::Patient, frame::Bone>;

std::vector<std::uint8_t> labels_of(std::span<const BodyLabel> bodies) {
  std::vector<std::uint8_t> labels;
  for (const BodyLabel& body : bodies) labels.push_back(body.label);
  return labels;
}

/// Each motion once; the identity where there is none.
std::vector<BodyPose> distinct(std::span<const BodyPose> poses) {
  std::vector<BodyPose> result;
  for (const BodyPose& pose : poses) {
    bool is_new = true;
    for (const BodyPose& other : result) is_new = is_new && !(other == pose);
    if (is_new) result.push_back(pose);
  }
  if (result.empty()) result.push_back({});
  return result;
}

/// So far out that no pixel of the round field reads it.
bool is_far_outside_field(std::size_t i, std::size_t j, std::size_t side) noexcept {
  const double centre = 0.5 * (static_cast<double>(side) - 1);
  const double x = static_cast<double>(i) - centre;
  const double y = static_cast<double>(j) - centre;
  const double far = 0.5 * static_cast<double>(side) + 2.0 * kSoftStride;
  return x * x + y * y > far * far;
}

}  // namespace

ComposedProjector::ComposedProjector(const GridView<const std::int16_t>& ct,
                                     const GridView<const std::uint8_t>& labels,
                                     std::span<const BodyLabel> bodies)
    : bending_(labels, bodies) {
  for (const ScanCut& cut : find_scan_cuts(ct)) {
    cuts_.push_back({cut, bending_.nearest_body(cut.centre_mm)});
  }
  TissueSplit split = split_tissue(ct, labels, labels_of(bodies));
  soft_ = AttenuationVolume(std::as_const(split.soft).view());
  for (BodyPart& part : split.bodies) bodies_.emplace_back(std::move(part));
}

AttenuationMap ComposedProjector::project_soft_tissue(
    const CArmPose& pose,
    std::span<const BodyPose> patient_from_bone) const {
  if (patient_from_bone.size() != bodies_.size()) {
    throw InvalidInput("fluoroscopy: " + std::to_string(patient_from_bone.size()) + " poses for " +
                       std::to_string(bodies_.size()) + " bodies");
  }
  const BentTissue tissue(bending_, patient_from_bone);
  const detail::BentFan bent(pose, tissue, soft_, distinct(patient_from_bone));
  const detail::RayFan rays = detail::fan_in_patient(pose);
  const auto side = static_cast<std::size_t>(pose.geometry.pixels);
  const double at_target = pose.geometry.source_to_target_mm / pose.geometry.source_to_receptor_mm;
  std::vector<detail::RayFan> cut_rays;  // in voxels, as each cut's body sees them
  for (const MovingCut& moving : cuts_) {
    const BodyPose motion = moving.body ? patient_from_bone[*moving.body] : BodyPose{};
    cut_rays.push_back(
        detail::in_voxels(detail::in_bone(rays, motion.inverse()), soft_.geometry()));
  }
  const auto is_behind_leaf = [&](std::size_t i, std::size_t j) {
    for (std::size_t c = 0; c < cuts_.size(); ++c) {
      const detail::RayFan& fan = cut_rays[c];
      if (cuts_[c].cut.covers(fan.source + (fan.pixel(i, j) - fan.source) * at_target)) return true;
    }
    return false;
  };
  // Every second pixel of every second row, one more at either end; without bones in it soft tissue
  // has nothing finer.
  const std::size_t nodes = side / kSoftStride + 2;
  std::vector<float> lattice(nodes * nodes, 0.0F);
  parallel_for(nodes, kRowGrain / 2, [&](std::size_t from, std::size_t to) {
    std::vector<detail::BentFan::Knot> row;
    std::vector<detail::BentFan::Knot> ray;
    for (std::size_t r = from; r < to; ++r) {
      const std::size_t j = std::min(r * kSoftStride, side - 1);
      bent.read_row(j, row);
      for (std::size_t c = 0; c < nodes; ++c) {
        const std::size_t i = std::min(c * kSoftStride, side - 1);
        if (is_far_outside_field(i, j, side)) continue;
        const auto depths = bent.read_ray(i, j, row, ray);
        double sum = 0.0;
        for (std::size_t k = 0; k + 1 < ray.size(); ++k) {
          sum += bent.share_between(depths[k], depths[k + 1]) *
                 static_cast<double>(soft_.mean_between(ray[k].voxel(), ray[k + 1].voxel()));
        }
        lattice[r * nodes + c] = static_cast<float>(sum * length(rays.pixel(i, j) - rays.source));
      }
    }
  });
  AttenuationMap map{
      pose.geometry.pixels, pose.geometry.pixels, std::vector<float>(side * side), {}};
  parallel_for(side, kRowGrain, [&](std::size_t from, std::size_t to) {
    for (std::size_t j = from; j < to; ++j) {
      const float* const above = lattice.data() + j / kSoftStride * nodes;
      const float* const below = above + (j % kSoftStride == 0 ? 0 : nodes);
      for (std::size_t i = 0; i < side; ++i) {
        float& value = map.values[j * side + i];
        value = std::numeric_limits<float>::quiet_NaN();
        if (detail::is_outside_field(i, j, pose.geometry.pixels) || is_behind_leaf(i, j)) continue;
        const std::size_t left = i / kSoftStride;
        const std::size_t right = left + (i % kSoftStride == 0 ? 0 : 1);
        value = 0.25F * (above[left] + above[right] + below[left] + below[right]);
      }
    }
  });
  return map;
}

PictureLayer ComposedProjector::project_body(std::size_t body,
                                             const CArmPose& pose,
                                             const BodyPose& patient_from_bone) const {
  const AttenuationVolume& volume = bodies_.at(body).volume();
  const IndexBox& box = volume.occupied();
  if (box.is_empty()) return {};
  std::array<Vec3, 8> corners;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    Vec3 v;
    for (std::size_t a = 0; a < 3; ++a) {
      v[a] = ((corner >> a) & 1U) == 0 ? box.low[a] : box.high[a] - 1.0;
    }
    const Point<frame::Bone> p{volume.geometry().patient_from_voxel(v)};
    corners[corner] = (patient_from_bone * p).v;
  }
  PictureLayer layer{detail::box_of(corners, pose).within(pose.geometry.pixels), {}};
  if (layer.box.is_empty()) return layer;
  const auto left = static_cast<std::size_t>(layer.box.left);
  const auto top = static_cast<std::size_t>(layer.box.top);
  const auto columns = static_cast<std::size_t>(layer.box.right) - left + 1;
  const auto rows = static_cast<std::size_t>(layer.box.bottom) - top + 1;
  layer.values.assign(columns * rows, 0.0F);
  const detail::RayFan in_patient = detail::fan_in_patient(pose);
  const detail::RayFan rays = detail::in_voxels(
      detail::in_bone(in_patient, patient_from_bone.inverse()), volume.geometry());
  parallel_for(rows, kRowGrain, [&](std::size_t from, std::size_t to) {
    for (std::size_t r = from; r < to; ++r) {
      for (std::size_t c = 0; c < columns; ++c) {
        if (detail::is_outside_field(left + c, top + r, pose.geometry.pixels)) continue;
        const float mean = volume.mean_between(rays.source, rays.pixel(left + c, top + r));
        if (mean == 0.0F) continue;
        const double way = length(in_patient.pixel(left + c, top + r) - in_patient.source);
        layer.values[r * columns + c] = mean * static_cast<float>(way);
      }
    }
  });
  return layer;
}

AttenuationMap ComposedProjector::project(const CArmPose& pose,
                                          std::span<const BodyPose> patient_from_bone) const {
  AttenuationMap map = project_soft_tissue(pose, patient_from_bone);
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    add_layer(map, project_body(b, pose, patient_from_bone[b]));
  }
  return map;
}

double ComposedProjector::attenuation_at(
    const Point<frame::Patient>& now,
    const BentTissue& tissue,
    std::span<const BodyPose> patient_from_bone) const noexcept {
  double sum = soft_.value_at(tissue.source_of(now));
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    sum += bodies_[b].volume().value_at((patient_from_bone[b].inverse() * now).v);
  }
  return sum;
}

void add_layer(AttenuationMap& map, const PictureLayer& layer) {
  if (layer.box.is_empty()) return;
  const auto columns = static_cast<std::size_t>(layer.box.right - layer.box.left + 1);
  std::size_t from = 0;
  for (int j = layer.box.top; j <= layer.box.bottom; ++j) {
    const std::size_t to = static_cast<std::size_t>(j) * static_cast<std::size_t>(map.width) +
                           static_cast<std::size_t>(layer.box.left);
    for (std::size_t i = 0; i < columns; ++i, ++from) map.values[to + i] += layer.values[from];
  }
}

}  // namespace carpus::fluoroscopy
