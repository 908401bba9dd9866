// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A gamepad at rest asks for nothing; a trigger pushes as deep as it is pressed.
import { describe, expect, it } from "vitest";
import { padWish, type PadState } from "./pad_model";

function pad(axes: readonly number[], down: Readonly<Record<number, number>> = {}): PadState {
  const buttons = Array.from({ length: 17 }, (_, i) => {
    const value = down[i] ?? 0;
    return { value, pressed: value > 0.5 };
  });
  return { axes, buttons };
}

const still = pad([0, 0, 0, 0]);

describe("padWish", () => {
  it("asks for nothing at rest, of a worn stick too", () => {
    const wish = padWish(pad([0.1, -0.1, 0.09, 0]), still);
    expect(wish).toMatchObject({ tip: { right: 0, up: 0 }, shaft: { right: 0, up: 0 } });
    expect([wish.held.size, wish.once.length, wish.squeeze, wish.pedal]).toEqual([0, 0, 0, false]);
  });

  it("moves the tip up where the stick goes up, finely near the middle", () => {
    const slight = padWish(pad([0, -0.3, 0, 0]), still).tip.up;
    const full = padWish(pad([0, -1, 0, 0]), still).tip.up;
    expect(slight).toBeGreaterThan(0);
    expect(slight).toBeLessThan(1.5);
    expect(full).toBeCloseTo(30, 9);
  });

  it("turns the shaft by the other stick, no faster in a corner", () => {
    const { shaft } = padWish(pad([0, 0, 1, 1]), still);
    expect(Math.hypot(shaft.right, shaft.up)).toBeCloseTo((70 * Math.PI) / 180, 9);
    expect(shaft.right).toBeGreaterThan(0);
    expect(shaft.up).toBeLessThan(0);
  });

  it("drives as deep as the trigger is pressed; reverse goes before", () => {
    const half = padWish(pad([0, 0, 0, 0], { 7: 0.54 }), still);
    expect(half.squeeze).toBeCloseTo(0.5, 9);
    expect(half.held.get("pad drive")).toEqual({ kind: "drive", driver: "forward" });
    const both = padWish(pad([0, 0, 0, 0], { 6: 1, 7: 1 }), still);
    expect([...both.held.values()]).toEqual([{ kind: "drive", driver: "reverse" }]);
  });

  it("moves the wrist by the sticks and the rest by other buttons while Back is held", () => {
    const wish = padWish(pad([-0.9, 0.2, 0.7, 0], { 8: 1, 7: 1, 15: 1 }), still);
    expect([...wish.held.values()]).toEqual([
      { kind: "move_wrist", axis: "radial_deviation_deg", sign: -1 },
      { kind: "move_wrist", axis: "pronation_deg", sign: 1 },
    ]);
    expect(wish.once).toEqual([{ kind: "judge", displaced: true }]);
    expect([wish.tip.right, wish.squeeze, wish.usesLayer]).toEqual([0, 0, true]);
  });

  it("acts once for a button that stays down", () => {
    const down = pad([0, 0, 0, 0], { 0: 1 });
    expect(padWish(down, still).once).toEqual([{ kind: "free_shot" }]);
    expect(padWish(down, down).once).toEqual([]);
    expect(padWish(pad([], { 2: 1 }), down).pedal).toBe(true);
  });
});
