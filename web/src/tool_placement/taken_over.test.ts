// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { emptyHanded, takenOver } from "./taken_over";
import { MAX_APPROACH_MM } from "./tool_pose";

const item = { tip_mm: [1, 2, 40], shaft: [0, 0, 2] } as const;

describe("what a hand takes over", () => {
  it("begins where it is, drawn back from the level of what is operated on", () => {
    const pose = takenOver(item, [0, 0, 10], false);
    expect(pose).toEqual({ anchorMm: [1, 2, 10], approachMm: 30, shaft: [0, 0, 1] });
  });

  it("is drawn back no farther than a hand goes, nor beyond its tip", () => {
    expect(takenOver(item, [0, 0, -100], false).approachMm).toBe(MAX_APPROACH_MM);
    expect(takenOver(item, [0, 0, 100], false)).toMatchObject({
      anchorMm: [1, 2, 40],
      approachMm: 0,
    });
  });

  it("begins at its tip where that is in bone", () => {
    expect(takenOver(item, [0, 0, 10], true).anchorMm).toEqual([1, 2, 40]);
  });

  it("begins beside the middle, to the right, where it is nothing", () => {
    expect(emptyHanded([5, 0, 0], [0, 1, 0], [0, 0, 3])).toEqual({
      anchorMm: [5, 30, 0],
      approachMm: MAX_APPROACH_MM,
      shaft: [0, 0, 1],
    });
  });
});
