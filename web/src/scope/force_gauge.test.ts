// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { gradeOf, HeldPeak } from "./force_gauge";

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

  it("holds a blow long enough to be read, then follows", () => {
    const peak = new HeldPeak();
    expect(peak.at(5, 0)).toBe(5);
    expect(peak.at(1, 300)).toBe(5);
    expect(peak.at(1, 800)).toBe(1);
    expect(peak.at(2, 810)).toBe(2);
  });
});
