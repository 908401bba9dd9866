// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "view_trainer/seen_screw.hpp"

#include <utility>

#include "view_trainer/outline_reader.hpp"
#include "view_trainer/silhouette.hpp"

namespace carpus::view_trainer {

CaseViews::CaseViews(const ScaphoidSurface& scaphoid, std::vector<StandardView> views)
    : views_(std::move(views)) {
  for (const StandardView& view : views_) {
    PosedView posed = pose_view(scaphoid.data(), view);
    OutlineMap truth = silhouette_of(scaphoid, posed);
    seen_.push_back({std::move(posed), std::move(truth), std::nullopt});
  }
}

void CaseViews::read_outlines(fluoroscopy::ComposedRenderer& renderer) {
  for (CaseView& view : seen_) {
    const fluoroscopy::Image picture =
        renderer.render({view.posed.c_arm, view.posed.patient_from_bone, {}}, {});
    view.read = read_outline(picture, view.truth);
  }
}

Overhang CaseViews::overhang_of(const PlacedScrew& placed, std::size_t view) const {
  const CaseView& seen = seen_.at(view);
  const Polygon outline = screw_outline(placed, seen.posed);
  const double true_mm = seen.truth.overhang_of(outline);
  return {true_mm, seen.read ? seen.read->overhang_of(outline) : true_mm};
}

fluoroscopy::ComposedRenderer make_renderer(const cases::CaseData& data) {
  std::vector<fluoroscopy::BodyLabel> bodies;
  for (const cases::Bone& bone : data.bones) {
    bodies.push_back({bone.label, belongs_to_forearm(bone.bone) ? 1 : 0});
  }
  return {data.ct.view(), data.labels.view(), bodies};
}

}  // namespace carpus::view_trainer
