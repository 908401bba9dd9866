// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The smallest plug-in: a device that stands where it is pushed to. Tried by plugin_device_test,
// and a beginning for whoever writes one (docs/devices.md).
#include <stdlib.h>

#include "../plugin_abi.h"

typedef struct {
  uint64_t samples;
  double force[3];
  double limit;
} example;

static void* example_open(char* problem, size_t problem_bytes) {
  if (getenv("CARPUS_EXAMPLE_UNPLUGGED") != NULL) {
    const char* why = "not plugged in; plug it in";
    size_t i = 0;
    for (; why[i] != 0 && i + 1 < problem_bytes; ++i) problem[i] = why[i];
    problem[i] = 0;
    return NULL;
  }
  return calloc(1, sizeof(example));
}

static void example_close(void* device) { free(device); }

static void example_capabilities(void* device, carpus_device_capabilities* out) {
  (void)device;
  out->can = CARPUS_CAN_POSITION | CARPUS_CAN_ABSOLUTE | CARPUS_CAN_FORCE;
  out->rate_hz = 1000;
  out->peak_force_n = 3.3;
  out->lasting_force_n = 0.9;
  out->most_stiffness_n_per_mm = 0.5;
  for (int i = 0; i < 3; ++i) {
    out->workspace_low_mm[i] = -60;
    out->workspace_high_mm[i] = 60;
  }
}

static void example_poll(void* device, int64_t now_ns, carpus_device_state* out) {
  example* self = device;
  (void)now_ns;
  out->health = CARPUS_HEALTH_GOOD;
  out->samples = ++self->samples;
  for (int i = 0; i < 3; ++i) {
    out->position_mm[i] = self->force[i];
    out->force_n[i] = self->force[i];
  }
  /* For the test: what a broken library would say. */
  if (self->limit == 1.25) out->position_mm[1] = 0.0 / (self->limit - 1.25);
}

static void example_command(void* device, int64_t now_ns, const carpus_device_command* command) {
  example* self = device;
  (void)now_ns;
  for (int i = 0; i < 3; ++i) self->force[i] = command->force_n[i];
  self->limit = command->limit_n;
}

const carpus_device_plugin_table* carpus_device_plugin(void);
const carpus_device_plugin_table* carpus_device_plugin(void) {
  static const carpus_device_plugin_table table = {
      CARPUS_DEVICE_ABI,    "Example",    example_open,   example_close,
      example_capabilities, example_poll, example_command};
  return &table;
}
