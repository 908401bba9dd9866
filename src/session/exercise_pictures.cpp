// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "session/exercise_pictures.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "geometry/aabb.hpp"
#include "procedure/situation.hpp"
#include "session/drilled_bone.hpp"
#include "session/metal_in_beam.hpp"

namespace carpus::session {

namespace {

/// Soft tissue sees forearm and hand as the segments.
std::vector<fluoroscopy::BodyLabel> bodies_of(const cases::CaseData& data) {
  std::vector<fluoroscopy::BodyLabel> bodies;
  for (const cases::Bone& bone : data.bones) {
    bodies.push_back({bone.label, belongs_to_forearm(bone.bone) ? 1 : 0});
  }
  return bodies;
}

/// Middle of the target's bounds where it is now: where a radiographer would centre the beam.
Vec3 centre_of(const cases::CaseData& data, BoneId target, const simulation::Snapshot& now) {
  Aabb bounds;
  for (std::size_t body = 0; body < now.body_count && body < data.bones.size(); ++body) {
    if (data.bones[body].bone != target) continue;
    for (const Vec3& vertex : data.bones[body].surface.vertices) {
      bounds.include((now.patient_from_bone[body] * Point<frame::Bone>{vertex}).v);
    }
  }
  return bounds.is_empty() ? Vec3{} : (bounds.low + bounds.high) / 2;
}

/// As the tube is set.
fluoroscopy::Exposure exposure_of(const simulation::Snapshot& now) {
  constexpr double kUsualHalves = 2.0;
  fluoroscopy::Exposure exposure;
  const double dose = procedure::kDoseHalves[procedure::dose_level_of(now.tube)] / kUsualHalves;
  exposure.tube_kv = procedure::kTubeKv[procedure::voltage_of(now.tube)];
  exposure.beam_mas *= dose;
  exposure.held_mas *= dose;
  exposure.seed = now.tick;
  return exposure;
}

/// Nothing is averaged: what one pulse brings.
fluoroscopy::Exposure exposure_of_a_pulse(const simulation::Snapshot& now) {
  fluoroscopy::Exposure exposure = exposure_of(now);
  exposure.beam_mas /= procedure::kPulsesPerShot;
  exposure.held_mas = exposure.beam_mas;
  return exposure;
}

}  // namespace

fluoroscopy::CArmPose beam_of(const cases::CaseData& data,
                              const PictureView& view,
                              const simulation::Snapshot& now,
                              const fluoroscopy::CArmGeometry& geometry) {
  const Direction<frame::Wrist> ulnar{{0, data.side == Side::Left ? 1.0 : -1.0, 0}};
  return fluoroscopy::make_c_arm_pose({view.rotation_deg, view.tilt_deg},
                                      {centre_of(data, view.target, now)}, data.wrist_from_patient,
                                      ulnar, geometry);
}

ExercisePictures::ExercisePictures(const cases::CaseData& data)
    : data_(data),
      renderer_(data.ct.view(), data.labels.view(), bodies_of(data)),
      holes_(data.bones.size()) {}

void ExercisePictures::take_in_holes(const simulation::Snapshot& now) {
  for (std::size_t body = 0; body < holes_.size(); ++body) {
    std::vector<simulation::TrackView> holes;
    for (std::size_t i = 0; i < now.track_count; ++i) {
      if (now.tracks[i].body == body) holes.push_back(now.tracks[i]);
    }
    if (holes == holes_[body]) continue;
    // Undo brings bone back, so what is gone is told anew.
    renderer_.restore(body);
    const Grid<std::uint8_t> share = removed_share(holes);
    if (!holes.empty()) {
      renderer_.set_removed(body, {share.geometry(), share.values()},
                            fluoroscopy::whole_of(share.geometry()));
    }
    holes_[body] = std::move(holes);
  }
}

fluoroscopy::BeamScene ExercisePictures::scene_of(const PictureView& view,
                                                  const simulation::Snapshot& now,
                                                  const fluoroscopy::CArmGeometry& geometry) const {
  fluoroscopy::BeamScene scene;
  scene.pose = beam_of(data_, view, now, geometry);
  scene.patient_from_bone = std::span(now.patient_from_bone).first(now.body_count);
  return scene;
}

fluoroscopy::Image ExercisePictures::take(const PictureView& view,
                                          const simulation::Snapshot& now) {
  take_in_holes(now);
  fluoroscopy::BeamScene scene = scene_of(view, now, {});
  const auto metal = metal_in_beam(now);
  scene.metal = metal;
  return renderer_.render(scene, exposure_of(now));
}

fluoroscopy::Image ExercisePictures::take_live(const PictureView& view,
                                               const simulation::Snapshot& now) {
  take_in_holes(now);
  fluoroscopy::BeamScene scene = scene_of(view, now, {});
  const bool rests = live_beam_ && live_beam_->carm_from_patient == scene.pose.carm_from_patient &&
                     std::ranges::equal(live_poses_, scene.patient_from_bone);
  live_beam_ = scene.pose;
  live_poses_.assign(scene.patient_from_bone.begin(), scene.patient_from_bone.end());
  if (!rests) scene.pose.geometry.pixels = kMovingPixels;
  const auto metal = metal_in_beam(now);
  scene.metal = metal;
  return renderer_.render(scene, exposure_of_a_pulse(now));
}

fluoroscopy::Image ExercisePictures::take_held(const PictureView& view,
                                               const simulation::Snapshot& now) {
  take_in_holes(now);
  fluoroscopy::BeamScene scene = scene_of(view, now, {});
  const auto metal = metal_in_beam(now);
  scene.metal = metal;
  return renderer_.render(scene, exposure_of_a_pulse(now));
}

}  // namespace carpus::session
