// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import type { SnapshotMessage } from "../protocol";
import { HeldPeak, pressWords } from "./force_gauge";
import { forcesInJoint, gradeOf } from "./force_limits";

describe("force gauge", () => {
  it("warns over 3 N and tells an injury over 8 N", () => {
    expect([0, 3, 3.1, 8, 8.1].map(gradeOf)).toEqual([
      "good",
      "good",
      "warning",
      "warning",
      "injury",
    ]);
  });

  it("says over the picture who presses and what to do, and nothing of what does no harm", () => {
    expect(pressWords("Probe", 3)).toBe("");
    expect(pressWords("Probe", 4)).toBe("Probe presses too hard, 4.0 N: stop, or draw it back");
    expect(pressWords("Scope", 9.1)).toBe("Scope injures cartilage, 9.1 N: draw it back");
  });

  it("knows no force of a hand that works outside the joint", () => {
    const hands = [
      { force_n: [0, 3, 4] },
      { force_n: [0, 0, 40] },
    ] as unknown as SnapshotMessage["hands"];
    expect(forcesInJoint({ in_joint: [1, 0] }, { hands })).toEqual([5, 0]);
    expect(forcesInJoint(undefined, { hands })).toEqual([0, 0]);
    expect(forcesInJoint({ in_joint: [1, 1] }, undefined)).toEqual([]);
  });

  it("holds a blow long enough to be read, then follows", () => {
    const peak = new HeldPeak();
    expect(peak.at(5, 0)).toBe(5);
    expect(peak.at(1, 300)).toBe(5);
    expect(peak.at(1, 800)).toBe(1);
    expect(peak.at(2, 810)).toBe(2);
  });
});
