// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The messages of Haply's Inverse Service, version 3.1 and newer, as its documentation and public
// samples show them: JSON objects with lists of devices. Pure: text in, text out.
#pragma once

#include <string>
#include <string_view>

#include "core/result.hpp"
#include "devices/device.hpp"

namespace carpus::devices {

struct HaplyState {
  std::string device_id;  ///< of the first Inverse3
  bool has_cursor = false;
  Vec3 position_mm;  ///< in its own axes: x right, y away, z up
  Vec3 velocity_mm_s;
  bool has_rotation = false;  ///< of a grip, with wire or without
  Mat3 rotation;
  std::uint32_t buttons = 0;  ///< a, b, c
  bool is_ready = true;       ///< calibrated and powered, where it says so
};

/// The longest that is read.
inline constexpr std::size_t kMostHaplyBytes = 65536;

/// A refusal says what is wrong. A list that is missing or empty is none.
[[nodiscard]] Result<HaplyState> read_haply_state(std::string_view text);

/// The service answers every message with the next state. @param force_n  in its axes.
[[nodiscard]] std::string haply_force_message(const std::string& device_id, const Vec3& force_n);

}  // namespace carpus::devices
