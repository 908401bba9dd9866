// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The state after a tick as messages of the protocol.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/pose.hpp"
#include "protocol/messages.hpp"
#include "session/body_names.hpp"
#include "simulation/snapshot.hpp"

namespace carpus::session {

/// How the host keeps time.
struct HostState {
  bool paused = false;
  double tick_rate_hz = 0.0;
  double tick_p99_us = 0.0;
  std::uint64_t late_ticks = 0;
};

/// All but the bodies' poses.
[[nodiscard]] protocol::Snapshot snapshot_message(const simulation::Snapshot& now,
                                                  const HostState& host,
                                                  const BodyNames& bodies);
[[nodiscard]] std::vector<protocol::BodyPose> body_poses(const simulation::Snapshot& now);
[[nodiscard]] protocol::Tissue tissue_message(const simulation::Snapshot& now,
                                              const BodyNames& bodies);

/// A rotation as a unit quaternion w, x, y, z with w >= 0; [shepperd1978quaternion]: divides by the
/// greatest of the four.
[[nodiscard]] std::array<double, 4> quaternion_of(const Mat3& rotation) noexcept;

}  // namespace carpus::session
