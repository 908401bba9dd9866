// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import type { Vec3 } from "../protocol";
import { add, dot, length, scaled, subtract } from "../tool_placement";
import { INJURY_N, WARN_N } from "./force_limits";
import {
  advanced,
  heldBack,
  isBefore,
  leanAt,
  leaned,
  mostBeyondMm,
  NOT_PRESSED,
  notAhead,
  pressed,
  wayRound,
  wishOf,
  wrappedDeg,
  type Lean,
  type PortalNow,
  type Press,
} from "./scope_hand_model";

const PORTAL: PortalNow = { skinMm: [1, 2, 3], inwards: [0, 0, -1], up: [0, 1, 0], capsuleMm: 12 };

describe("from portal to portal", () => {
  const volar: PortalNow = { ...PORTAL, skinMm: [1, 2, -37], inwards: [0, 0, 1] };

  it("goes straight to a neighbour", () => {
    expect(wayRound(PORTAL, { ...PORTAL, skinMm: [11, 2, 3] })).toEqual([]);
  });

  it("goes round the wrist to the other side, never through it", () => {
    const wishes = wayRound(PORTAL, volar);
    expect(wishes.length).toBeGreaterThan(3);
    const middle = [1, 2, -17] as const;
    wishes.forEach(({ tipMm, shaft }, i) => {
      expect(dot(shaft, subtract(tipMm, middle))).toBeGreaterThan(60);
      const next = wishes[i + 1];
      if (next === undefined) return;
      const half = scaled(add(tipMm, next.tipMm), 0.5);
      expect(length(subtract(half, middle))).toBeGreaterThan(70);
    });
    expect(dot(wishes.at(-1)?.shaft ?? [0, 0, 0], volar.inwards)).toBeCloseTo(-1, 9);
  });
});

describe("a tip", () => {
  it("is before a portal on its way in, neither beside it nor beyond the skin", () => {
    expect(isBefore([1, 2, 60], PORTAL)).toBe(true);
    expect(isBefore([4, 2, 5], PORTAL)).toBe(true);
    expect(isBefore([9, 2, 5], PORTAL)).toBe(false);
    expect(isBefore([1, 2, 1], PORTAL)).toBe(false);
  });
});

describe("an instrument in its portal", () => {
  it("keeps its shaft through the hole however it leans", () => {
    for (const yaw of [-0.6, 0, 0.3]) {
      for (const pitch of [-0.4, 0, 0.5]) {
        const { tipMm, shaft } = wishOf({ depthMm: 15, yawRad: yaw, pitchRad: pitch }, PORTAL);
        const hole = add(tipMm, scaled(shaft, 15));
        expect(length(subtract(hole, PORTAL.skinMm))).toBeLessThan(1e-9);
        expect(length(shaft)).toBeCloseTo(1, 9);
      }
    }
  });

  it("finds the lean again from where the tip is", () => {
    const lean = { depthMm: 14, yawRad: 0.3, pitchRad: -0.2 };
    const again = leanAt(wishOf(lean, PORTAL).tipMm, PORTAL);
    expect(again.depthMm).toBeCloseTo(lean.depthMm, 9);
    expect(again.yawRad).toBeCloseTo(lean.yawRad, 9);
    expect(again.pitchRad).toBeCloseTo(lean.pitchRad, 9);
  });

  it("goes in along the way in and leans only within", () => {
    const outside = leaned({ depthMm: -10, yawRad: 0, pitchRad: 0 }, 0.3, 0.3);
    expect(outside.yawRad).toBe(0);
    const inside = advanced(outside, 25, PORTAL);
    const leant = { depthMm: 24, yawRad: 0.5, pitchRad: -0.3 };
    expect(advanced(leant, -1, PORTAL)).toEqual({ ...leant, depthMm: 23 });
    expect(Math.abs(advanced(leant, -11, PORTAL).yawRad)).toBeLessThan(0.2);
    expect(advanced(leant, 2, PORTAL).yawRad).toBe(0.5);
    expect(inside.depthMm).toBe(15);
    expect(dot(wishOf(inside, PORTAL).shaft, PORTAL.inwards)).toBeCloseTo(-1, 9);
    expect(advanced(inside, 1000, PORTAL).depthMm).toBeLessThanOrEqual(42);
  });

  const off = (lean: Lean, tipMm: Vec3): number =>
    length(subtract(wishOf(lean, PORTAL).tipMm, tipMm));

  it("presses no farther than it may, where something holds the tip", () => {
    const deep = { depthMm: 30, yawRad: 0, pitchRad: 0 };
    const tip = wishOf({ ...deep, depthMm: 16 }, PORTAL).tipMm;
    expect(heldBack(deep, tip, PORTAL, { forceN: 4, mostMm: 2 }).depthMm).toBeCloseTo(18, 6);
    const near = { ...deep, depthMm: 17 };
    expect(heldBack(near, tip, PORTAL, { forceN: 4, mostMm: 2 })).toBe(near);
    expect(heldBack(deep, tip, PORTAL, { forceN: 0, mostMm: 2 })).toBe(deep); // it is on its way
    const aside = [1, 2, -17] as const; // 20 mm in, upright
    const wide = { depthMm: 21, yawRad: 0.6, pitchRad: 0 };
    expect(off(wide, aside)).toBeGreaterThan(10);
    expect(off(heldBack(wide, aside, PORTAL, { forceN: 3, mostMm: 2 }), aside)).toBeCloseTo(2, 6);
  });

  it("gives way once it is let go, and does harm only when it is led on over the warning", () => {
    const N_PER_MM = 2;
    const newtons = (press: Press, nowMs: number): number => N_PER_MM * mostBeyondMm(press, nowMs);
    let press: Press = { ...NOT_PRESSED, ledMs: 1000 };
    press = pressed(press, 2, 1000);
    expect(newtons(press, 5000)).toBeLessThan(WARN_N);
    expect(newtons(press, 1010)).toBeGreaterThan(WARN_N); // it is warned of ...
    expect(newtons(press, 1010)).toBeLessThan(INJURY_N);
    press = { ...pressed(press, 4, 1100), ledMs: 1700 };
    expect(newtons(press, 1700)).toBeLessThan(INJURY_N); // ... for a while
    press = { ...pressed(press, 4, 1850), ledMs: 1850 };
    expect(newtons(press, 1850)).toBeGreaterThan(INJURY_N);
    expect(newtons(press, 2200)).toBeLessThan(WARN_N); // let go
    press = { ...pressed(press, 2.5, 2300), ledMs: 2300 };
    expect(newtons(press, 2300)).toBeLessThan(INJURY_N); // warned anew
  });

  it("runs no farther ahead of a free tip than it could press without a warning", () => {
    const tip = [1, 2, -17] as const;
    const flung = { depthMm: 30, yawRad: 0.6, pitchRad: 0 };
    const ahead = off(notAhead(flung, tip, PORTAL, 2), tip);
    expect(2 * ahead).toBeLessThan(INJURY_N);
    expect(ahead).toBeGreaterThan(3);
    const near = { depthMm: 22, yawRad: 0.05, pitchRad: 0 };
    expect(notAhead(near, tip, PORTAL, 2)).toBe(near);
  });

  it("turns round and round", () => {
    expect(wrappedDeg(190)).toBe(-170);
    expect(wrappedDeg(-190)).toBe(170);
    expect(wrappedDeg(540)).toBe(-180);
  });
});
