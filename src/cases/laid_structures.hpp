// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Tendons, arteries and nerves where the bones have taken them: with the forearm, with the hand, or
// between both. They push nothing and are pushed by nothing.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cases/case_data.hpp"
#include "geometry/pose.hpp"
#include "geometry/vec3.hpp"

namespace carpus::cases {

/// Farther than this nothing is told of a structure [mm].
inline constexpr double kFarFromStructureMm = 100.0;

/// Where the tubes are. All memory is taken when it is made.
class LaidStructures {
 public:
  explicit LaidStructures(const CaseData& data);

  [[nodiscard]] std::size_t size() const noexcept { return tubes_.size(); }

  /// Its middle line where it lies now, from proximal to distal.
  [[nodiscard]] std::span<const Vec3> course(std::size_t tube) const noexcept {
    return std::span<const Vec3>(now_).subspan(tubes_[tube].first, tubes_[tube].count);
  }

  [[nodiscard]] anatomy::StructureKind kind(std::size_t tube) const noexcept {
    return tubes_[tube].kind;
  }
  [[nodiscard]] double radius_mm(std::size_t tube) const noexcept { return tubes_[tube].radius_mm; }

  /// Lays the tubes where the bones have taken them; poses by body of the case. Only needed before
  /// `gap_mm`, and nearly free while the bones that take them stay. Only + - * / and sqrt.
  void follow(std::span<const Pose<frame::Patient, frame::Bone>> poses) noexcept;

  /// Least distance of a tube's surface from the segment [mm]; negative where the segment is in it;
  /// `below_mm` where it is no nearer than that, which is found out sooner.
  [[nodiscard]] double gap_mm(std::size_t tube,
                              const Vec3& from,
                              const Vec3& to,
                              double below_mm = kFarFromStructureMm) const noexcept;

 private:
  struct Tube {
    std::size_t first = 0;  ///< in the points
    std::size_t count = 0;
    double radius_mm = 0;
    std::uint8_t forearm = 0;
    Vec3 middle;  ///< of a ball round it as it lies now
    double reach_mm = 0;
    double longest_step_mm = 0;  ///< between neighbouring points
    anatomy::StructureKind kind = anatomy::StructureKind::Tendon;
  };
  std::vector<Tube> tubes_;
  std::vector<Vec3> scanned_;
  std::vector<double> hand_share_;
  std::vector<Vec3> now_;
  std::uint8_t hand_ = 0;
  std::array<std::uint8_t, 3> carriers_{};  ///< hand, radius, ulna
  std::array<Pose<frame::Patient, frame::Bone>, 3> laid_by_{};
  bool is_laid_ = false;
};

}  // namespace carpus::cases
