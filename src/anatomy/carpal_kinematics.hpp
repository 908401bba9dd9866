// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How carpal bones turn with the hand, from published statements alone: one quadratic surface in
// flexion and deviation a degree of freedom, the form of [akhbari2019predicting], with the figures
// and their sources in data/carpal_kinematics.json [clinical: B12]. Bones move in four groups: the
// hand (distal row and metacarpals), scaphoid, lunate, triquetrum with pisiform.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "anatomy/bone_id.hpp"
#include "anatomy/hand_pose.hpp"
#include "geometry/mat3.hpp"
#include "geometry/mesh_in.hpp"
#include "geometry/pose.hpp"

namespace carpus::anatomy {

/// What moves as one rigid body.
enum class CarpalGroup : std::uint8_t {
  Ulna = 0,  ///< stays
  Radius = 1,
  Hand = 2,  ///< distal row and metacarpals
  Scaphoid = 3,
  Lunate = 4,
  Triquetrum = 5  ///< with the pisiform
};
inline constexpr std::size_t kCarpalGroupCount = 6;
inline constexpr std::array<CarpalGroup, 4> kMovingGroups{
    CarpalGroup::Hand, CarpalGroup::Scaphoid, CarpalGroup::Lunate, CarpalGroup::Triquetrum};

[[nodiscard]] CarpalGroup group_of(BoneId bone) noexcept;
[[nodiscard]] std::string_view name_of(CarpalGroup group) noexcept;

/// f F + r R + f^2 FF + r^2 RR + f r FR, clamped; f flexion and r radial deviation [deg].
struct QuadraticSurface {
  double flexion = 0;
  double deviation = 0;
  double flexion_squared = 0;
  double deviation_squared = 0;
  double product = 0;
  double low_deg = -180;
  double high_deg = 180;

  [[nodiscard]] double value_deg(double flexion_deg, double deviation_deg) const noexcept;
};

/// Components of a rotation vector [deg], Wrist frame of a left wrist.
using RotationSurfaces = std::array<QuadraticSurface, 3>;

/// Where a wrist was scanned and what it turns about, frame Wrist [mm].
struct WristLandmarks {
  HandPose scan;   ///< flexion and deviation of the hand as scanned; pronation and traction 0
  Vec3 centre;     ///< on the capitate's long axis, between proximal and middle third
  Vec3 hand_axis;  ///< unit vector along the capitate towards distal, as scanned
};

class CarpalKinematics {
 public:
  /// The built-in figures; parsed at the first call.
  [[nodiscard]] static const CarpalKinematics& published();

  /// Reads the format of data/carpal_kinematics.json.
  /// @throws InvalidInput naming the field where the text is not such a model.
  [[nodiscard]] static CarpalKinematics parse(std::string_view json_text);

  [[nodiscard]] const HandLimits& limits() const noexcept { return limits_; }
  [[nodiscard]] double radiocarpal_mm_per_n() const noexcept { return radiocarpal_mm_per_n_; }
  [[nodiscard]] double midcarpal_mm_per_n() const noexcept { return midcarpal_mm_per_n_; }

  /// Rotation vector of a group from neutral [deg], Wrist frame of a left wrist: +x supinates or
  /// pronates (always 0 here), +y flexes, +z deviates radially. Zero for radius and ulna.
  [[nodiscard]] Vec3 rotation_vector_deg(CarpalGroup group,
                                         double flexion_deg,
                                         double deviation_deg) const noexcept;

  /// Rotation of a group from neutral, Wrist frame of `side`.
  [[nodiscard]] Mat3 rotation_from_neutral(CarpalGroup group,
                                           const HandPose& pose,
                                           Side side) const noexcept;

  /// Motion of a group from where it was scanned to where it is in `pose`, radius at rest, without
  /// pronation, traction or regard to neighbours; the identity in the pose of the scan.
  [[nodiscard]] Pose<frame::Wrist, frame::Wrist> motion_from_scan(CarpalGroup group,
                                                                  const HandPose& pose,
                                                                  const WristLandmarks& landmarks,
                                                                  Side side) const noexcept;

  /// Reads how the hand was held in the scan off the capitate's long axis, its principal axis of
  /// inertia; the capitate turns with the third metacarpal. The result lies within limits().
  /// @param capitate  closed surface, frame Wrist [mm].
  /// @throws InvalidInput if the capitate is empty or has no long axis.
  [[nodiscard]] WristLandmarks landmarks_of(const MeshIn<frame::Wrist>& capitate, Side side) const;

 private:
  CarpalKinematics() = default;
  [[nodiscard]] Pose<frame::Wrist, frame::Wrist> motion_from_neutral(CarpalGroup group,
                                                                     const HandPose& pose,
                                                                     const Vec3& centre,
                                                                     Side side) const noexcept;

  RotationSurfaces hand_{};
  RotationSurfaces scaphoid_{};
  RotationSurfaces lunate_{};
  double triquetrum_share_of_hand_ = 0;
  double neutral_capitate_flexion_deg_ = 0;
  double neutral_capitate_deviation_deg_ = 0;
  double centre_share_ = 0;
  double axes_apart_mm_ = 0;
  double radiocarpal_mm_per_n_ = 0;
  double midcarpal_mm_per_n_ = 0;
  HandLimits limits_;
};

}  // namespace carpus::anatomy
