// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What an operation feels like through a device: bone under cartilage or soft tissue before it is
// touched, a line in bone that holds the tool, a drill's shake, a screw's detents. Laws of one tick
// in any frame of millimetres; figures from tissue_feel.hpp. Real-time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "haptics/tissue_feel.hpp"

namespace carpus::haptics {

/// What turns the tool.
enum class TurnedBy : std::uint8_t { Nothing = 0, Motor = 1, Hand = 2 };

/// Bone near the foremost point of a free tool.
struct SurfaceNear {
  bool is_there = false;
  double gap_mm = 0;
  Vec3 normal;  ///< unit, out of the bone
  bool has_cartilage = false;
};

/// One tick of what a hand holds.
struct FeltMoment {
  Vec3 tip;                 ///< where it is
  Vec3 wish;                ///< where the hand is
  Vec3 shaft{0, 0, 1};      ///< unit, from the tip to the hand
  bool is_in_bone = false;  ///< its line is fixed
  bool is_pointed = false;
  bool is_held_back = false;  ///< the world says that something is in the way
  double most_n_per_mm = 10;  ///< that the device can render
  SurfaceNear near;
  TurnedBy turned_by = TurnedBy::Nothing;
  bool is_turning = false;
  double resistance_n = 0;
  double feed_share = 0;  ///< of the fastest that the tool goes on, 0 to 1
  double turns = 0;       ///< that a thread has made
  double torque_n_mm = 0;
};

struct Felt {
  std::array<SurfacePlane, 2> planes;
  std::size_t plane_count = 0;
  double vibration_n = 0;
  double vibration_hz = 0;
};

/// Thrust at the tool for what a hand presses on a device of this peak force [N]: bone of 45 N is
/// felt as a share of what the device can give. At least as much as is pressed.
[[nodiscard]] double thrust_of_press_n(const DrillingFeel& feel,
                                       double press_n,
                                       double peak_force_n) noexcept;

/// What a hand presses along the shaft against a plane of this stiffness [N].
[[nodiscard]] double press_n(const FeltMoment& moment, double stiffness_n_per_mm) noexcept;

/// Shake of a powered tool [N] and its rate [Hz].
struct Shake {
  double size_n = 0;
  double rate_hz = 0;
};
[[nodiscard]] Shake drill_shake(const DrillingFeel& feel,
                                double resistance_n,
                                double feed_share) noexcept;

/// One hand's tool, a tick at a time.
class OperationFeel {
 public:
  explicit OperationFeel(const FeelTable& table) noexcept : table_(table) {}
  [[nodiscard]] Felt feel(const FeltMoment& moment) noexcept;
  /// The tool was laid down, or time stood still.
  void rest() noexcept { pulse_ticks_ = 0, has_turns_ = false; }

 private:
  [[nodiscard]] SurfaceFeel bone_of(const FeltMoment& moment) const noexcept;
  void put_near_surface(const FeltMoment& moment, Felt& felt) const noexcept;
  void put_line(const FeltMoment& moment, Felt& felt) const noexcept;
  [[nodiscard]] Shake detent(const FeltMoment& moment) noexcept;

  const FeelTable& table_;
  double detents_ = 0;
  bool has_turns_ = false;
  int pulse_ticks_ = 0;
};

}  // namespace carpus::haptics
