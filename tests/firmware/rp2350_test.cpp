// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Drive B's board as it is flashed, instruction by instruction on a Cortex-M33 (Unicorn), with the
// few peripherals that it uses played here by the chip's data sheet: the line, encoders, pulses,
// pins. Three motors with their windings turn at what its pulses make.
#include <gtest/gtest.h>
#include <unicorn/unicorn.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <deque>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "firmware/core/frame_decoder.hpp"
#include "firmware/core/frame_encoder.hpp"
#include "firmware/core/motor_arm.hpp"
#include "firmware/core/ssi_angle.hpp"
#include "firmware/rp2350/registers.hpp"
#include "virtual_arm/gimbal_motor.hpp"

namespace carpus::firmware {
namespace {

using namespace carpus::rp2350;

/// A leg by itself: its motor, what it carries, a little that rubs.
struct Leg {
  explicit Leg(std::uint64_t seed) : motor({}, seed) {}
  virtual_arm::GimbalMotor motor;
  double angle = 0;
  double rate = 0;
  double torque = 0;
  bool is_held = false;

  void step(double seconds, const WindingVolts& volts, bool is_on) {
    constexpr double kInertia = 6.6e-4 * 1e3;  // N mm s2
    torque = motor.step(seconds, volts, is_on, angle, rate);
    if (is_held) {
      rate = 0;
      return;
    }
    rate += seconds * (torque - 8 * rate - 4 * std::tanh(rate / 0.05)) / kInertia;
    angle += seconds * rate;
  }
};

class Chip {
 public:
  std::array<Leg, 3> legs{Leg{1}, Leg{2}, Leg{3}};
  std::deque<std::pair<std::uint8_t, double>> coming;  ///< with when each is whole [us]
  std::deque<std::pair<std::uint8_t, double>> going;
  HostDecoder decoder;
  Identity identity;
  Motion motion;
  Alignment alignment;
  int answers = 0;
  double now_us = 0;
  std::uint32_t outputs = 0;
  std::uint32_t enabled = 0;
  double fed_us = 0;  ///< when the watchdog was fed last
  std::uint16_t roll = 777;

  Chip() {
    check(uc_open(UC_ARCH_ARM, static_cast<uc_mode>(UC_MODE_THUMB | UC_MODE_MCLASS), &uc_));
    check(uc_ctl_set_cpu_model(uc_, UC_CPU_ARM_CORTEX_M33));
    check(uc_mem_map(uc_, 0x10000000, 0x100000, UC_PROT_ALL));
    check(uc_mem_map(uc_, 0x20000000, 0x80000, UC_PROT_ALL));
    check(uc_mem_map(uc_, 0xE0000000, 0x100000, UC_PROT_ALL));  // of the processor itself
    check(uc_mmio_map(uc_, 0x40000000, 0x200000, &read_low, this, &write_low, this));
    check(uc_mmio_map(uc_, 0xD0000000, 0x1000, &read_sio, this, &write_sio, this));
    load();
    registers_[kResetsReset] = 0x1FFFFFFF;
    registers_[kPllSys + kPllPower] = registers_[kPllUsb + kPllPower] = 0x2D;
    start();
  }
  Chip(const Chip&) = delete;
  Chip& operator=(const Chip&) = delete;
  ~Chip() { uc_close(uc_); }

  void run_to(double us) {
    until_us_ = us;
    std::uint32_t pc = 0;
    uc_reg_read(uc_, UC_ARM_REG_PC, &pc);
    const uc_err error = uc_emu_start(uc_, pc | 1U, 0, 0, 0);
    if (error != UC_ERR_OK) throw std::runtime_error(uc_strerror(error));
  }
  void run_ms(double ms) { run_to(now_us + 1000 * ms); }
  template <typename Frame>
  void send(const Frame& frame) {
    std::uint8_t bytes[kMaxFrameBytes];
    const int length = encode_frame(frame, ++sequence_, bytes);
    double at = coming.empty() ? now_us : std::max(now_us, coming.back().second);
    for (int i = 0; i < length; ++i) coming.emplace_back(bytes[i], at += 20);
  }
  [[nodiscard]] bool is_high(std::uint32_t pin) const {
    return (outputs >> pin & enabled >> pin & 1U) != 0;
  }
  [[nodiscard]] bool is_wired(std::uint32_t pin, std::uint32_t function) {
    return registers_[pin_control(pin)] == function && registers_.count(pad_of(pin)) == 1 &&
           (registers_[pad_of(pin)] & 0x100U) == 0;
  }
  std::uint32_t at(std::uint32_t address) { return registers_[address]; }

 private:
  static void check(uc_err error) {
    if (error != UC_ERR_OK) throw std::runtime_error(uc_strerror(error));
  }
  void load() {
    std::ifstream file(CARPUS_ARM_RP2350_ELF, std::ios::binary);
    const std::string elf{std::istreambuf_iterator<char>(file), {}};
    const auto word = [&](std::size_t at) {
      std::uint32_t value = 0;
      for (std::size_t i = 0; i < 4; ++i)
        value |= static_cast<std::uint32_t>(static_cast<std::uint8_t>(elf.at(at + i))) << 8 * i;
      return value;
    };
    const std::size_t heads = word(28);
    const std::size_t count = word(44) & 0xFFFFU;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t head = heads + 32 * i;
      const std::uint32_t size = word(head + 16);
      if (word(head) == 1 && size > 0)
        check(uc_mem_write(uc_, word(head + 12), elf.data() + word(head + 4), size));
    }
  }
  void start() {
    std::uint32_t vectors[2];
    check(uc_mem_read(uc_, 0x10000000, vectors, sizeof vectors));
    check(uc_reg_write(uc_, UC_ARM_REG_SP, &vectors[0]));
    check(uc_reg_write(uc_, UC_ARM_REG_PC, &vectors[1]));
  }

  /// Each look at the clock takes half a microsecond.
  std::uint32_t look_at_clock() {
    now_us += 0.5;
    while (plant_us_ + 25 <= now_us) {
      plant_us_ += 25;
      move();
    }
    while (!going.empty() && going.front().second <= now_us) {
      decoder.push(going.front().first);
      going.pop_front();
      while (decoder.next()) {
        ++answers;
        (void)decoder.read_frame(identity);
        (void)decoder.read_frame(motion);
        (void)decoder.read_frame(alignment);
      }
    }
    if (now_us >= until_us_) uc_emu_stop(uc_);
    return static_cast<std::uint32_t>(now_us);
  }
  void move() {
    for (std::uint32_t i = 0; i < 3; ++i) {
      WindingVolts volts;
      double mean = 0;
      for (std::uint32_t phase = 0; phase < 3; ++phase) {
        const std::uint32_t pin = phase_pin(i, phase);
        const std::uint32_t both = registers_[pwm_slice(pin / 2) + kPwmCompare];
        const std::uint32_t level = pin % 2 == 0 ? both & 0xFFFFU : both >> 16;
        const double share =
            static_cast<double>(level) / (registers_[pwm_slice(pin / 2) + kPwmTop] + 1.0);
        volts.volts[phase] = static_cast<float>(12 * share);
        mean += 4 * share;
      }
      for (float& one : volts.volts) one -= static_cast<float>(mean);
      legs[i].step(25e-6, volts, is_high(driver_pin(i)) && is_high(kSupplyPin));
    }
  }
  std::uint32_t read(std::uint32_t address) {
    switch (address) {
      case kTimerLow:
        return look_at_clock();
      case kXoscStatus:
        return kXoscStable;
      case kClkRefSelected:
        return 1U << (registers_[kClkRefCtrl] & 3U);
      case kClkSysSelected:
        return 1U << (registers_[kClkSysCtrl] & 1U);
      case kResetsDone:
        return ~registers_[kResetsReset];
      case kPllSys + kPllCs:
      case kPllUsb + kPllCs:
        return kPllLocked;
      case kUartFlags:
        return (coming.empty() || coming.front().second > now_us ? kUartNothingCame : 0U) |
               (going.size() >= 32 ? kUartNoRoom : 0U);
      case kUartData: {
        const std::uint8_t byte = coming.front().first;
        coming.pop_front();
        return byte;
      }
      case kSpiStatus:
        return spi_.empty() ? 0U : kSpiHasData;
      case kSpiData: {
        const std::uint8_t byte = spi_.front();
        spi_.pop_front();
        return byte;
      }
      case kAdcControl:
        return kAdcEnable | kAdcReady;
      case kAdcResult:
        return roll;
      default:
        return registers_[address];
    }
  }
  void write(std::uint32_t address, std::uint32_t value) {
    if (address == kUartData) {
      const double begins = going.empty() ? now_us : std::max(now_us, going.back().second);
      going.emplace_back(static_cast<std::uint8_t>(value), begins + 20);
    } else if (address == kSpiData) {
      spi_.push_back(next_of_encoder());
    } else if (address == kSioOutSet) {
      outputs |= value;
      if ((value & selects()) != 0) of_word_ = 0;
    } else if (address == kSioOutClear) {
      outputs &= ~value;
    } else if (address == kSioEnableSet) {
      enabled |= value;
    } else {
      registers_[address] = value;
      if (address == kWatchdogLoad) fed_us = now_us;
    }
  }
  static std::uint32_t selects() {
    return 1U << encoder_select_pin(0) | 1U << encoder_select_pin(1) | 1U << encoder_select_pin(2);
  }
  /// Of the one encoder that is selected, high byte first.
  std::uint8_t next_of_encoder() {
    for (std::uint32_t i = 0; i < 3; ++i) {
      if (is_high(encoder_select_pin(i))) continue;
      if (of_word_ == 0) {
        const auto counts = static_cast<std::uint32_t>(legs[i].motor.counts(legs[i].angle));
        const std::uint32_t said = (counts & 0x3FFFU) << 4;
        word_ = said << 6 | crc6(said);
      }
      const int shift = 16 - 8 * of_word_;
      of_word_ = (of_word_ + 1) % 3;
      return static_cast<std::uint8_t>(word_ >> shift);
    }
    return 0xFF;
  }

  static std::uint64_t read_low(uc_engine*, std::uint64_t offset, unsigned, void* chip) {
    return static_cast<Chip*>(chip)->read(0x40000000U + static_cast<std::uint32_t>(offset));
  }
  static void write_low(uc_engine*,
                        std::uint64_t offset,
                        unsigned,
                        std::uint64_t value,
                        void* chip) {
    static_cast<Chip*>(chip)->write(0x40000000U + static_cast<std::uint32_t>(offset),
                                    static_cast<std::uint32_t>(value));
  }
  static std::uint64_t read_sio(uc_engine*, std::uint64_t offset, unsigned, void* chip) {
    return static_cast<Chip*>(chip)->read(kSio + static_cast<std::uint32_t>(offset));
  }
  static void write_sio(uc_engine*,
                        std::uint64_t offset,
                        unsigned,
                        std::uint64_t value,
                        void* chip) {
    static_cast<Chip*>(chip)->write(kSio + static_cast<std::uint32_t>(offset),
                                    static_cast<std::uint32_t>(value));
  }

  uc_engine* uc_ = nullptr;
  std::map<std::uint32_t, std::uint32_t> registers_;
  std::deque<std::uint8_t> spi_;
  std::uint32_t word_ = 0;
  int of_word_ = 0;
  double until_us_ = 0;
  double plant_us_ = 0;
  std::uint8_t sequence_ = 0;
};

TEST(Rp2350Firmware, StartsWithEverythingOffItsPinsWiredAndSaysWhoItIs) {
  Chip chip;
  chip.run_ms(5);
  EXPECT_EQ(chip.enabled >> kSupplyPin & 1U, 1U);
  EXPECT_FALSE(chip.is_high(kSupplyPin));
  for (std::uint32_t i = 0; i < 3; ++i) {
    EXPECT_EQ(chip.enabled >> driver_pin(i) & 1U, 1U);
    EXPECT_FALSE(chip.is_high(driver_pin(i)));
    EXPECT_TRUE(chip.is_high(encoder_select_pin(i)));
    for (std::uint32_t phase = 0; phase < 3; ++phase)
      EXPECT_TRUE(chip.is_wired(phase_pin(i, phase), kFunctionPwm));
  }
  EXPECT_TRUE(chip.is_wired(kSendPin, kFunctionUart));
  EXPECT_TRUE(chip.is_wired(kReceivePin, kFunctionUart));
  EXPECT_EQ(chip.at(kPwmEnable), 0x3FU);
  EXPECT_LT(chip.now_us - chip.fed_us, 300) << "the watchdog is fed each step";
  chip.send(Hello{kProtocolVersion});
  chip.run_ms(3);
  EXPECT_EQ(chip.identity.drive, static_cast<std::uint8_t>(Drive::Motor));
  EXPECT_EQ(chip.identity.unit, 1U);
  EXPECT_EQ(chip.identity.version, kProtocolVersion);
}

TEST(Rp2350Firmware, FindsItsWindingsDrivesThemAndLetsGoWhenTheHostIsSilent) {
  Chip chip;
  chip.run_ms(60);
  chip.send(Hello{kProtocolVersion});
  chip.run_ms(3);
  int ms = 0;
  for (; ms < 9000; ++ms) {
    chip.send(Align{});
    chip.run_ms(1);
    if (chip.alignment.progress >= static_cast<std::uint8_t>(Progress::Found)) break;
  }
  ASSERT_EQ(chip.alignment.progress, static_cast<std::uint8_t>(Progress::Found)) << ms;
  Home home;
  for (std::uint32_t i = 0; i < 3; ++i) {
    const WindingsOf& truth = chip.legs[i].motor.windings();
    EXPECT_EQ(chip.alignment.windings_found[i], static_cast<std::uint8_t>(truth.windings));
    const auto beside = static_cast<std::int16_t>(
        static_cast<std::uint16_t>(chip.alignment.electrical_zero[i] - truth.electrical_zero));
    EXPECT_LT(std::abs(beside) * 360.0 / 65536, 12);
    home.electrical_zero[i] = chip.alignment.electrical_zero[i];
    home.windings[i] = chip.alignment.windings_found[i];
    // Where it stands now is called the middle of the arm's way.
    home.zero_counts[i] = static_cast<std::int32_t>(chip.legs[i].motor.zero_counts() +
                                                    chip.legs[i].angle / 3.83495197e-5 - 4628);
    chip.legs[i].is_held = true;
  }
  chip.send(home);
  chip.run_ms(3);
  Contact contact;
  contact.limit_mn = 5000;
  contact.force_mn[2] = 2000;
  for (ms = 0; ms < 120; ++ms) {
    chip.send(contact);
    chip.run_ms(1);
  }
  EXPECT_TRUE(chip.is_high(kSupplyPin));
  EXPECT_NEAR(chip.motion.force_mn[2], 2000, 20);
  EXPECT_EQ(chip.motion.roll, 777);
  // 2 N straight up are -70 N mm at each leg in the middle of its way.
  for (const Leg& leg : chip.legs) EXPECT_NEAR(leg.torque, -70, 25) << "cogging and tolerances";
  chip.run_ms(27);
  EXPECT_FALSE(chip.is_high(kSupplyPin));
  for (std::uint32_t i = 0; i < 3; ++i) EXPECT_FALSE(chip.is_high(driver_pin(i)));
}

}  // namespace
}  // namespace carpus::firmware
