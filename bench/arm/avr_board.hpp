// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Drive A's board as the flashed program in simavr, cycle by cycle, for the virtual arm.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "firmware/avr/simulated_avr.hpp"
#include "virtual_arm/stop_board.hpp"

namespace carpus::bench {

class AvrBoard final : public virtual_arm::StopBoard {
 public:
  explicit AvrBoard(const std::string& elf_file) : avr_(elf_file) {
    avr_.on_byte = [this](std::uint8_t byte, double us) {
      if (on_byte) on_byte(byte, us);
    };
    avr_.on_pulse = [this](int leg, double begun_us, double length_us) {
      if (on_pulse) on_pulse(leg, begun_us, length_us);
    };
  }
  void run_to_us(double us) override { avr_.run_to(us); }
  void receive(std::uint8_t byte) override { avr_.receive(byte); }
  void set_wiper(int leg, double share) override {
    const double mv = 5000 * share;
    double& last = last_mv_[static_cast<std::size_t>(leg)];
    if (mv == last) return;
    last = mv;
    avr_.set_wiper_mv(leg, mv);
  }
  void set_roll(double share) override { set_wiper(firmware::SimulatedAvr::kRollInput, share); }
  void brown_out() override { avr_.brown_out(); }
  [[nodiscard]] bool is_supply_on() const override { return avr_.is_supply_on(); }

 private:
  firmware::SimulatedAvr avr_;
  std::array<double, 4> last_mv_{-1, -1, -1, -1};
};

}  // namespace carpus::bench
