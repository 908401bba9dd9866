// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Runs the core's script on a Cortex-M4F and prints its digest by semihosting: the host's must be
// the same, bit for bit.
#include "firmware/core/core_script.hpp"

extern "C" {

extern uint32_t carpus_stack_top;
void reset();

__attribute__((section(".vectors"), used))
const void* const carpus_vectors[] = {&carpus_stack_top, reinterpret_cast<const void*>(&reset)};

// What the compiler asks for where there is no C library.
void* memcpy(void* to, const void* from, size_t size) {
  for (size_t i = 0; i < size; ++i) {
    static_cast<volatile uint8_t*>(to)[i] = static_cast<const uint8_t*>(from)[i];
  }
  return to;
}
void* memset(void* to, int value, size_t size) {
  for (size_t i = 0; i < size; ++i)
    static_cast<volatile uint8_t*>(to)[i] = static_cast<uint8_t>(value);
  return to;
}

static uint32_t ask_host(uint32_t what, const void* with) {
  register uint32_t r0 asm("r0") = what;
  register const void* r1 asm("r1") = with;
  asm volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
  return r0;
}

void reset() {
  // The floating-point unit is off after a reset.
  *reinterpret_cast<volatile uint32_t*>(0xE000ED88) |= 0xFU << 20;
  asm volatile("dsb\nisb");
  const uint32_t digest = carpus::firmware::digest_of_core_script();
  char text[10];
  for (int i = 0; i < 8; ++i) text[i] = "0123456789abcdef"[digest >> (28 - 4 * i) & 0xF];
  text[8] = '\n';
  text[9] = 0;
  constexpr uint32_t kWriteText = 0x04;
  constexpr uint32_t kExit = 0x18;
  constexpr uint32_t kEndedWell = 0x20026;
  ask_host(kWriteText, text);
  ask_host(kExit, reinterpret_cast<const void*>(kEndedWell));
  for (;;) {
  }
}

}  // extern "C"
