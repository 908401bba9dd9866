// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The board of firmware/avr in simavr, cycle by cycle, on a clock that the caller moves: what its
// pins and its serial line do, and how much of its time the program uses. For tests and the bench
// alone: simavr is GPL, and nothing that is installed links it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace carpus::firmware {

class SimulatedAvr {
 public:
  static constexpr double kHz = 16e6;
  static constexpr int kLegs = 3;

  /// @throws Error where the file is no program for this processor.
  explicit SimulatedAvr(const std::string& elf_file);
  ~SimulatedAvr();
  SimulatedAvr(const SimulatedAvr&) = delete;
  SimulatedAvr& operator=(const SimulatedAvr&) = delete;

  /// Runs to this time since the start [us].
  void run_to(double us);
  [[nodiscard]] double now_us() const;
  /// Voltage of a potentiometer's wiper, of 5 V; `kRollInput`: of the sensor of the tool's roll.
  void set_wiper_mv(int leg, double mv);
  static constexpr int kRollInput = 3;
  /// A byte begins on the line now; the firmware has it a byte's time later.
  void receive(std::uint8_t byte);
  /// A supply that failed and came back: everything is as after switching on.
  void brown_out();

  /// What the firmware sent, when the byte was whole.
  std::function<void(std::uint8_t byte, double us)> on_byte;
  /// A servo's pulse has ended. @param length_us  of it.
  std::function<void(int leg, double begun_us, double length_us)> on_pulse;
  [[nodiscard]] bool is_supply_on() const;

  /// One instruction at a time from now on, and the share of time counted from now on: exact, but
  /// slower. Else up to 64 cycles count as what the first of them was.
  void count_every_cycle();
  [[nodiscard]] double share_of_time_used() const;
  [[nodiscard]] double longest_without_interrupts_us() const;
  /// Bytes of the program [share of 32 KiB], and of its data [share of 2 KiB] with the deepest
  /// stack seen.
  [[nodiscard]] double share_of_flash() const;
  [[nodiscard]] double share_of_ram() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace carpus::firmware
