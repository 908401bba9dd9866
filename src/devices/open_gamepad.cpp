// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <linux/input.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>

#include "devices/descriptor_link.hpp"
#include "devices/gamepad_device.hpp"

namespace carpus::devices {
namespace {

constexpr std::size_t kBitsOfWord = 8;

template <std::size_t kBytes>
bool has_bit(const std::array<std::uint8_t, kBytes>& bits, std::size_t bit) {
  return bit / kBitsOfWord < kBytes && (bits[bit / kBitsOfWord] >> (bit % kBitsOfWord) & 1U) != 0;
}

class KernelControls final : public GamepadControls {
 public:
  explicit KernelControls(int descriptor) : descriptor_(descriptor) {
    std::array<std::uint8_t, FF_MAX / kBitsOfWord + 1> bits{};
    if (::ioctl(descriptor_, EVIOCGBIT(EV_FF, bits.size()), bits.data()) < 0) return;
    if (!has_bit(bits, FF_RUMBLE)) return;
    effect_.type = FF_RUMBLE;
    effect_.id = -1;
    can_rumble_ = ::ioctl(descriptor_, EVIOCSFF, &effect_) >= 0;
  }
  [[nodiscard]] bool range(std::uint16_t axis, Range& out) const noexcept override {
    input_absinfo info{};
    if (::ioctl(descriptor_, EVIOCGABS(axis), &info) < 0) return false;
    out = {info.minimum, info.maximum};
    return true;
  }
  [[nodiscard]] bool can_rumble() const noexcept override { return can_rumble_; }
  void rumble(double share) noexcept override {
    const auto strength = static_cast<std::uint16_t>(65535 * std::clamp(share, 0.0, 1.0));
    effect_.u.rumble.strong_magnitude = effect_.u.rumble.weak_magnitude = strength;
    constexpr std::uint16_t kMostMs = 1000;  // whatever happens to us
    effect_.replay.length = kMostMs;
    if (::ioctl(descriptor_, EVIOCSFF, &effect_) < 0) return;
    input_event play{};
    play.type = EV_FF;
    play.code = static_cast<std::uint16_t>(effect_.id);
    play.value = strength > 0 ? 1 : 0;
    if (::write(descriptor_, &play, sizeof play) < 0) can_rumble_ = false;
  }

 private:
  int descriptor_;  // the link's
  ff_effect effect_{};
  bool can_rumble_ = false;
};

}  // namespace

OpenGamepad open_gamepad(const std::string& path) {
  OpenGamepad pad;
  pad.link = open_character_device(path);
  pad.controls =
      std::make_unique<KernelControls>(static_cast<const DescriptorLink&>(*pad.link).descriptor());
  return pad;
}

bool is_gamepad(const std::string& path, std::string& name) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return false;
  std::array<std::uint8_t, KEY_MAX / kBitsOfWord + 1> keys{};
  const bool is = ::ioctl(descriptor, EVIOCGBIT(EV_KEY, keys.size()), keys.data()) >= 0 &&
                  has_bit(keys, BTN_GAMEPAD);
  std::array<char, 128> said{};
  if (is && ::ioctl(descriptor, EVIOCGNAME(said.size() - 1), said.data()) >= 0) name = said.data();
  ::close(descriptor);
  return is;
}

}  // namespace carpus::devices
