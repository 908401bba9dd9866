// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The hand's arithmetic: fine steps add up exactly, turning keeps the tip and the length.
import { describe, expect, it } from "vitest";
import { stepsAfter } from "./held_key_speed";
import {
  approachedBy,
  MAX_APPROACH_MM,
  PRESS_MM,
  tipTarget,
  turnedBy,
  type ToolPose,
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

describe("stepsAfter", () => {
  it("is one step for a tap and grows while held, without a jump", () => {
    expect(stepsAfter(0)).toBe(1);
    expect(stepsAfter(0.25)).toBe(1);
    let last = 1;
    for (let s = 0; s < 3; s += 0.01) {
      const now = stepsAfter(s);
      expect(now).toBeGreaterThanOrEqual(last);
      expect(now - last).toBeLessThan(1);
      last = now;
    }
    expect(last).toBeGreaterThan(100);
  });
});
