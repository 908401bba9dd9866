// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "view_trainer/standard_views.hpp"

#include <array>
#include <string>

#include "core/error.hpp"
#include "core/units.hpp"
#include "geometry/aabb.hpp"

namespace carpus::view_trainer {
namespace {

using anatomy::HandPose;

/// Engineering values: the abstract gives the beam's angle and not the wrist's.
constexpr double kSkylineFlexionDeg = 45.0;
constexpr double kExtensionDeg = 20.0;
constexpr double kUlnarDeviationDeg = 20.0;

HandPose hand_for(std::string_view id) {
  HandPose hand;
  if (id == "skyline") hand.flexion_rad = radians_from_degrees(kSkylineFlexionDeg);
  return hand;
}

std::string_view name_of(std::string_view id) {
  if (id == "pa") return "PA";
  if (id == "lateral") return "lateral";
  if (id == "oblique_45_pronated") return "45° pronated oblique";
  if (id == "oblique_45_supinated") return "45° supinated oblique";
  if (id == "oblique_60_pronated") return "60° pronated oblique";
  if (id == "skyline") return "skyline";
  return id;
}

}  // namespace

std::span<const StandardView> standard_views() {
  static const auto views = [] {
    std::array<StandardView, fluoroscopy::kNamedViews.size()> all;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const fluoroscopy::NamedView& view = fluoroscopy::kNamedViews[i];
      all[i] = {view.id, view.label, name_of(view.id), view.angles, hand_for(view.id)};
    }
    return all;
  }();
  return views;
}

const StandardView& pa_extended_view() {
  static const StandardView view{
      "pa_extended_ulnar",
      "PA UD+E",
      "PA, ulnar deviation and extension",
      {0.0, 0.0},
      {-radians_from_degrees(kExtensionDeg), -radians_from_degrees(kUlnarDeviationDeg), 0.0, 0.0}};
  return view;
}

std::size_t view_index(std::string_view id) {
  const auto views = standard_views();
  std::string known;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (views[i].id == id) return i;
    known += " " + std::string(views[i].id);
  }
  throw InvalidInput("no view is called '" + std::string(id) + "'; there are" + known);
}

PosedView pose_view(const cases::CaseData& data,
                    const StandardView& view,
                    const fluoroscopy::CArmGeometry& geometry) {
  PosedView posed;
  Aabb bounds;
  for (const cases::Bone& bone : data.bones) {
    const auto pose = data.hand_motion.pose_of(bone.bone, view.hand);
    posed.patient_from_bone.push_back(pose);
    if (bone.bone != BoneId::Scaphoid) continue;
    posed.patient_from_scaphoid = pose;
    for (const Vec3& vertex : bone.surface.vertices) {
      bounds.include((pose * Point<frame::Bone>{vertex}).v);
    }
  }
  if (bounds.is_empty()) throw InvalidInput("view trainer: the case has no scaphoid");
  const Direction<frame::Wrist> ulnar{{0, data.side == Side::Left ? 1.0 : -1.0, 0}};
  posed.c_arm = fluoroscopy::make_c_arm_pose(view.angles, {bounds.centre()},
                                             data.wrist_from_patient, ulnar, geometry);
  return posed;
}

}  // namespace carpus::view_trainer
