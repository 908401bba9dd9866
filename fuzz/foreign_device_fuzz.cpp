// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Any bytes as what devices of others say: Haply's messages, a Falcon's frames, spacenavd's and the
// kernel's events. Whatever comes, the state that leaves a driver can be believed.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <span>
#include <string_view>

#include "devices/falcon_device.hpp"
#include "devices/gamepad_device.hpp"
#include "devices/haply_messages.hpp"
#include "devices/spacemouse_device.hpp"
#include "devices/trusted_state.hpp"
#include "refusals.hpp"

namespace {

using namespace carpus::devices;

/// Says these bytes, in pieces, and takes whatever it is told.
class Saying final : public ByteLink {
 public:
  explicit Saying(std::span<const std::uint8_t> bytes) : left_(bytes) {}
  [[nodiscard]] std::size_t read(std::span<std::uint8_t> into) noexcept override {
    const std::size_t count = std::min({into.size(), left_.size(), std::size_t{23}});
    for (std::size_t i = 0; i < count; ++i) into[i] = left_[i];
    left_ = left_.subspan(count);
    return count;
  }
  [[nodiscard]] bool write(std::span<const std::uint8_t>) noexcept override { return true; }
  [[nodiscard]] bool is_gone() const noexcept override { return false; }

 private:
  std::span<const std::uint8_t> left_;
};

class NoControls final : public GamepadControls {
 public:
  [[nodiscard]] bool range(std::uint16_t, Range&) const noexcept override { return false; }
  [[nodiscard]] bool can_rumble() const noexcept override { return false; }
  void rumble(double) noexcept override {}
};

void hear(Device& device, std::size_t size) {
  device.open();
  DeviceState state;
  Nanoseconds now = 1'000'000'000;
  for (std::size_t i = 0; i <= size / 16 + 2; ++i) {
    device.poll(now += kNsPerMs, state);
    if (!is_sound(state)) std::abort();
    device.command(now, {});
    carpus::fuzz::accepted += state.samples > 0 ? 1 : 0;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::uint8_t> bytes(data, size);
  FalconDevice falcon([&] { return std::make_unique<Saying>(bytes); });
  hear(falcon, size);
  SpaceMouseDevice mouse([&] { return std::make_unique<Saying>(bytes); });
  hear(mouse, size);
  GamepadDevice pad([&] {
    return OpenGamepad{std::make_unique<Saying>(bytes), std::make_unique<NoControls>()};
  });
  hear(pad, size);
  const auto haply = read_haply_state({reinterpret_cast<const char*>(data), size});
  if (!haply) {
    if (haply.error().empty()) std::abort();
    return 0;
  }
  ++carpus::fuzz::accepted;
  DeviceState state;
  state.position_mm = haply->position_mm;
  state.velocity_mm_s = haply->velocity_mm_s;
  state.rotation = haply->rotation;
  if (!is_sound(state)) std::abort();
  return 0;
}
