// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Drive A on an ATmega328P at 16 MHz (Arduino Nano or Uno), for the arm of hardware revision 1.
//
//   ADC0..2  potentiometers, supplied from AREF      PB0..2  servos' signals
//   ADC3     the tool's roll                         PB3     servos' supply: high while driving
//   RXD/TXD  500 kbaud to the host
//
// Timer 1 counts half microseconds: it is the clock, and makes the pulses, three a frame of 20 ms,
// one after the other. It has two compare outputs for three servos, so edges are made by hand: the
// interrupt comes 30 us early, later than which no other interrupt can hold it up, and waits for
// the edge with the others shut out. That is longer than a byte takes at 1 Mbaud but shorter than
// the two that the USART keeps at 500 kbaud.
#include <avr/eeprom.h>
#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/sleep.h>
#include <avr/wdt.h>

#include "firmware/core/stop_arm.hpp"

namespace {

using carpus::firmware::StopArm;

constexpr uint8_t kLegs = StopArm::kLegs;
constexpr uint8_t kSupplyPin = 3;
/// In GPIOR0, where a bit is set in one instruction: an interrupt left something to do. Most leave
/// nothing, and the loop sleeps on.
constexpr uint8_t kNews = 1;
constexpr uint16_t kSlotHalfUs = 13333;  // three a frame of 20 ms
constexpr uint16_t kEarlyHalfUs = 44;
constexpr uint8_t kConversions = 4;
constexpr uint8_t kRollInput = kLegs;
constexpr uint8_t kConversionUs = 96;
/// A leg's law, and its sample, wait for a frame that so few bytes end, or its answer would wait
/// for them. Where two of them are due they do not: no line, however bad, holds them up for longer
/// than from one leg's sample to the next's.
constexpr uint8_t kBytesALawTakes = 9;
constexpr uint8_t kBytesASampleTakes = 4;
static_assert(carpus::firmware::kSamplePeriodUs == kConversionUs * (kLegs * kConversions + 1),
              "a round of the legs, and one conversion of the roll");

/// Bytes between an interrupt and the loop.
template <uint8_t kSize>
class Ring {
 public:
  bool push(uint8_t byte) volatile {
    const uint8_t next = static_cast<uint8_t>((head_ + 1) % kSize);
    if (next == tail_) return false;
    bytes_[head_] = byte;
    head_ = next;
    return true;
  }
  bool pop(uint8_t& byte) volatile {
    if (head_ == tail_) return false;
    byte = bytes_[tail_];
    tail_ = static_cast<uint8_t>((tail_ + 1) % kSize);
    return true;
  }

 private:
  uint8_t bytes_[kSize];
  uint8_t head_ = 0;
  uint8_t tail_ = 0;
};

volatile Ring<64> received;
uint8_t sending[carpus::firmware::kMaxDeviceFrameBytes];
volatile uint8_t send_length = 0;
volatile uint8_t send_at = 0;
volatile uint16_t overflows = 0;
volatile uint16_t pulses[kLegs] = {0, 0, 0};
volatile uint16_t sums[kLegs];
volatile uint16_t roll = 0;  ///< 10 bits of a turn
volatile uint8_t fresh = 0;  ///< a bit a leg: sums holds a new sample
volatile uint8_t begun = 0;  ///< a bit a leg: its pulse has begun

/// Whether what waits, a bit a leg, is due while so many bytes of a frame are missing.
bool is_due(uint8_t waiting, uint8_t missing, uint8_t takes) {
  return waiting != 0 && (missing > takes || (waiting & (waiting - 1)) != 0);
}

struct StartSending {
  void operator()(uint8_t length) const {
    asm volatile("" ::: "memory");  // what is to be sent stands in memory
    send_at = 0;
    send_length = length;
    UCSR0B |= _BV(UDRIE0);
  }
};

uint32_t now_us() {
  cli();
  const uint16_t count = TCNT1;
  uint16_t high = overflows;
  if ((TIFR1 & _BV(TOV1)) != 0 && count < 0x8000) ++high;
  sei();
  return (static_cast<uint32_t>(high) << 16 | count) >> 1;
}

/// As now_us, but whole 32 bits of microseconds: half microseconds lose the highest.
uint32_t clock_us() {
  static uint32_t last = 0;
  const uint32_t now = now_us();
  last += (now - last) & 0x7FFFFFFF;
  return last;
}

void set_up() {
  wdt_enable(WDTO_15MS);
  DDRB = 0x0F;
  PORTB = 0;
  // U2X0 first: simavr computes the rate when UBRR0 is written.
  UCSR0A = _BV(U2X0);
  UBRR0 = 3;
  UCSR0C = _BV(UCSZ01) | _BV(UCSZ00);
  UCSR0B = _BV(RXEN0) | _BV(TXEN0) | _BV(RXCIE0);
  TCCR1A = 0;
  TCCR1B = _BV(CS11);
  OCR1A = 20000;
  TIMSK1 = _BV(OCIE1A) | _BV(TOIE1);
  // Timer 0 starts a conversion every 96 us; each takes 26.
  ADMUX = _BV(REFS0);
  ADCSRA = _BV(ADEN) | _BV(ADPS2) | _BV(ADPS0);
  DIDR0 = 0x0F;
  TCCR0A = _BV(WGM01);
  TCCR0B = _BV(CS01);
  OCR0A = 2 * kConversionUs - 1;
  TIMSK0 = _BV(OCIE0A);
  set_sleep_mode(SLEEP_MODE_IDLE);
  sei();
}

}  // namespace

ISR(USART_RX_vect) {
  const uint8_t byte = UDR0;
  received.push(byte);  // what does not fit is a corrupt frame
  GPIOR0 |= kNews;
}

ISR(USART_UDRE_vect) {
  if (send_at < send_length) {
    UDR0 = sending[send_at];
    send_at = static_cast<uint8_t>(send_at + 1);
  } else {
    UCSR0B &= static_cast<uint8_t>(~_BV(UDRIE0));
    send_length = 0;
    GPIOR0 |= kNews;
  }
}

ISR(TIMER1_OVF_vect) { overflows = static_cast<uint16_t>(overflows + 1); }

ISR(TIMER0_COMPA_vect) {
  static uint8_t leg = 0;
  static uint8_t count = 0;
  static uint16_t sum = 0;
  static uint8_t first = 1;
  const uint16_t value = ADC;
  if (first != 0) {  // nothing has been converted yet
    first = 0;
    ADCSRA |= _BV(ADSC);
    return;
  }
  if (leg == kRollInput) {
    roll = value;
    leg = 0;
    ADMUX = _BV(REFS0);
    ADCSRA |= _BV(ADSC);
    return;
  }
  sum = static_cast<uint16_t>(sum + value);
  if (++count == kConversions) {
    sums[leg] = sum;
    fresh = static_cast<uint8_t>(fresh | (1 << leg));
    GPIOR0 |= kNews;
    sum = 0;
    count = 0;
    ++leg;  // behind the last of them the roll
    ADMUX = static_cast<uint8_t>(_BV(REFS0) | leg);
  }
  ADCSRA |= _BV(ADSC);
}

ISR(TIMER1_COMPA_vect) {
  static uint8_t leg = 0;
  static bool is_high = false;
  static uint16_t slot = 20000 + kEarlyHalfUs;  // where the leg's slot begins
  static uint16_t edge = 20000 + kEarlyHalfUs;  // the next one
  if (!is_high) {
    const uint16_t pulse = pulses[leg];
    if (pulse != 0) {
      const uint8_t pins = static_cast<uint8_t>(PORTB | (1 << leg));
      while (static_cast<int16_t>(TCNT1 - edge) < 0) {
      }
      PORTB = pins;
      begun = static_cast<uint8_t>(begun | (1 << leg));
      GPIOR0 |= kNews;
      is_high = true;
      edge = static_cast<uint16_t>(edge + pulse);
      OCR1A = static_cast<uint16_t>(edge - kEarlyHalfUs);
      return;
    }
  } else {
    const uint8_t pins = static_cast<uint8_t>(PORTB & ~(1 << leg));
    while (static_cast<int16_t>(TCNT1 - edge) < 0) {
    }
    PORTB = pins;
    is_high = false;
  }
  leg = leg == kLegs - 1 ? uint8_t{0} : static_cast<uint8_t>(leg + 1);
  slot = static_cast<uint16_t>(slot + kSlotHalfUs);
  edge = slot;
  OCR1A = static_cast<uint16_t>(edge - kEarlyHalfUs);
}

int main() {
  static StopArm arm(eeprom_read_dword(nullptr));
  set_up();
  uint32_t now = 0;     ///< when the last frame or sample came
  uint8_t to_step = 0;  ///< a bit a leg: it has a new sample; between, an answer can be sent
  for (;;) {
    wdt_reset();
    GPIOR0 &= static_cast<uint8_t>(~kNews);
    uint8_t byte = 0;
    if (received.pop(byte)) {
      if (arm.push(byte)) arm.act(now = clock_us());
    } else if (begun != 0) {
      cli();
      const uint8_t legs = begun;
      begun = 0;
      sei();
      for (uint8_t leg = 0; leg < kLegs; ++leg) {
        if ((legs & (1 << leg)) != 0) arm.sent(leg);
      }
    } else if (is_due(fresh, arm.bytes_missing(), kBytesASampleTakes)) {
      uint8_t leg = 0;
      while ((fresh & (1 << leg)) == 0) ++leg;
      cli();
      const uint16_t sum = sums[leg];
      const uint16_t turned = roll;
      fresh = static_cast<uint8_t>(fresh & ~(1 << leg));
      sei();
      arm.sample(leg, sum, now = clock_us());
      arm.sample_roll(static_cast<uint16_t>(turned << 2));
      to_step = static_cast<uint8_t>(to_step | (1 << leg));
    } else if (is_due(to_step, arm.bytes_missing(), kBytesALawTakes)) {
      uint8_t leg = 0;
      while ((to_step & (1 << leg)) == 0) ++leg;
      to_step = static_cast<uint8_t>(to_step & ~(1 << leg));
      arm.step(leg, clock_us());
      uint8_t supply = 0;
      for (uint8_t i = 0; i < kLegs; ++i) {
        const uint16_t pulse = arm.pulse_half_us(i);
        cli();
        pulses[i] = pulse;
        sei();
        if (pulse != 0) supply = 1;
      }
      cli();
      PORTB =
          static_cast<uint8_t>(supply != 0 ? PORTB | _BV(kSupplyPin) : PORTB & ~_BV(kSupplyPin));
      sei();
    } else {
      cli();
      while ((GPIOR0 & kNews) == 0) {
        sleep_enable();
        sei();
        sleep_cpu();
        sleep_disable();
        cli();
      }
      sei();
    }
    if (arm.has_reply() && send_length == 0) {
      // The checksum is there long before its turn comes.
      arm.reply(sending, now, StartSending());
    }
  }
}
