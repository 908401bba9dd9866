// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import type { HostMessage, SnapshotMessage } from "../protocol";
import { ReplayBuffer, statesOf, type Stretch } from "./replay_buffer_model";

const snapshot = (tick: number, bodies: SnapshotMessage["bodies"] = null): HostMessage =>
  ({ type: "snapshot", tick, bodies }) as HostMessage;
const tissue = (count: number): HostMessage => ({
  type: "tissue",
  revision: count,
  tracks: Array.from({ length: count }, () => ({
    body: "scaphoid",
    from_mm: [0, 0, 0] as const,
    to_mm: [0, 0, 0] as const,
    from_radius_mm: 1,
    to_radius_mm: 1,
  })),
});
const pose = [{ quaternion: [1, 0, 0, 0], translation_mm: [0, 0, 0] as const }] as const;

const fill = (stretch: Stretch): HostMessage[] => {
  const messages = [tissue(0)];
  for (let tick = stretch.from; tick <= stretch.to; tick += stretch.every) {
    messages.push(snapshot(tick));
  }
  return messages;
};

describe("statesOf", () => {
  it("carries on what did not change", () => {
    const states = statesOf([
      tissue(1),
      snapshot(1, pose as unknown as SnapshotMessage["bodies"]),
      snapshot(2),
      tissue(2),
      snapshot(3),
    ]);
    expect(states.map((state) => state.tracks.length)).toEqual([1, 1, 2]);
    expect(states.every((state) => state.bodies.length === 1)).toBe(true);
  });

  it("gives the scope and what yields to the snapshot that they came after, and carries them on", () => {
    const scope = (pullOuts: number): HostMessage =>
      ({ type: "scope", pull_outs: pullOuts }) as HostMessage;
    const states = statesOf([
      snapshot(1),
      scope(0),
      snapshot(2),
      snapshot(3),
      scope(1),
      { type: "sheet", sheet: 1, off_um: [0, 0, -500] },
      snapshot(4),
    ]);
    expect(states.map((state) => state.scope?.pull_outs)).toEqual([0, 0, 1, 1]);
    expect(states.map((state) => state.sheetsUm.get(1))).toEqual([
      undefined,
      undefined,
      [0, 0, -500],
      [0, 0, -500],
    ]);
  });
});

describe("ReplayBuffer", () => {
  it("wants the very moment while it stands still", () => {
    const buffer = new ReplayBuffer(100_000);
    const wanted = buffer.wanted(5000, 1, false);
    expect(wanted).toEqual({ from: 5000, to: 5000, every: 1 });
    buffer.add({ from: 5000, to: 5000, every: 1 }, statesOf([snapshot(5000)]));
    expect(buffer.wanted(5000, 1, false)).toBeUndefined();
    expect(buffer.at(5000)?.snapshot.tick).toBe(5000);
    expect(buffer.at(6000)).toBeUndefined();
  });

  it("asks on in time while it plays, without a gap, and no more than to the end", () => {
    const buffer = new ReplayBuffer(4000);
    let tick = 0;
    let asked = 0;
    for (; tick < 4000; tick += 17) {
      const wanted = buffer.wanted(tick, 1, true);
      if (wanted !== undefined) {
        ++asked;
        buffer.add(wanted, statesOf(fill(wanted)));
      }
      const state = buffer.at(tick);
      expect(state).toBeDefined();
      expect(tick - (state?.snapshot.tick ?? 0)).toBeLessThanOrEqual(33);
    }
    expect(asked).toBeLessThan(8);
  });

  it("begins anew when the speed changes", () => {
    const buffer = new ReplayBuffer(100_000);
    const slow = buffer.wanted(0, 1, true);
    if (slow !== undefined) buffer.add(slow, statesOf(fill(slow)));
    const fast = buffer.wanted(200, 8, true);
    expect(fast?.from).toBe(200);
    expect(fast?.every).toBe(264);
    expect((fast?.to ?? 0) - 200).toBeLessThanOrEqual(8 * 1300);
  });
});
