// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The board of drive A as the plant meets it: wipers' voltages in, pulses out, bytes both ways, on
// a clock that the caller moves. Two stand behind it: the core compiled for the host, here, and the
// flashed program in simavr, which only tests and the bench link.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>

#include "firmware/core/stop_arm.hpp"

namespace carpus::virtual_arm {

/// A byte of the line at 500 kbaud [us].
inline constexpr double kByteUs = 10e6 / firmware::kBaud;

class StopBoard {
 public:
  StopBoard() = default;
  StopBoard(const StopBoard&) = delete;
  StopBoard& operator=(const StopBoard&) = delete;
  virtual ~StopBoard() = default;

  virtual void run_to_us(double us) = 0;
  /// A byte begins on the line now.
  virtual void receive(std::uint8_t byte) = 0;
  /// @param share  of the supply, at the wiper.
  virtual void set_wiper(int leg, double share) = 0;
  /// @param share  of a turn, of the tool in its gimbal.
  virtual void set_roll(double share) = 0;
  virtual void brown_out() = 0;
  [[nodiscard]] virtual bool is_supply_on() const = 0;

  /// What the board sent, when the byte was whole.
  std::function<void(std::uint8_t byte, double us)> on_byte;
  /// A servo's pulse has ended.
  std::function<void(int leg, double begun_us, double length_us)> on_pulse;
};

/// The firmware's core with a board's schedule (firmware/avr/main.cpp): a conversion each 96 us,
/// pulses in slots of a third of 20 ms.
class CoreStopBoard final : public StopBoard {
 public:
  explicit CoreStopBoard(std::uint32_t unit);
  void run_to_us(double us) override;
  void receive(std::uint8_t byte) override;
  void set_wiper(int leg, double share) override;
  void set_roll(double share) override { roll_ = share; }
  void brown_out() override;
  [[nodiscard]] bool is_supply_on() const override;

 private:
  void convert();
  void do_slot();
  void answer();

  struct Coming {
    std::uint8_t byte = 0;
    double us = 0;
  };
  std::uint32_t unit_;
  firmware::StopArm arm_;
  double now_us_ = 0;
  double next_conversion_us_ = 0;
  double next_slot_us_ = 10'000;
  double pulse_end_us_ = 0;
  double pulse_begun_us_ = 0;
  double line_free_us_ = 0;
  double wipers_[3] = {0.5, 0.5, 0.5};
  double roll_ = 0;
  std::deque<Coming> coming_;
  std::deque<Coming> going_;
  int leg_ = 0;
  int conversions_ = 0;
  int slot_leg_ = 0;
  int pulsing_leg_ = -1;
  std::uint16_t sum_ = 0;
};

}  // namespace carpus::virtual_arm
