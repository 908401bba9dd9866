// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The few registers of an RP2350 that the board of drive B uses, by the chip's data sheet, and the
// pins of hardware/wiring.json. The simulated chip of the tests reads the same table.
#pragma once

#include <stdint.h>

namespace carpus {
namespace rp2350 {

constexpr uint32_t kClocks = 0x40010000;
constexpr uint32_t kPsm = 0x40018000;
constexpr uint32_t kResets = 0x40020000;
constexpr uint32_t kIoBank = 0x40028000;
constexpr uint32_t kPads = 0x40038000;
constexpr uint32_t kXosc = 0x40048000;
constexpr uint32_t kPllSys = 0x40050000;
constexpr uint32_t kPllUsb = 0x40058000;
constexpr uint32_t kUart0 = 0x40070000;
constexpr uint32_t kSpi0 = 0x40080000;
constexpr uint32_t kAdc = 0x400A0000;
constexpr uint32_t kPwm = 0x400A8000;
constexpr uint32_t kTimer0 = 0x400B0000;
constexpr uint32_t kWatchdog = 0x400D8000;
constexpr uint32_t kTicks = 0x40108000;
constexpr uint32_t kSio = 0xD0000000;

// Clocks: control registers; the one of a source's state follows eight bytes on.
constexpr uint32_t kClkRefCtrl = kClocks + 0x30;
constexpr uint32_t kClkRefSelected = kClocks + 0x38;
constexpr uint32_t kClkSysCtrl = kClocks + 0x3C;
constexpr uint32_t kClkSysSelected = kClocks + 0x44;
constexpr uint32_t kClkPeriCtrl = kClocks + 0x48;
constexpr uint32_t kClkAdcCtrl = kClocks + 0x6C;
constexpr uint32_t kClockEnable = 1U << 11;

constexpr uint32_t kXoscCtrl = kXosc + 0x00;
constexpr uint32_t kXoscStatus = kXosc + 0x04;
constexpr uint32_t kXoscStartup = kXosc + 0x0C;
constexpr uint32_t kXoscStable = 1U << 31;

// Of a phase-locked loop.
constexpr uint32_t kPllCs = 0x00;
constexpr uint32_t kPllPower = 0x04;
constexpr uint32_t kPllFeedback = 0x08;
constexpr uint32_t kPllPrimary = 0x0C;
constexpr uint32_t kPllLocked = 1U << 31;
constexpr uint32_t kPllPowerDown = 1U << 0;
constexpr uint32_t kPllPostPowerDown = 1U << 3;
constexpr uint32_t kPllVcoPowerDown = 1U << 5;

constexpr uint32_t kResetsReset = kResets + 0x00;
constexpr uint32_t kResetsDone = kResets + 0x08;
constexpr uint32_t kResetAdc = 1U << 0;
constexpr uint32_t kResetIoBank = 1U << 6;
constexpr uint32_t kResetPads = 1U << 9;
constexpr uint32_t kResetPllSys = 1U << 14;
constexpr uint32_t kResetPllUsb = 1U << 15;
constexpr uint32_t kResetPwm = 1U << 16;
constexpr uint32_t kResetSpi0 = 1U << 18;
constexpr uint32_t kResetTimer0 = 1U << 23;
constexpr uint32_t kResetUart0 = 1U << 26;

constexpr uint32_t pin_control(uint32_t pin) { return kIoBank + 0x04 + 8 * pin; }
constexpr uint32_t pad_of(uint32_t pin) { return kPads + 0x04 + 4 * pin; }
constexpr uint32_t kFunctionSpi = 1;
constexpr uint32_t kFunctionUart = 2;
constexpr uint32_t kFunctionPwm = 4;
constexpr uint32_t kFunctionSio = 5;
constexpr uint32_t kFunctionNone = 31;
constexpr uint32_t kPadInput = 1U << 6;
constexpr uint32_t kPadDrive4Ma = 1U << 4;
constexpr uint32_t kPadPullUp = 1U << 3;
constexpr uint32_t kPadPullDown = 1U << 2;
constexpr uint32_t kPadSchmitt = 1U << 1;
constexpr uint32_t kPadOutputOff = 1U << 7;

constexpr uint32_t kSioOutSet = kSio + 0x18;
constexpr uint32_t kSioOutClear = kSio + 0x20;
constexpr uint32_t kSioEnableSet = kSio + 0x38;

constexpr uint32_t kUartData = kUart0 + 0x00;
constexpr uint32_t kUartFlags = kUart0 + 0x18;
constexpr uint32_t kUartBaudWhole = kUart0 + 0x24;
constexpr uint32_t kUartBaudPart = kUart0 + 0x28;
constexpr uint32_t kUartLine = kUart0 + 0x2C;
constexpr uint32_t kUartControl = kUart0 + 0x30;
constexpr uint32_t kUartNothingCame = 1U << 4;
constexpr uint32_t kUartNoRoom = 1U << 5;
constexpr uint32_t kUartByteIsBad = 0xF00;  ///< framing, parity, break, overrun: with the byte

constexpr uint32_t kSpiControl0 = kSpi0 + 0x00;
constexpr uint32_t kSpiControl1 = kSpi0 + 0x04;
constexpr uint32_t kSpiData = kSpi0 + 0x08;
constexpr uint32_t kSpiStatus = kSpi0 + 0x0C;
constexpr uint32_t kSpiPrescale = kSpi0 + 0x10;
constexpr uint32_t kSpiHasData = 1U << 2;

constexpr uint32_t kAdcControl = kAdc + 0x00;
constexpr uint32_t kAdcResult = kAdc + 0x04;
constexpr uint32_t kAdcEnable = 1U << 0;
constexpr uint32_t kAdcStartOnce = 1U << 2;
constexpr uint32_t kAdcReady = 1U << 8;

constexpr uint32_t pwm_slice(uint32_t slice) { return kPwm + 0x14 * slice; }
constexpr uint32_t kPwmControl = 0x00;
constexpr uint32_t kPwmCompare = 0x0C;
constexpr uint32_t kPwmTop = 0x10;
constexpr uint32_t kPwmEnable = kPwm + 0xF0;
constexpr uint32_t kPwmUpAndDown = 1U << 1;

constexpr uint32_t kTimerLow = kTimer0 + 0x28;
constexpr uint32_t kTicksTimer0 = kTicks + 0x18;
constexpr uint32_t kTicksWatchdog = kTicks + 0x30;
constexpr uint32_t kTickCycles = 0x04;

constexpr uint32_t kWatchdogControl = kWatchdog + 0x00;
constexpr uint32_t kWatchdogLoad = kWatchdog + 0x04;
constexpr uint32_t kWatchdogEnable = 1U << 30;
constexpr uint32_t kPsmWatchdogResets = kPsm + 0x08;
/// All but both oscillators and what comes before them.
constexpr uint32_t kPsmAll = 0x01FFFFFF & ~0x0FU;

// Pins (hardware/wiring.json).
constexpr uint32_t phase_pin(uint32_t motor, uint32_t phase) { return 4 * motor + phase; }
constexpr uint32_t driver_pin(uint32_t motor) { return 4 * motor + 3; }
constexpr uint32_t kSendPin = 12;
constexpr uint32_t kReceivePin = 13;
constexpr uint32_t kEncoderDataPin = 16;
constexpr uint32_t kEncoderClockPin = 18;
constexpr uint32_t encoder_select_pin(uint32_t motor) { return motor == 0 ? 17 : 19 + motor; }
constexpr uint32_t kSupplyPin = 22;
constexpr uint32_t kRollPin = 26;

/// 150 MHz; pulses of 25 kHz, counted up and down.
constexpr uint32_t kSystemHz = 150000000;
constexpr uint32_t kPwmTopCount = 2999;
constexpr float kSupplyVolts = 12.0F;

}  // namespace rp2350
}  // namespace carpus
