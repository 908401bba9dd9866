// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "stock/case_picture.hpp"

#include "case_io/png.hpp"
#include "fluoroscopy/render.hpp"

namespace carpus::stock {
namespace {

constexpr int kPixels = 256;

}  // namespace

std::string case_picture(const cases::CaseData& data) {
  const cases::AxisSegment& axis = data.scaphoid.central_axis;
  fluoroscopy::CArmGeometry geometry;
  geometry.pixels = kPixels;
  const fluoroscopy::CArmPose pose = fluoroscopy::make_c_arm_pose(
      fluoroscopy::find_view("pa")->angles, {(axis.proximal + axis.distal) * 0.5},
      data.wrist_from_patient, {{0, data.side == Side::Left ? 1.0 : -1.0, 0}}, geometry);
  const fluoroscopy::Image image =
      fluoroscopy::FluoroscopyRenderer(data.ct.view()).render(pose, {}, {});
  return case_io::png_of_grey(image.width, image.height, image.grey);
}

}  // namespace carpus::stock
