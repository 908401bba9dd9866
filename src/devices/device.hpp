// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What every input device is to the trainer, whatever it is made of: what it can do, where it is,
// what it is asked for. A driver speaks to one device; the loop around it (host_loop.hpp) brings
// clock and thread. Positions in the device's own frame: mm about the middle of its workspace, x to
// the right of whoever sits before it, y away from them, z up.
//
// Whatever a device says is not trusted: drivers refuse what is no number or out of range, count
// it, and keep the last that was good.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <type_traits>

#include "geometry/aabb.hpp"
#include "geometry/mat3.hpp"
#include "geometry/vec3.hpp"

namespace carpus::devices {

/// On the monotonic clock.
using Nanoseconds = std::int64_t;
inline constexpr Nanoseconds kNsPerMs = 1'000'000;

enum class Health : std::uint8_t {
  Closed = 0,        ///< not asked for yet
  Starting = 1,      ///< open, and has not said yet who it is
  Uncalibrated = 2,  ///< it is heard, but its readings are no places yet
  Good = 3,
  HoldingBack = 4,  ///< works, with less force than asked for: hot, or at a limit of its own
  Silent = 5,       ///< open, and has said nothing for kSilentNs
  Faulty = 6,       ///< it says that a sensor is broken, or says what cannot be
  Gone = 7,         ///< unplugged, switched off, or never there
};
inline constexpr int kHealths = 8;
/// Whether its poses can be worked with.
[[nodiscard]] constexpr bool is_usable(Health health) noexcept {
  return health == Health::Good || health == Health::HoldingBack;
}
/// A device that answers each millisecond and has not for so long is silent.
inline constexpr Nanoseconds kSilentNs = 50 * kNsPerMs;

/// What drive B says of how its motors' windings stand to their encoders, while it looks for that.
struct MotorWindings {
  std::uint8_t progress = 0;  ///< firmware::Progress
  std::array<std::uint16_t, 3> electrical_zero{};
  std::array<std::uint8_t, 3> windings{};  ///< firmware::Windings
};

/// What a device is able to do.
struct Capabilities {
  bool position = false;
  bool rotation = false;
  bool roll = false;         ///< says how what is held is turned about its shaft
  bool absolute = false;     ///< says where it is; else how fast it is to move
  bool force = false;        ///< a force that the host computes
  bool stop = false;         ///< a wall that stands still, and no force
  bool local_plane = false;  ///< renders planes by itself, faster than the host
  bool vibration = false;
  bool torque = false;  ///< about the shaft of what is held
  double rate_hz = 0;   ///< of what it says
  double peak_force_n = 0;
  double lasting_force_n = 0;
  double most_stiffness_n_per_mm = 0;
  Aabb workspace;  ///< [mm]; empty where it says no places
};

/// Where a device is, as far as it is believed. Plain bytes: it crosses threads by copy.
struct DeviceState {
  Health health = Health::Closed;
  Nanoseconds heard_ns = 0;   ///< when it last said where it is
  std::uint64_t samples = 0;  ///< so often it has
  Vec3 position_mm;
  Mat3 rotation;        ///< of what is held, device from handle; its shaft is column 2
  double roll_rad = 0;  ///< about the shaft, towards the hand; from where its sensor begins
  Vec3 velocity_mm_s;   ///< of a device that is not absolute what it asks for
  Vec3 spin_rad_s;
  std::uint32_t buttons = 0;
  Vec3 force_n;               ///< that it says to give; zero where it does not say
  double round_trip_us = 0;   ///< of the last question that was answered; 0: not known
  double hottest_c = 0;       ///< 0: not known
  std::uint64_t refused = 0;  ///< frames, messages or numbers that were not believed
  /// What its sensors say as they say it, for whoever calibrates.
  std::array<std::int32_t, 3> raw_counts{};
  std::uint64_t raw_samples = 0;
  MotorWindings windings;  ///< likewise
  std::uint32_t unit = 0;  ///< of a device that tells its number
  bool has_unit = false;
  std::uint64_t unsent = 0;  ///< commands for which there was no room on the line
};
static_assert(std::is_trivially_copyable_v<DeviceState>);

/// Bone near the tip, in the device's frame: the side to which the normal points is free.
struct LocalPlane {
  Vec3 normal{0, 0, 1};
  double offset_mm = 0;  ///< of the plane along its normal
  double stiffness_n_per_mm = 0;
  double damping_n_s_per_mm = 0;
  double friction = 0;
};

inline constexpr std::size_t kMostPlanes = 2;

/// What a device is asked for until the next command. As it stands: nothing at all.
struct DeviceCommand {
  std::array<LocalPlane, kMostPlanes> planes;
  std::uint8_t plane_count = 0;
  Vec3 force_n;        ///< besides what the planes give
  double limit_n = 0;  ///< of all together
  double vibration_n = 0;
  double vibration_hz = 0;
  double torque_n_mm = 0;  ///< against the hand's turning of the shaft
};
static_assert(std::is_trivially_copyable_v<DeviceCommand>);

class Device {
 public:
  Device() = default;
  virtual ~Device() = default;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  [[nodiscard]] virtual Capabilities capabilities() const = 0;
  /// Makes the line ready, and takes whatever memory is needed until close(). May be called again
  /// after the device was Gone. @throws IoError with what to do.
  virtual void open() = 0;
  /// No force, and the line is free for others.
  virtual void close() noexcept = 0;
  /// Takes what has come; never waits, allocates or throws.
  virtual void poll(Nanoseconds now, DeviceState& state) noexcept = 0;
  /// Hands over what is wished; never waits, allocates or throws. Of what the device cannot do the
  /// driver does the nearest that is weaker.
  virtual void command(Nanoseconds now, const DeviceCommand& command) noexcept = 0;
  /// While it is calibrated, nobody's hand on it: drive A's servos are to turn to this pulse,
  /// whatever is commanded; of drive B, at any pulse, its motors are to find how their windings
  /// stand; 0: as usual. To be called each turn.
  virtual void turn_servos(int /*pulse_us*/) noexcept {}
};

/// "position, force, local planes": what it is able to do.
[[nodiscard]] std::string in_words(const Capabilities& able);
/// "good", "unplugged" ...
[[nodiscard]] const char* in_words(Health health) noexcept;
/// What a person can do about it; empty where there is nothing to do.
[[nodiscard]] const char* what_to_do(Health health) noexcept;

}  // namespace carpus::devices
