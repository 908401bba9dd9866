// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is drawn asks for a new picture when it changes, what is only told in numbers does not.
import { describe, expect, it } from "vitest";
import type { HandState, Item, SnapshotMessage } from "../protocol";
import { looksDifferent } from "./snapshot_look_model";

const HAND: HandState = {
  item: 0,
  touching: true,
  touched_body: "scaphoid_proximal",
  contact_depth_mm: 0.1,
  contact_normal: [0, 0, 1],
  force_n: [0, 0, 2],
  resistance_n: 2,
  thrust_n: 20,
  torque_n_mm: 0,
};
const ITEM: Item = {
  item: 0,
  instrument: "wire",
  hand: 0,
  body: "",
  wire: -1,
  tip_mm: [10, 20, 30],
  shaft: [0, 0, 1],
  in_target: false,
  tip_body: "",
  tip_hu: 0,
  entry_mm: null,
  depth_mm: 0,
  buried_mm: 0,
  by_far_end: false,
  length_mm: 150,
  bent_at_mm: 150,
  outer_shaft: [0, 0, 1],
};
const AT_REST: SnapshotMessage = {
  type: "snapshot",
  tick: 1000,
  state_hash: "00000000000000aa",
  paused: false,
  finished: false,
  step: 3,
  completed_steps: [0, 1, 2],
  hands: [HAND, { ...HAND, item: -1, touching: false, force_n: [0, 0, 0] }],
  items: [ITEM],
  wrist: { flexion_deg: 0, radial_deviation_deg: 0, pronation_deg: 0, traction_n: 0 },
  bodies: null,
  tissue_revision: 0,
  gauge_reading_mm: null,
  holding_share: 0,
  passes: 1,
  judged_displaced: null,
  c_arm: { rotation_deg: 0, tilt_deg: 0, live: false, tube_kv: 60, dose_level: "usual" },
  shots: 3,
  dose_cgy_cm2: 0.1,
  undos: 0,
  tick_rate_hz: 1000,
  tick_p99_us: 20,
  late_ticks: 0,
};

function withHand(more: Partial<HandState>): Partial<SnapshotMessage> {
  return { hands: [{ ...HAND, ...more }, AT_REST.hands[1]] };
}
function withItem(more: Partial<Item>): Partial<SnapshotMessage> {
  return { items: [{ ...ITEM, ...more }] };
}

const SEEN: [string, Partial<SnapshotMessage>][] = [
  ["another instrument", withItem({ instrument: "screw" })],
  ["an instrument that is let go", withItem({ hand: -1 })],
  ["an instrument more", { items: [ITEM, { ...ITEM, item: 1 }] }],
  ["an instrument less", { items: [] }],
  ["the tip's move", withItem({ tip_mm: [10, 20.01, 30] })],
  ["the shaft's turn", withItem({ shaft: [0.001, 0, 1] })],
  ["the end of touching", withHand({ touching: false })],
  ["another force", withHand({ force_n: [0, 0, 2.1] })],
  ["another side that is touched", withHand({ contact_normal: [0, 0.01, 1] })],
];

const UNSEEN: [string, Partial<SnapshotMessage>][] = [
  ["time", { tick: 1016, state_hash: "00000000000000bb" }],
  ["resistance", withHand({ resistance_n: 4 })],
  ["a move that is less than is seen", withItem({ tip_mm: [10, 20.0005, 30] })],
  ["depth in figures", withItem({ depth_mm: 3, tip_hu: 900 })],
  ["counts", { shots: 4, passes: 2, undos: 1, gauge_reading_mm: 22 }],
];

describe("looksDifferent", () => {
  it.each(SEEN)("sees %s", (_, more) => {
    expect(looksDifferent(AT_REST, { ...AT_REST, ...more })).toBe(true);
  });

  it.each(UNSEEN)("does not see %s", (_, more) => {
    expect(looksDifferent(AT_REST, { ...AT_REST, ...more })).toBe(false);
  });

  it("does not see the force of a hand that does not touch", () => {
    const free: HandState = { ...HAND, touching: false };
    const before: SnapshotMessage = { ...AT_REST, hands: [free, free] };
    const after: SnapshotMessage = { ...before, hands: [{ ...free, force_n: [1, 0, 0] }, free] };
    expect(looksDifferent(before, after)).toBe(false);
  });
});
