// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The map by which soft tissue follows when the forearm turns about the wrist: a rotation about the
// flexion axis by a share that is 0 at the hand's bones and 1 at the forearm's.
#pragma once

#include <array>
#include <cstdint>

#include "geometry/grid.hpp"
#include "geometry/mat3.hpp"

namespace carpus::cases::detail {

/// Where a point of the bent wrist lay in the scan.
struct BentPoint {
  Vec3 source;
  bool is_rigid = false;      ///< in or at a bone: moved with it, exactly
  bool repeats_bone = false;  ///< the bent path leads into a bone, which lies elsewhere by now
};

class Bending {
 public:
  /// @param labels  of the scan; tells hand bones from forearm bones.
  /// @param flexion_rad  the forearm turns by minus this about `axis` (unit) through `pivot`.
  Bending(const Grid<std::uint8_t>& labels,
          const Vec3& pivot,
          const Vec3& axis,
          double flexion_rad);

  /// For a point of the bent wrist [mm, Patient].
  [[nodiscard]] BentPoint source_of(const Vec3& target) const noexcept;

  /// Inverse of source_of, by iteration.
  [[nodiscard]] Vec3 target_of(const Vec3& source) const noexcept;

 private:
  static constexpr int kShares = 256;

  [[nodiscard]] double share_at(const Vec3& target) const noexcept;
  [[nodiscard]] Vec3 turned_back(const Vec3& target, double share) const noexcept;

  Grid<float> to_hand_;     ///< distance to the nearest bone of the hand [mm], coarse
  Grid<float> to_forearm_;  ///< distance to radius or ulna as scanned [mm], coarse
  Vec3 pivot_;
  std::array<Mat3, kShares + 1> turn_back_;  ///< rotation of a share of the angle, target to scan
};

}  // namespace carpus::cases::detail
