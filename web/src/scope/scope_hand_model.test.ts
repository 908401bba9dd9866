// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { add, dot, length, scaled, subtract } from "../tool_placement";
import {
  advanced,
  heldBack,
  isBefore,
  leanAt,
  leaned,
  wayRound,
  wishOf,
  wrappedDeg,
  type PortalNow,
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

  it("presses no farther than a hand does", () => {
    const deep = { depthMm: 30, yawRad: 0, pitchRad: 0 };
    const tip = wishOf({ ...deep, depthMm: 16 }, PORTAL).tipMm;
    const back = heldBack(deep, tip, PORTAL, { forceN: 4, goesOn: true });
    expect(back.depthMm).toBeCloseTo(18.5, 6);
    const near = { ...deep, depthMm: 17 };
    expect(heldBack(near, tip, PORTAL, { forceN: 4, goesOn: false })).toBe(near);
  });

  it("levers no farther to the side than does harm, where something holds the tip", () => {
    const tip = [1, 2, -17] as const; // 20 mm in, upright
    const wide = { depthMm: 21, yawRad: 0.6, pitchRad: 0 };
    const off = (lean: typeof wide): number => length(subtract(wishOf(lean, PORTAL).tipMm, tip));
    expect(off(wide)).toBeGreaterThan(10);
    const led = (forceN: number, goesOn: boolean): number =>
      off(heldBack(wide, tip, PORTAL, { forceN, goesOn }));
    expect(led(3, true)).toBeCloseTo(5, 6);
    expect(led(3, false)).toBeCloseTo(2.5, 6); // it gives way
    expect(led(0, true)).toBe(off(wide)); // it is on its way
  });

  it("turns round and round", () => {
    expect(wrappedDeg(190)).toBe(-170);
    expect(wrappedDeg(-190)).toBe(170);
    expect(wrappedDeg(540)).toBe(-180);
  });
});
