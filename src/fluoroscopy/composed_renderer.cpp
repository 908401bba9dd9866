// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "fluoroscopy/composed_renderer.hpp"

#include <vector>

#include "fluoroscopy/beam_quality.hpp"
#include "fluoroscopy/detail/metal_layer.hpp"

namespace carpus::fluoroscopy {

namespace {

void scale(std::vector<float>& values, double by) {
  if (by == 1.0) return;
  for (float& value : values) value *= static_cast<float>(by);
}

}  // namespace

AttenuationMap ComposedRenderer::project(const BeamScene& scene, double tube_kv) {
  const bool same_beam = pose_ && pose_->carm_from_patient == scene.pose.carm_from_patient &&
                         pose_->geometry == scene.pose.geometry;
  bool same_poses = same_beam && bodies_.size() == scene.patient_from_bone.size();
  for (std::size_t b = 0; same_poses && b < bodies_.size(); ++b) {
    same_poses = bodies_[b].patient_from_bone == scene.patient_from_bone[b];
  }
  redone_ = 0;
  if (!same_poses) {
    pose_.reset();  // nothing is kept of what fails half way
    soft_tissue_ = projector_.project_soft_tissue(scene.pose, scene.patient_from_bone);
    ++redone_;
  }
  if (!same_beam) bodies_.clear();
  for (std::size_t b = 0; b < projector_.body_count(); ++b) {
    const std::uint64_t revision = projector_.body(b).revision();
    const bool is_kept = b < bodies_.size() && bodies_[b].revision == revision &&
                         bodies_[b].patient_from_bone == scene.patient_from_bone[b];
    if (is_kept) continue;
    if (b >= bodies_.size()) bodies_.resize(b + 1);
    bodies_[b] = {scene.patient_from_bone[b], revision,
                  projector_.project_body(b, scene.pose, scene.patient_from_bone[b])};
    ++redone_;
  }
  const BeamQuality quality = beam_quality(tube_kv);
  if (redone_ > 0 || tube_kv != sum_kv_) {
    sum_ = soft_tissue_;
    scale(sum_.values, quality.soft_tissue);
    for (const BodyLayer& body : bodies_) {
      if (quality.bone == 1.0) {
        add_layer(sum_, body.layer);
        continue;
      }
      PictureLayer layer = body.layer;
      scale(layer.values, quality.bone);
      add_layer(sum_, layer);
    }
    sum_kv_ = tube_kv;
  }
  pose_ = scene.pose;
  AttenuationMap map = sum_;
  std::vector<MetalCylinder> metal(scene.metal.begin(), scene.metal.end());
  for (MetalCylinder& rod : metal) rod.attenuation_per_mm *= quality.metal;
  detail::add_metal(map, scene.pose, metal);
  return map;
}

Image ComposedRenderer::render(const BeamScene& scene, const Exposure& exposure) {
  const AttenuationMap map = project(scene, exposure.tube_kv);
  const CArmGeometry& geometry = scene.pose.geometry;
  return display(detect(map, geometry, exposure), map, geometry, exposure);
}

}  // namespace carpus::fluoroscopy
