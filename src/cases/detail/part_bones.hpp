// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Parts groups of bones that overlap by the least rigid motion: damped Gauss-Newton steps on the
// surfaces' signed distances. Joints that would open are drawn together to what the scan has.
#pragma once

#include <array>

#include "cases/detail/bone_scene.hpp"

namespace carpus::cases::detail {

/// How groups may move: those of one block move together.
struct Freedom {
  static constexpr int kFixed = -1;
  std::array<int, anatomy::kCarpalGroupCount> block_of_group{kFixed, kFixed, kFixed,
                                                             kFixed, kFixed, kFixed};
  std::array<bool, anatomy::kCarpalGroupCount> block_turns{};  ///< or is only shifted
  int block_count = 0;
};

/// Hand by shift; scaphoid, lunate and triquetrum freely; the forearm not.
[[nodiscard]] Freedom carpal_freedom() noexcept;
/// All but the ulna as one body, by shift.
[[nodiscard]] Freedom pronation_freedom() noexcept;

/// Distance that surfaces keep, where the scan has it: what is left of two layers of cartilage
/// pressed together [mm; clinical: B11 K, 0.5 mm a layer at least; E].
inline constexpr double kJointRoomMm = 0.5;

/// Moves the free groups until surfaces keep kJointRoomMm (or what the scan has, where that is
/// less), or no step helps. Bounded: at most 50 steps.
[[nodiscard]] GroupPoses part_bones(const BoneScene& scene,
                                    GroupPoses poses,
                                    const Freedom& freedom);

}  // namespace carpus::cases::detail
