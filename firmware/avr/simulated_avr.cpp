// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "firmware/avr/simulated_avr.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "core/error.hpp"

extern "C" {
#include <simavr/avr_adc.h>
#include <simavr/avr_ioport.h>
#include <simavr/avr_uart.h>
#include <simavr/sim_avr.h>
#include <simavr/sim_elf.h>
}

namespace carpus::firmware {

namespace {
constexpr double kCyclesPerUs = 16.0;
constexpr double kSettingUpUs = 20'000.0;
constexpr double kFlashBytes = 32768;
constexpr double kRamBytes = 2048;
constexpr int kInterruptFlag = 7;
constexpr int kSleepInstruction = 0x9588;

/// simavr tells on stdout, which is for data, what it loads.
class QuietStdout {
 public:
  QuietStdout() {
    std::fflush(stdout);
    saved_ = ::dup(STDOUT_FILENO);
    const int nothing = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nothing >= 0) {
      ::dup2(nothing, STDOUT_FILENO);
      ::close(nothing);
    }
  }
  QuietStdout(const QuietStdout&) = delete;
  QuietStdout& operator=(const QuietStdout&) = delete;
  ~QuietStdout() {
    std::fflush(stdout);
    if (saved_ < 0) return;
    ::dup2(saved_, STDOUT_FILENO);
    ::close(saved_);
  }

 private:
  int saved_ = -1;
};
}  // namespace

struct SimulatedAvr::State {
  avr_t* avr = nullptr;
  SimulatedAvr* owner = nullptr;
  std::array<avr_irq_t*, kRollInput + 1> wipers{};
  avr_irq_t* line = nullptr;
  struct Pin {
    State* state = nullptr;
    int number = 0;
    double begun_us = 0;
    bool is_high = false;
  };
  std::array<Pin, kLegs + 1> pins{};
  std::uint64_t used_cycles = 0;
  std::uint64_t counted_cycles = 0;
  std::uint64_t closed_since = 0;
  std::uint64_t longest_closed = 0;
  bool is_closed = false;
  double program_bytes = 0;
  double data_bytes = 0;
  int lowest_stack = 0;

  [[nodiscard]] double us() const { return static_cast<double>(avr->cycle) / kCyclesPerUs; }
};

SimulatedAvr::SimulatedAvr(const std::string& elf_file) : state_(std::make_unique<State>()) {
  const QuietStdout quiet;
  elf_firmware_t program{};
  if (elf_read_firmware(elf_file.c_str(), &program) != 0) {
    throw Error(elf_file + ": is no program for the ATmega328P");
  }
  std::strcpy(program.mmcu, "atmega328p");
  program.frequency = static_cast<std::uint32_t>(kHz);
  avr_t* avr = avr_make_mcu_by_name(program.mmcu);
  if (avr == nullptr) throw Error("simavr knows no ATmega328P");
  avr_init(avr);
  avr->log = LOG_ERROR;
  avr_load_firmware(avr, &program);
  avr->vcc = avr->avcc = avr->aref = 5000;
  avr->run_cycle_limit = 64;                      // at most so many at a time
  avr->sleep = [](avr_t*, avr_cycle_count_t) {};  // time is the caller's
  State& s = *state_;
  s.avr = avr;
  s.owner = this;
  s.program_bytes = static_cast<double>(program.flashsize);
  s.data_bytes = static_cast<double>(program.datasize + program.bsssize);
  s.lowest_stack = avr->ramend;

  std::uint32_t flags = 0;
  avr_ioctl(avr, AVR_IOCTL_UART_GET_FLAGS('0'), &flags);
  flags &= ~static_cast<std::uint32_t>(AVR_UART_FLAG_STDIO | AVR_UART_FLAG_POLL_SLEEP);
  avr_ioctl(avr, AVR_IOCTL_UART_SET_FLAGS('0'), &flags);
  s.line = avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_INPUT);
  avr_irq_register_notify(
      avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_OUTPUT),
      [](avr_irq_t*, std::uint32_t value, void* param) {
        const auto* state = static_cast<State*>(param);
        // simavr tells of a byte when it begins; it is whole ten bits later.
        constexpr double kByteUs = 20.0;
        if (state->owner->on_byte) {
          state->owner->on_byte(static_cast<std::uint8_t>(value), state->us() + kByteUs);
        }
      },
      &s);
  for (int i = 0; i <= kLegs; ++i) {
    s.wipers[static_cast<std::size_t>(i)] =
        avr_io_getirq(avr, AVR_IOCTL_ADC_GETIRQ, ADC_IRQ_ADC0 + i);
    s.pins[static_cast<std::size_t>(i)].state = &s;
    s.pins[static_cast<std::size_t>(i)].number = i;
    avr_irq_register_notify(
        avr_io_getirq(avr, AVR_IOCTL_IOPORT_GETIRQ('B'), IOPORT_IRQ_PIN0 + i),
        [](avr_irq_t*, std::uint32_t value, void* param) {
          auto* pin = static_cast<State::Pin*>(param);
          const bool is_high = value != 0;
          if (is_high == pin->is_high) return;
          pin->is_high = is_high;
          const double us = pin->state->us();
          if (is_high) {
            pin->begun_us = us;
          } else if (pin->number < kLegs && pin->state->owner->on_pulse) {
            pin->state->owner->on_pulse(pin->number, pin->begun_us, us - pin->begun_us);
          }
        },
        &s.pins[static_cast<std::size_t>(i)]);
  }
  for (int leg = 0; leg < kLegs; ++leg) set_wiper_mv(leg, 2500);
  set_wiper_mv(kRollInput, 0);
}

SimulatedAvr::~SimulatedAvr() {
  if (state_->avr != nullptr) avr_terminate(state_->avr);
}

void SimulatedAvr::count_every_cycle() {
  state_->avr->run_cycle_limit = 1;
  state_->used_cycles = 0;
  state_->counted_cycles = 0;
}

void SimulatedAvr::run_to(double us) {
  State& s = *state_;
  const auto goal = static_cast<std::uint64_t>(us * kCyclesPerUs);
  while (s.avr->cycle < goal) {
    const std::uint64_t before = s.avr->cycle;
    const unsigned pc = s.avr->pc;
    const bool is_asleep = s.avr->state == cpu_Sleeping ||
                           (s.avr->flash[pc] | s.avr->flash[pc + 1] << 8) == kSleepInstruction;
    const int state = avr_run(s.avr);
    if (state == cpu_Crashed || state == cpu_Done) throw Error("the firmware has crashed");
    if (s.us() > kSettingUpUs) {
      s.counted_cycles += s.avr->cycle - before;
      if (!is_asleep) s.used_cycles += s.avr->cycle - before;
      const bool is_closed = s.avr->sreg[kInterruptFlag] == 0;
      if (is_closed && !s.is_closed) s.closed_since = before;
      if (!is_closed && s.is_closed) {
        s.longest_closed = std::max(s.longest_closed, s.avr->cycle - s.closed_since);
      }
      s.is_closed = is_closed;
      const int stack = s.avr->data[R_SPL] | s.avr->data[R_SPH] << 8;
      s.lowest_stack = std::min(s.lowest_stack, stack);
    }
  }
}

double SimulatedAvr::now_us() const { return state_->us(); }

void SimulatedAvr::set_wiper_mv(int leg, double mv) {
  // The chip divides its reference by 1024, simavr by 1023, and knows whole millivolts only: given
  // the voltage itself it converts up to a count too low, a third of a degree of a leg. So it is
  // given that of the count that the chip would come to.
  constexpr double kReferenceMv = 5000;
  const double count = std::clamp(std::floor(mv / kReferenceMv * 1024.0), 0.0, 1023.0);
  const double whole = std::ceil(count * kReferenceMv / 1023.0);
  avr_raise_irq(state_->wipers[static_cast<std::size_t>(leg)], static_cast<std::uint32_t>(whole));
}

void SimulatedAvr::receive(std::uint8_t byte) { avr_raise_irq(state_->line, byte); }

void SimulatedAvr::brown_out() { avr_reset(state_->avr); }

bool SimulatedAvr::is_supply_on() const { return state_->pins[kLegs].is_high; }

double SimulatedAvr::share_of_time_used() const {
  return static_cast<double>(state_->used_cycles) /
         std::max<double>(1.0, static_cast<double>(state_->counted_cycles));
}

double SimulatedAvr::longest_without_interrupts_us() const {
  return static_cast<double>(state_->longest_closed) / kCyclesPerUs;
}

double SimulatedAvr::share_of_flash() const { return state_->program_bytes / kFlashBytes; }

double SimulatedAvr::share_of_ram() const {
  return (state_->data_bytes + state_->avr->ramend - state_->lowest_stack) / kRamBytes;
}

}  // namespace carpus::firmware
