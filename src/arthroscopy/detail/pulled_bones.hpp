// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A case's bones as the hand is pulled: how far they are, where each has gone; and the tendons,
// nerves and arteries that they have taken along, which a way in passes or cuts.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "anatomy/structure_table.hpp"
#include "cases/arthroscopic_map.hpp"
#include "cases/case_data.hpp"
#include "cases/laid_structures.hpp"
#include "geometry/aabb.hpp"
#include "geometry/pose.hpp"
#include "geometry/vec3.hpp"

namespace carpus::arthroscopy::detail {

/// Points are in frame Patient under traction. A way is told by where it goes through the capsule
/// and by its direction, unit, inwards.
class PulledBones {
 public:
  /// Keeps a reference to `data`.
  PulledBones(const cases::CaseData& data, double traction_n);

  /// From where a body is under traction to where it was scanned.
  [[nodiscard]] const Pose<frame::Bone, frame::Patient>& inverse(std::uint8_t body) const {
    return from_patient_[body];
  }
  /// What of a kind lies nearest to a way, from its capsule to outside.
  [[nodiscard]] std::optional<cases::BesideWay> beside(anatomy::StructureKind kind,
                                                       const Vec3& capsule,
                                                       const Vec3& inwards) const;
  /// Whether a way passes this structure on the side to which `along` points; so where there is
  /// none.
  [[nodiscard]] bool is_beyond(const std::string& structure,
                               const Vec3& along,
                               const Vec3& capsule,
                               const Vec3& inwards) const;
  /// By how much a way comes nearer than `clear_mm` to any of these kinds, roughly; 0 for none.
  [[nodiscard]] double cut_mm(std::span<const anatomy::StructureKind> kinds,
                              double clear_mm,
                              const Vec3& capsule,
                              const Vec3& inwards) const;
  /// Least distance to any of them; `at_most_mm`, of kFarMm or less, where they are farther.
  [[nodiscard]] double distance_mm(const Vec3& point, double at_most_mm) const;

 private:
  const cases::CaseData& data_;
  std::vector<Pose<frame::Bone, frame::Patient>> from_patient_;
  std::vector<Aabb> boxes_;  ///< of the surfaces, as scanned
  cases::LaidStructures structures_;
};

}  // namespace carpus::arthroscopy::detail
