// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Drive B on a Raspberry Pi Pico 2 (RP2350, a Cortex-M33 at 150 MHz), hardware revision 1: wires
// the core (motor_arm.hpp) to pins, and nothing else. No library, no interrupt: one loop takes what
// came on the line, and every 250 us reads the encoders, steps the core and sets the windings.
//
//   GP0..2, 4..6, 8..10  windings' pulses, motors 1 to 3     GP3, 7, 11  their drivers on
//   GP12, GP13           to and from the host, 500 kbaud     GP22        motors' supply on
//   GP16, GP18           encoders' data, clock               GP17, 20, 21  encoders' selects
//   GP26                 the tool's roll
//
// The line holds 32 bytes by itself, 640 us of it: the loop may be away for one step.
#include "firmware/core/motor_arm.hpp"
#include "firmware/core/ssi_angle.hpp"
#include "firmware/rp2350/registers.hpp"

extern "C" {
extern uint32_t carpus_stack_top;
extern uint32_t carpus_data_begin;
extern uint32_t carpus_data_end;
extern const uint32_t carpus_data_from;
extern uint32_t carpus_bss_begin;
extern uint32_t carpus_bss_end;
extern const uint32_t carpus_unit;
void reset();
void halt();

__attribute__((section(".vectors"), used)) const void* const carpus_vectors[] = {
    &carpus_stack_top, reinterpret_cast<const void*>(&reset), reinterpret_cast<const void*>(&halt),
    reinterpret_cast<const void*>(&halt)};

/// What the boot program looks for: an image for the secure Arm cores that is to be run.
__attribute__((section(".image_definition"), used)) const uint32_t carpus_image_definition[] = {
    0xFFFFDED3, 0x10210142, 0x000001FF, 0x00000000, 0xAB123579};

// What the compiler asks for where there is no C library.
void* memcpy(void* to, const void* from, size_t size) {
  for (size_t i = 0; i < size; ++i) {
    static_cast<volatile uint8_t*>(to)[i] = static_cast<const uint8_t*>(from)[i];
  }
  return to;
}
void* memset(void* to, int value, size_t size) {
  for (size_t i = 0; i < size; ++i) {
    static_cast<volatile uint8_t*>(to)[i] = static_cast<uint8_t>(value);
  }
  return to;
}
}

namespace {

using carpus::firmware::MotorArm;
using carpus::firmware::TurnCounter;
using carpus::firmware::WindingVolts;
using namespace carpus::rp2350;

constexpr uint32_t kMotors = 3;
constexpr uint32_t kStepUs = 1000000 / carpus::firmware::kMotorStepHz;

volatile uint32_t& at(uint32_t address) { return *reinterpret_cast<volatile uint32_t*>(address); }
uint32_t now_us() { return at(kTimerLow); }

void release_from_reset(uint32_t what) {
  at(kResetsReset) = at(kResetsReset) & ~what;
  while ((at(kResetsDone) & what) != what) {
  }
}

/// @param feedback  times 12 MHz @param first, second  divisors of that.
void start_pll(uint32_t pll, uint32_t feedback, uint32_t first, uint32_t second) {
  at(pll + kPllCs) = 1;
  at(pll + kPllFeedback) = feedback;
  at(pll + kPllPower) = at(pll + kPllPower) & ~(kPllPowerDown | kPllVcoPowerDown);
  while ((at(pll + kPllCs) & kPllLocked) == 0) {
  }
  at(pll + kPllPrimary) = first << 16 | second << 12;
  at(pll + kPllPower) = at(pll + kPllPower) & ~kPllPostPowerDown;
}

/// The crystal, 150 MHz for all, 48 MHz for the converter, and ticks of 1 us.
void start_clocks() {
  at(kXoscStartup) = 47 * 6;  // six milliseconds
  at(kXoscCtrl) = 0xFABAA0;
  while ((at(kXoscStatus) & kXoscStable) == 0) {
  }
  // From the crystal first, while the loops start.
  at(kClkRefCtrl) = 2;
  while ((at(kClkRefSelected) & (1U << 2)) == 0) {
  }
  at(kClkSysCtrl) = 0;
  while ((at(kClkSysSelected) & (1U << 0)) == 0) {
  }
  release_from_reset(kResetPllSys | kResetPllUsb);
  start_pll(kPllSys, 125, 5, 2);
  start_pll(kPllUsb, 100, 5, 5);
  at(kClkSysCtrl) = 1;
  while ((at(kClkSysSelected) & (1U << 1)) == 0) {
  }
  at(kClkPeriCtrl) = kClockEnable;
  at(kClkAdcCtrl) = kClockEnable;
  at(kTicksTimer0 + kTickCycles) = 12;
  at(kTicksTimer0) = 1;
  at(kTicksWatchdog + kTickCycles) = 12;
  at(kTicksWatchdog) = 1;
}

void set_pin(uint32_t pin, uint32_t function, uint32_t pad) {
  at(pin_control(pin)) = function;
  at(pad_of(pin)) = pad;  // its isolation ends here
}

void start_pins() {
  release_from_reset(kResetIoBank | kResetPads | kResetPwm | kResetSpi0 | kResetUart0 | kResetAdc |
                     kResetTimer0);
  constexpr uint32_t kOutput = kPadInput | kPadDrive4Ma | kPadSchmitt;
  // Off before they are outputs: supply and drivers low, encoders not selected.
  uint32_t low = 1U << kSupplyPin;
  uint32_t high = 0;
  for (uint32_t i = 0; i < kMotors; ++i) {
    low |= 1U << driver_pin(i);
    high |= 1U << encoder_select_pin(i);
  }
  at(kSioOutClear) = low;
  at(kSioOutSet) = high;
  at(kSioEnableSet) = low | high;
  set_pin(kSupplyPin, kFunctionSio, kOutput);
  for (uint32_t i = 0; i < kMotors; ++i) {
    set_pin(driver_pin(i), kFunctionSio, kOutput);
    set_pin(encoder_select_pin(i), kFunctionSio, kOutput);
    for (uint32_t phase = 0; phase < 3; ++phase) {
      set_pin(phase_pin(i, phase), kFunctionPwm, kOutput);
    }
  }
  set_pin(kSendPin, kFunctionUart, kOutput);
  set_pin(kReceivePin, kFunctionUart, kPadInput | kPadSchmitt | kPadPullUp);
  set_pin(kEncoderDataPin, kFunctionSpi, kPadInput | kPadSchmitt | kPadPullUp);
  set_pin(kEncoderClockPin, kFunctionSpi, kOutput);
  set_pin(kRollPin, kFunctionNone, kPadOutputOff | kPadPullDown);
}

void start_devices() {
  // 150 MHz / 16 / 500000 = 18.75.
  at(kUartBaudWhole) = 18;
  at(kUartBaudPart) = 48;
  at(kUartLine) = 0x70;  // eight bits, with its store
  at(kUartControl) = 0x301;
  // 5 MHz; the encoder puts a bit on the line as the clock rises, it is read as that falls.
  at(kSpiPrescale) = 10;
  at(kSpiControl0) = 7 | 1U << 7 | 2U << 8;
  at(kSpiControl1) = 2;
  at(kAdcControl) = kAdcEnable;
  // Three windings of a motor lie on two slices; all count together.
  uint32_t slices = 0;
  for (uint32_t slice = 0; slice < 2 * kMotors; ++slice) {
    at(pwm_slice(slice) + kPwmTop) = kPwmTopCount;
    at(pwm_slice(slice) + kPwmCompare) = 0;
    at(pwm_slice(slice) + kPwmControl) = kPwmUpAndDown;
    slices |= 1U << slice;
  }
  at(kPwmEnable) = slices;
  // 15 ms without a turn of the loop, and everything begins anew, drivers off.
  at(kPsmWatchdogResets) = kPsmAll;
  at(kWatchdogLoad) = 15000;
  at(kWatchdogControl) = kWatchdogEnable;
}

uint32_t read_encoder(uint32_t motor) {
  const uint32_t select = 1U << encoder_select_pin(motor);
  at(kSioOutClear) = select;
  for (uint8_t i = 0; i < 3; ++i) at(kSpiData) = 0;
  uint32_t word = 0;
  for (uint8_t i = 0; i < 3; ++i) {
    while ((at(kSpiStatus) & kSpiHasData) == 0) {
    }
    word = word << 8 | (at(kSpiData) & 0xFF);
  }
  at(kSioOutSet) = select;
  return word;
}

/// Half of the supply at no voltage; the middle of the three moves so that most can be had.
uint32_t compare_of(float volts, float middle) {
  const float share = 0.5F + (volts - middle) * (1.0F / kSupplyVolts);
  return static_cast<uint32_t>(carpus::firmware::clamped(share, 0.0F, 1.0F) * (kPwmTopCount + 1));
}

void set_windings(uint32_t motor, const WindingVolts& volts) {
  float least = volts.volts[0];
  float most = least;
  for (const float one : volts.volts) {
    least = one < least ? one : least;
    most = one > most ? one : most;
  }
  const float middle = 0.5F * (least + most);
  const uint32_t first = compare_of(volts.volts[0], middle);
  const uint32_t second = compare_of(volts.volts[1], middle);
  const uint32_t third = compare_of(volts.volts[2], middle);
  at(pwm_slice(2 * motor) + kPwmCompare) = second << 16 | first;
  at(pwm_slice(2 * motor + 1) + kPwmCompare) = third;
}

/// Drivers and supply, all or none.
void drive(bool is_on) {
  uint32_t pins = 1U << kSupplyPin;
  for (uint32_t i = 0; i < kMotors; ++i) pins |= 1U << driver_pin(i);
  at(is_on ? kSioOutSet : kSioOutClear) = pins;
}

class Board {
 public:
  explicit Board(uint32_t unit) : arm_(unit) {}

  [[noreturn]] void run() {
    uint32_t due = now_us() + kStepUs;
    for (;;) {
      serve_line();
      const uint32_t now = now_us();
      if (static_cast<int32_t>(now - due) < 0) continue;
      step(now);
      // A step that comes late is not made up for.
      due = static_cast<int32_t>(now - due) < static_cast<int32_t>(kStepUs) ? due + kStepUs
                                                                            : now + kStepUs;
    }
  }

 private:
  void serve_line() {
    while ((at(kUartFlags) & kUartNothingCame) == 0) {
      const uint32_t came = at(kUartData);
      // What came damaged is passed on all the same: its frame's checksum refuses it.
      arm_.take(static_cast<uint8_t>(came), now_us());
    }
    if (sent_ == length_) {
      sent_ = 0;
      length_ = arm_.reply(sending_, now_us());
    }
    while (sent_ < length_ && (at(kUartFlags) & kUartNoRoom) == 0) {
      at(kUartData) = sending_[sent_++];
    }
  }

  void step(uint32_t now) {
    int32_t counts[kMotors];
    for (uint32_t i = 0; i < kMotors; ++i) counts[i] = counters_[i].take(read_encoder(i));
    if ((at(kAdcControl) & kAdcReady) != 0) {
      arm_.sample_roll(static_cast<uint16_t>(at(kAdcResult) & 0xFFF));
      at(kAdcControl) = kAdcEnable | kAdcStartOnce;
    }
    float torques[kMotors];
    arm_.step(counts, now, torques);
    for (uint32_t i = 0; i < kMotors; ++i) set_windings(i, arm_.volts(static_cast<uint8_t>(i)));
    drive(arm_.is_driving());
    at(kWatchdogLoad) = 15000;
  }

  MotorArm arm_;
  TurnCounter counters_[kMotors];
  uint8_t sending_[carpus::firmware::kMaxDeviceFrameBytes];
  uint8_t length_ = 0;
  uint8_t sent_ = 0;
};

}  // namespace

extern "C" {

/// A fault of the processor: everything off until the watchdog begins anew.
void halt() {
  drive(false);
  for (;;) {
  }
}

void reset() {
  // The floating-point unit is off after a reset.
  at(0xE000ED88) = at(0xE000ED88) | 0xFU << 20;
  asm volatile("dsb\nisb");
  const uint32_t* from = &carpus_data_from;
  for (uint32_t* to = &carpus_data_begin; to < &carpus_data_end;) *to++ = *from++;
  for (uint32_t* to = &carpus_bss_begin; to < &carpus_bss_end;) *to++ = 0;
  start_clocks();
  start_pins();
  start_devices();
  Board board(carpus_unit);
  board.run();
}

}  // extern "C"
