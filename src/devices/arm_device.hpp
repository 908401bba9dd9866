// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Our own force-feedback arm, of either drive, over a line of bytes (protocol/README.md): greets
// it, gives it its calibration, then asks once a command and takes what it answers. After a reset
// of the device it begins anew by itself.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "arm/delta_arm.hpp"
#include "devices/arm_calibration.hpp"
#include "devices/byte_link.hpp"
#include "devices/device.hpp"
#include "devices/trusted_command.hpp"
#include "firmware/core/frame_decoder.hpp"
#include "haptics/leg_stops.hpp"
#include "haptics/local_planes.hpp"
#include "haptics/passivity_net.hpp"

namespace carpus::devices {

class ArmDevice final : public Device {
 public:
  /// @param calibrations  folder in which they are kept, read by each open().
  ArmDevice(OpenLink open_link, std::filesystem::path calibrations);
  ~ArmDevice() override;

  [[nodiscard]] Capabilities capabilities() const override;
  void open() override;
  void close() noexcept override;
  void poll(Nanoseconds now, DeviceState& state) noexcept override;
  void command(Nanoseconds now, const DeviceCommand& command) noexcept override;
  void turn_servos(int pulse_us) noexcept override { pulse_us_ = pulse_us; }

  /// Once it has said who it is.
  [[nodiscard]] const std::optional<firmware::Identity>& identity() const noexcept {
    return identity_;
  }
  /// Why a calibration could not be read, of the last open().
  [[nodiscard]] const std::vector<std::string>& problems() const noexcept { return problems_; }

 private:
  enum class Phase : std::uint8_t { Greeting, Configuring, Working };

  /// Hello again after so long without an answer.
  static constexpr Nanoseconds kGreetAgainNs = 100 * kNsPerMs;
  static constexpr std::size_t kReadAtOnce = 256;

  template <typename Frame>
  bool send(Nanoseconds now, const Frame& frame) noexcept;
  void greet(Nanoseconds now) noexcept;
  void take_frame(Nanoseconds now) noexcept;
  void take(Nanoseconds now, const firmware::Identity& identity) noexcept;
  void take(Nanoseconds now, const firmware::Sensors& sensors) noexcept;
  void take(Nanoseconds now, const firmware::Motion& motion) noexcept;
  void take(Nanoseconds now, const firmware::Alignment& alignment) noexcept;
  void take_roll(std::uint16_t roll) noexcept;
  void heard(Nanoseconds now, std::uint8_t echo, std::uint8_t status) noexcept;
  void place(Nanoseconds now, const arm::LegAngles& angles) noexcept;
  void configure(Nanoseconds now) noexcept;
  void turn_servos_now(Nanoseconds now) noexcept;
  [[nodiscard]] bool is_homed_by_us() const noexcept;
  [[nodiscard]] Health health_at(Nanoseconds now) const noexcept;
  /// In the arm's own frame.
  [[nodiscard]] haptics::HapticWish wish_of(const DeviceCommand& command) const noexcept;
  [[nodiscard]] firmware::Stop stops_of(const haptics::HapticWish& wish) noexcept;

  OpenLink open_link_;
  std::filesystem::path folder_;
  std::unique_ptr<ByteLink> link_;
  std::vector<ArmCalibration> calibrations_;
  std::vector<std::string> problems_;
  const ArmCalibration* calibration_ = nullptr;
  arm::DeltaArm arm_;
  firmware::HostDecoder decoder_;
  std::optional<firmware::Identity> identity_;
  Vec3 weight_n_;  ///< drive B: that carries the arm where it is
  /// Drive B: what each command asked for besides what is to be felt: the arm's weight carried, its
  /// motors' cogging taken off.
  std::array<Vec3, 256> unfelt_n_{};
  /// Drive B: counts at angle 0 of the unit that was homed last. They hold until that is reset, so
  /// that a line that is opened anew need not find the arm in its cradle.
  std::array<std::int32_t, kLegs> home_{};
  std::optional<std::uint32_t> homed_unit_;
  DeviceState state_;
  arm::LegAngles angles_{};
  arm::LegAngles rates_{};
  haptics::LegStops stops_;
  haptics::PassivityNet net_;
  haptics::ForceLimiter limiter_{kMostForceN};
  Phase phase_ = Phase::Greeting;
  std::uint8_t sequence_ = 0;
  std::uint8_t status_ = 0;
  std::uint8_t next_leg_ = 0;
  std::array<std::uint8_t, kLegs> config_sequences_{};
  std::array<bool, kLegs> has_sent_{};
  std::array<bool, kLegs> has_config_{};  ///< drive A: the leg has answered to its calibration
  std::uint8_t turn_configs_ = 0;         ///< how often the legs were told to obey pulses
  int pulse_us_ = 0;
  bool has_place_ = false;
  bool is_impossible_ = false;  ///< what the sensors say is no place
  Nanoseconds opened_ns_ = 0;
  Nanoseconds greeted_ns_ = 0;
  Nanoseconds placed_ns_ = 0;
  Nanoseconds answered_ns_ = 0;
  std::array<Nanoseconds, 256> sent_ns_{};
};

}  // namespace carpus::devices
