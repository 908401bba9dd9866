// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The boundary behind which a device lives whose maker's library is not free: one shared library
// that exports carpus_device_plugin(). C, plain data, no allocation crosses it; a library built
// against another version of this file is refused. How to write one: docs/devices.md.
//
// poll and command are called once a millisecond from one real-time thread: they must not wait,
// allocate or throw. Positions are mm about the middle of the workspace, x right, y away from
// whoever sits there, z up. What is not finite or cannot be is refused on the other side.
#pragma once

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define CARPUS_DEVICE_ABI 2

enum {
  CARPUS_CAN_POSITION = 1,
  CARPUS_CAN_ROTATION = 2,
  CARPUS_CAN_ABSOLUTE = 4,
  CARPUS_CAN_FORCE = 8,
  CARPUS_CAN_STOP = 16,
  CARPUS_CAN_LOCAL_PLANE = 32,
  CARPUS_CAN_VIBRATION = 64,
  CARPUS_CAN_TORQUE = 128 /* about the handle's shaft */
};

enum {
  CARPUS_HEALTH_GOOD = 0,
  CARPUS_HEALTH_STARTING = 1,
  CARPUS_HEALTH_UNCALIBRATED = 2,
  CARPUS_HEALTH_HOLDING_BACK = 3,
  CARPUS_HEALTH_SILENT = 4,
  CARPUS_HEALTH_FAULTY = 5,
  CARPUS_HEALTH_GONE = 6
};

typedef struct {
  uint32_t can; /* of CARPUS_CAN_ */
  double rate_hz;
  double peak_force_n;
  double lasting_force_n;
  double most_stiffness_n_per_mm;
  double workspace_low_mm[3];
  double workspace_high_mm[3];
} carpus_device_capabilities;

typedef struct {
  uint32_t health;  /* of CARPUS_HEALTH_ */
  uint64_t samples; /* so often it has said where it is */
  double position_mm[3];
  double rotation[9]; /* rows; device from handle, whose shaft is the third column */
  double velocity_mm_s[3];
  double spin_rad_s[3];
  uint32_t buttons;
  double force_n[3]; /* that it gives */
} carpus_device_state;

typedef struct {
  double normal[3];
  double offset_mm;
  double stiffness_n_per_mm;
  double damping_n_s_per_mm;
  double friction;
} carpus_device_plane;

typedef struct {
  double force_n[3]; /* planes included, for devices without CARPUS_CAN_LOCAL_PLANE */
  uint32_t plane_count;
  carpus_device_plane planes[2];
  double limit_n;
  double vibration_n;
  double vibration_hz;
  double torque_n_mm; /* against the hand that turns the handle's shaft */
} carpus_device_command;

typedef struct {
  uint32_t abi; /* CARPUS_DEVICE_ABI */
  const char* name;
  /* NULL where it fails; then problem says why, ended by 0. */
  void* (*open)(char* problem, size_t problem_bytes);
  void (*close)(void* device);
  void (*capabilities)(void* device, carpus_device_capabilities* out);
  void (*poll)(void* device, int64_t now_ns, carpus_device_state* out);
  void (*command)(void* device, int64_t now_ns, const carpus_device_command* command);
} carpus_device_plugin_table;

/* What a plug-in exports; the table stays where it is. */
typedef const carpus_device_plugin_table* (*carpus_device_plugin_function)(void);
#define CARPUS_DEVICE_PLUGIN_FUNCTION "carpus_device_plugin"

#ifdef __cplusplus
}
#endif
