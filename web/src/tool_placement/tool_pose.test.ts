// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The hand's arithmetic: fine steps add up exactly, turning keeps the tip and the length.
import { describe, expect, it } from "vitest";
import { stepsAfter } from "./held_key_speed";
import { keySteps } from "./key_steps";
import {
  approachedBy,
  MAX_APPROACH_MM,
  PRESS_MM,
  tipTarget,
  turnedBy,
  type ToolPose,
  heldBackTo,
} from "./tool_pose";
import { cross, dot, length, normalized, rotated } from "./vectors";

const pose: ToolPose = { anchorMm: [1, 2, 3], approachMm: 5, shaft: [0, 0, 1] };

describe("ToolPose", () => {
  it("keeps the tip at its distance from the anchor along the shaft", () => {
    expect(tipTarget(pose)).toEqual([1, 2, 8]);
    expect(tipTarget({ ...pose, approachMm: 0 })).toEqual([1, 2, 3 - PRESS_MM]);
  });

  it("reaches the bone exactly by steps of a tenth", () => {
    let walked = pose;
    for (let i = 0; i < 50; ++i) walked = approachedBy(walked, -0.1);
    expect(walked.approachMm).toBe(0);
  });

  it("goes beyond the anchor where skin lets it, no deeper than is said", () => {
    const under = approachedBy({ ...pose, approachMm: 0 }, -5, 45);
    expect(under.approachMm).toBe(-5);
    expect(tipTarget(under)[2]).toBeLessThan(tipTarget({ ...under, approachMm: 0 })[2] - 4.9);
    expect(approachedBy(under, -1e6, 45).approachMm).toBe(-45);
  });

  it("never goes through the anchor or out of sight", () => {
    expect(approachedBy(pose, -1e6).approachMm).toBe(0);
    expect(approachedBy(pose, 1e6).approachMm).toBe(MAX_APPROACH_MM);
  });

  it("turns by the angle asked for, about the tip", () => {
    const half = Math.PI / 360;
    const turned = turnedBy({ ...pose, approachMm: 0 }, [1, 0, 0], half);
    expect(turned.anchorMm).toEqual(pose.anchorMm);
    expect(Math.acos(dot(turned.shaft, pose.shaft))).toBeCloseTo(half, 9);
  });

  it("keeps a unit shaft over ten thousand steps", () => {
    let turned = pose;
    const axis = normalized([1, 2, -1]);
    for (let i = 0; i < 10000; ++i) turned = turnedBy(turned, axis, 0.01);
    expect(length(turned.shaft)).toBeCloseTo(1, 12);
  });
});

describe("vectors", () => {
  it("rotate by the right hand", () => {
    const v = rotated([1, 0, 0], [0, 0, 1], Math.PI / 2);
    expect(v[1]).toBeCloseTo(1, 12);
    expect(cross([1, 0, 0], [0, 1, 0])).toEqual([0, 0, 1]);
  });

  it("give a fallback for what has no direction", () => {
    expect(normalized([0, 0, 0], [0, 1, 0])).toEqual([0, 1, 0]);
    expect(normalized([NaN, 0, 0], [0, 1, 0])).toEqual([0, 1, 0]);
  });
});

describe("heldBackTo", () => {
  const pose = { anchorMm: [0, 0, 0], approachMm: -20, shaft: [0, 0, 1] } as const;

  it("gives way to a tip that came no farther, along the shaft alone", () => {
    const held = heldBackTo(pose, [3, 0, -8], 6);
    expect(held.approachMm).toBeCloseTo(-14, 9);
    expect(held.anchorMm).toEqual(pose.anchorMm);
  });

  it("leaves a hand alone that is not so far ahead, or is drawn back", () => {
    expect(heldBackTo(pose, [0, 0, -15], 6)).toBe(pose);
    expect(heldBackTo({ ...pose, approachMm: 5 }, [0, 0, -8], 6).approachMm).toBe(5);
  });
});

describe("stepsAfter", () => {
  it("is one step for a tap and grows while held, never faster than the fastest", () => {
    expect(stepsAfter(0, 80)).toBe(1);
    expect(stepsAfter(0.25, 80)).toBe(1);
    let last = 1;
    let gain = 0;
    for (let s = 0; s < 3; s += 0.01) {
      const now = stepsAfter(s, 80);
      expect(now - last).toBeGreaterThanOrEqual(gain - 1e-9);
      expect(now - last).toBeLessThan(0.8 + 1e-9);
      gain = now - last;
      last = now;
    }
    expect(gain).toBeCloseTo(0.8, 6);
  });

  it("crosses a hand's breadth in three seconds by coarse steps, and not a millimetre by a fine tap", () => {
    const { move } = keySteps(true);
    expect(stepsAfter(3, move.fastest) * move.size).toBeGreaterThan(70);
    const fine = keySteps(false).move;
    expect(stepsAfter(0.2, fine.fastest) * fine.size).toBeCloseTo(0.1, 9);
  });
});
