// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A case in the frame of a left wrist of the generic size, in which data/portals.json tells places.
#pragma once

#include "cases/case_data.hpp"
#include "geometry/pose.hpp"
#include "geometry/vec3.hpp"

namespace carpus::arthroscopy::detail {

class WristAxes {
 public:
  /// @param size  of the wrist, against the generic one
  WristAxes(const cases::CaseData& data, double size)
      : to_patient_(data.wrist_from_patient.inverse()),
        from_patient_(data.wrist_from_patient),
        size_(size),
        mirror_(data.side == Side::Left ? 1.0 : -1.0) {}

  /// A place of the generic wrist, in frame Patient.
  [[nodiscard]] Vec3 point(const Vec3& left) const {
    return (to_patient_ * Point<frame::Wrist>{Vec3{left.x, left.y * mirror_, left.z} * size_}).v;
  }
  /// A direction, likewise.
  [[nodiscard]] Vec3 way(const Vec3& left) const {
    return (to_patient_ * Direction<frame::Wrist>{Vec3{left.x, left.y * mirror_, left.z}}).v;
  }
  /// The place of the generic wrist that a point in frame Patient is.
  [[nodiscard]] Vec3 left_of(const Vec3& point) const {
    const Vec3 w = (from_patient_ * Point<frame::Patient>{point}).v / size_;
    return {w.x, w.y * mirror_, w.z};
  }

 private:
  Pose<frame::Patient, frame::Wrist> to_patient_;
  Pose<frame::Wrist, frame::Patient> from_patient_;
  double size_;
  double mirror_;
};

}  // namespace carpus::arthroscopy::detail
