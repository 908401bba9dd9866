// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A Novint Falcon whose firmware runs already: 16 bytes each way in turn, '<', twelve nibbles of
// three motors (least first, each raised by 'A'), lights and homing, 'A', '>'. What puts the
// maker's firmware into it is not ours to give (docs/devices.md).
#pragma once

#include <utility>

#include "devices/byte_link.hpp"
#include "devices/device.hpp"
#include "devices/falcon_arm.hpp"

namespace carpus::devices {

inline constexpr std::size_t kFalconFrameBytes = 16;
using FalconFrame = std::array<std::uint8_t, kFalconFrameBytes>;

struct FalconSays {
  std::array<std::int16_t, 3> counts{};
  std::uint8_t buttons = 0;  ///< four
  std::uint8_t homed = 0;    ///< a bit each leg
};
/// False where it is no frame.
[[nodiscard]] bool read_falcon(const FalconFrame& frame, FalconSays& out) noexcept;
[[nodiscard]] FalconFrame falcon_frame(const std::array<std::int16_t, 3>& motors,
                                       std::uint8_t lights_and_homing) noexcept;

class FalconDevice final : public Device {
 public:
  explicit FalconDevice(OpenLink open_link) : open_link_(std::move(open_link)) {}
  ~FalconDevice() override { close(); }

  [[nodiscard]] Capabilities capabilities() const override;
  void open() override;
  void close() noexcept override;
  void poll(Nanoseconds now, DeviceState& state) noexcept override;
  void command(Nanoseconds now, const DeviceCommand& command) noexcept override;

 private:
  void take(Nanoseconds now, std::uint8_t byte) noexcept;
  void take_frame(Nanoseconds now) noexcept;

  OpenLink open_link_;
  std::unique_ptr<ByteLink> link_;
  DeviceState state_;
  FalconFrame frame_{};
  std::size_t frame_count_ = 0;
  FalconAngles angles_{};
  Vec3 tip_ = kFalconCentre;
  bool has_place_ = false;
  bool is_homed_ = false;
  bool is_impossible_ = false;
  bool is_asked_ = false;  ///< the next frame goes out when this one was answered
  Nanoseconds asked_ns_ = 0;
  Nanoseconds placed_ns_ = 0;
  Nanoseconds answered_ns_ = 0;
  Nanoseconds opened_ns_ = 0;
};

}  // namespace carpus::devices
