// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Places of the generic wrist on a patient's own bones: each bone of the model is laid on the
// patient's, and takes along what is told relative to it.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "anatomy/similarity_fit.hpp"
#include "anatomy/structure_table.hpp"
#include "cases/case_data.hpp"
#include "fields/exact_surface.hpp"
#include "fields/triangle_tree.hpp"

namespace carpus::cases::detail {

/// Bones and skin of a case, for questions about nearest points. Keeps a reference to the case.
class WristSurfaces {
 public:
  explicit WristSurfaces(const CaseData& data);

  /// The bones' nearest surface.
  struct Near {
    double distance_mm = 0;  ///< negative inside
    Vec3 point;              ///< on the surface
    Vec3 outwards;           ///< unit, from the surface through the point asked for
  };
  [[nodiscard]] Near bone_near(const Vec3& point) const;

  /// Of one side: forearm, or distal row and metacarpals [mm].
  [[nodiscard]] double distance_to_forearm(const Vec3& point) const;
  [[nodiscard]] double distance_to_hand(const Vec3& point) const;

  /// Whether the CT shows the point, not only the rim that the skin is trimmed by for the eye; true
  /// everywhere without a CT.
  [[nodiscard]] bool is_in_scan(const Vec3& point) const;

  /// How deep a point lies under the skin [mm], negative outside, and the way out. Empty without a
  /// skin, and where the skin ends (the scan's field of view).
  struct Depth {
    double mm = 0;
    Vec3 point;     ///< on the skin
    Vec3 outwards;  ///< unit
  };
  [[nodiscard]] std::optional<Depth> depth_at(const Vec3& point) const;

 private:
  struct Surface {
    BoneId bone;
    fields::ExactSurface exact;
  };
  [[nodiscard]] double nearest_mm(const Vec3& point, bool of_forearm) const;

  const CaseData& data_;
  std::vector<Surface> bones_;
  fields::TriangleTree skin_;
};

class CarriedLandmarks {
 public:
  CarriedLandmarks(const CaseData& data, const anatomy::StructureTable& table);

  /// A place of the table, as placed by its landmark's bone alone [Patient, mm].
  [[nodiscard]] Vec3 at(const anatomy::Place& place) const;

  /// Size of the radius against the generic one's.
  [[nodiscard]] double scale() const noexcept { return scale_; }

  /// Worst of the fits [mm rms], over the bones that are there.
  [[nodiscard]] double worst_misfit_mm() const noexcept { return worst_misfit_mm_; }

 private:
  const anatomy::StructureTable& table_;
  double mirror_ = 1;  ///< of y: the table is of a left wrist
  double scale_ = 1;
  double worst_misfit_mm_ = 0;
  std::array<anatomy::Similarity, kBoneCount> patient_from_model_;
  std::vector<Vec3> landmarks_;  ///< on the patient's bones
};

}  // namespace carpus::cases::detail
