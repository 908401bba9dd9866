// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { begunBeforeSkin, givenWay } from "./at_skin";
import type { ToolPose } from "./tool_pose";

const DEEP: ToolPose = { anchorMm: [0, 0, 0], approachMm: -10, shaft: [0, 0, 1] };

describe("begunBeforeSkin", () => {
  it("draws what is taken anew out of the skin", () => {
    expect(begunBeforeSkin(DEEP, undefined)).toEqual({ ...DEEP, approachMm: 12 });
  });
  it("begins no deeper than what was held had been drawn out to", () => {
    expect(begunBeforeSkin(DEEP, [5, 0, 30]).approachMm).toBe(30);
  });
  it("leaves what is far enough out where it is", () => {
    const out = { ...DEEP, approachMm: 20 };
    expect(begunBeforeSkin(out, [0, 0, -4])).toBe(out);
  });
});

describe("givenWay", () => {
  it("lets a hand lead 6 mm ahead of what is held, and no more", () => {
    expect(givenWay(DEEP, [0, 0, -4])).toBe(DEEP);
    expect(givenWay({ ...DEEP, approachMm: -30 }, [0, 0, -4])).toEqual(DEEP);
  });
});
