// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is drawn asks for a new picture when it changes, what is only told in numbers does not.
import { describe, expect, it } from "vitest";
import type { SnapshotMessage } from "../protocol";
import { looksDifferent } from "./snapshot_look_model";

const AT_REST: SnapshotMessage = {
  type: "snapshot",
  tick: 1000,
  state_hash: "00000000000000aa",
  paused: false,
  finished: false,
  step: "drive",
  completed_steps: 3,
  instrument: "guide_wire",
  tip_mm: [10, 20, 30],
  shaft: [0, 0, 1],
  touching: true,
  touched_bone: "scaphoid_proximal",
  contact_depth_mm: 0.1,
  contact_normal: [0, 0, 1],
  force_n: [0, 0, 2],
  resistance_n: 2,
  wire_engaged: true,
  wire_entry_mm: [10, 20, 30],
  wire_tip_mm: [10, 20, 22],
  wire_direction: [0, 0, -1],
  wire_depth_mm: 8,
  wire_passes: 1,
  wire_tip_hu: 700,
  wire_tip_bone: "scaphoid_proximal",
  screw_index: 2,
  screw_length_mm: 20,
  screw_advance_mm: 4,
  screw_buried_mm: -16,
  measured_mm: 22,
  shots: 3,
  dose_cgy_cm2: 0.1,
  undos: 0,
  tick_rate_hz: 1000,
  tick_p99_us: 20,
  late_ticks: 0,
};

const SEEN: [string, Partial<SnapshotMessage>][] = [
  ["another instrument", { instrument: "screw_driver" }],
  ["the tip's move", { tip_mm: [10, 20.01, 30] }],
  ["the shaft's turn", { shaft: [0.001, 0, 1] }],
  ["a touch that ends", { touching: false }],
  ["a stronger push", { force_n: [0, 0, 2.5] }],
  ["another side of the bone", { contact_normal: [0, 1, 0] }],
  ["the wire pulled out", { wire_engaged: false }],
  ["the wire driven on", { wire_tip_mm: [10, 20, 21.9] }],
  ["the screw turned in", { screw_advance_mm: 4.1 }],
  ["another screw", { screw_index: 3, screw_length_mm: 22 }],
  ["a longer screw", { screw_length_mm: 22 }],
];

const UNSEEN: [string, Partial<SnapshotMessage>][] = [
  ["time", { tick: 2000, state_hash: "00000000000000ab" }],
  ["readings", { resistance_n: 3, measured_mm: 23, shots: 4, dose_cgy_cm2: 0.2 }],
  ["rounding", { tip_mm: [10, 20.0001, 30], force_n: [0, 0, 2.001] }],
];

describe("looksDifferent", () => {
  it.each(SEEN)("sees %s", (_name, change) => {
    expect(looksDifferent(AT_REST, { ...AT_REST, ...change })).toBe(true);
  });
  it.each(UNSEEN)("does not draw for %s", (_name, change) => {
    expect(looksDifferent(AT_REST, { ...AT_REST, ...change })).toBe(false);
  });
  it("does not look at the force of a touch that is none", () => {
    const lifted = { ...AT_REST, touching: false };
    expect(looksDifferent(lifted, { ...lifted, force_n: [0, 0, 9] })).toBe(false);
  });
});
