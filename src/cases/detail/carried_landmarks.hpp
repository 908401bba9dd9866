// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Places of the generic wrist on a patient's own bones: each bone of the model is laid on the
// patient's, and takes along what is told relative to it.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "anatomy/similarity_fit.hpp"
#include "anatomy/structure_table.hpp"
#include "cases/case_data.hpp"
#include "fields/exact_surface.hpp"
#include "fields/triangle_tree.hpp"
#include "geometry/aabb.hpp"

namespace carpus::cases::detail {

/// Bones and skin of a case, and what lies on the bones (ligaments, say), for questions about
/// nearest points. Keeps a reference to the case.
class WristSurfaces {
 public:
  /// @param soft  closed surfaces; what is not closed is left out.
  explicit WristSurfaces(const CaseData& data, std::span<const TriangleMesh* const> soft = {});

  /// The bones' nearest surface.
  struct Near {
    double distance_mm = 0;  ///< negative inside
    Vec3 point;              ///< on the surface
    Vec3 outwards;           ///< unit, from the surface through the point asked for
  };
  [[nodiscard]] Near bone_near(const Vec3& point) const;

  /// What stands in the way of a ball: of each bone and each soft body nearer to its middle than
  /// `within_mm` the surface's nearest place. What overlaps a soft body by lying in its side or
  /// under it is led over it, towards the skin (without a skin, away from the bone): then a place
  /// and a way out that do so.
  struct Wall {
    Near near;
    bool is_bone = true;
  };
  /// @param room_mm  between the ball and a soft body.
  void walls_near(const Vec3& point,
                  double radius_mm,
                  double room_mm,
                  double within_mm,
                  std::vector<Wall>& walls) const;

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
    BoneId bone;  ///< of a bone's
    fields::ExactSurface exact;
    Aabb box;
  };
  [[nodiscard]] static Near near_of(const Surface& surface,
                                    const Vec3& point,
                                    const fields::NearestPoint& hit);
  /// How far a point goes that way until it is over the body with so much room.
  [[nodiscard]] static std::optional<double> lift_mm(const Surface& soft,
                                                     const Vec3& point,
                                                     const Vec3& way,
                                                     double room_mm);
  /// Where a ball that needs so much room is in the soft body: `near`, or the way over it.
  [[nodiscard]] Near led_over(const Surface& soft,
                              const Near& near,
                              const Vec3& point,
                              double room_mm) const;
  [[nodiscard]] Vec3 skinwards(const Vec3& point) const;
  [[nodiscard]] double nearest_mm(const Vec3& point, bool of_forearm) const;

  const CaseData& data_;
  std::vector<Surface> bones_;
  std::vector<Surface> soft_;
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
