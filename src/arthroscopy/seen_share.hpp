// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How much of a joint's cartilage was truly seen: at a useful distance and angle, in the round
// picture, with nothing before it. A facet is seen where its middle is; on true surfaces.
#pragma once

#include <cstddef>
#include <vector>

#include "arthroscopy/optics.hpp"
#include "arthroscopy/ray_tree.hpp"
#include "cases/arthroscopic_map.hpp"
#include "cases/case_data.hpp"

namespace carpus::arthroscopy {

/// Farther a scope shows too little to judge cartilage by [S81: a working depth of 15 mm].
inline constexpr double kUsefulMm = 15.0;
/// Cosine of 70 degrees from the surface's normal: flatter nothing is judged [E].
inline constexpr double kUsefulCosine = 0.342;

class SeenCartilage {
 public:
  /// Keeps references to both; the map is of this case.
  SeenCartilage(const cases::CaseData& data, const cases::ArthroscopicMap& map);

  /// One look: what it shows counts from now on.
  /// @param wrist  how the hand is held then.
  /// @param joint  that the scope is in: cartilage of others is not seen.
  void look(const Sight& sight, const anatomy::HandPose& wrist, std::uint8_t joint = 0);

  /// Of the joint's cartilage, by area, 0 to 1.
  [[nodiscard]] double share() const noexcept;
  /// The same of one body; nothing where it has none.
  [[nodiscard]] double share_of(std::uint8_t body) const noexcept;
  [[nodiscard]] const std::vector<bool>& seen() const noexcept { return seen_; }

 private:
  [[nodiscard]] bool is_hidden(const Vec3& eye, const Vec3& at) const;

  const cases::CaseData& data_;
  const cases::ArthroscopicMap& map_;
  std::vector<RayTree> trees_;  ///< by body; empty where it bounds no cartilage
  RayTree disc_;
  std::vector<Pose<frame::Bone, frame::Patient>> inverses_;
  std::vector<bool> seen_;
};

/// What all these looks showed.
/// @param looks         a range of procedure::ScopeLook
/// @param least_cosine  of half the scope's field
template <typename Looks>
[[nodiscard]] SeenCartilage seen_by(const cases::CaseData& data,
                                    const cases::ArthroscopicMap& map,
                                    const Looks& looks,
                                    double least_cosine) {
  SeenCartilage seen(data, map);
  for (const auto& look : looks) {
    Sight sight;
    sight.eye = look.eye;
    sight.axis = look.axis;
    sight.least_cosine = least_cosine;
    seen.look(sight,
              {look.flexion_rad, look.radial_deviation_rad, look.pronation_rad, look.traction_n},
              look.joint);
  }
  return seen;
}

}  // namespace carpus::arthroscopy
