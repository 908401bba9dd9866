// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Steps down on a slow machine only, twice at most, and not for a hiccup or a rest.
import { describe, expect, it } from "vitest";
import { DrawingPace } from "./drawing_pace_model";

function run(pace: DrawingPace, ms: number, frames: number): number {
  let steps = 0;
  for (let i = 0; i < frames; ++i) if (pace.drew(1000 + i * ms)) ++steps;
  pace.rest();
  return steps;
}

describe("DrawingPace", () => {
  it("leaves a fast machine alone", () => {
    expect(run(new DrawingPace(), 16, 1000)).toBe(0);
  });
  it("becomes simpler twice on a slow one", () => {
    expect(run(new DrawingPace(), 200, 1000)).toBe(2);
  });
  it("ignores hiccups and rests", () => {
    const pace = new DrawingPace();
    for (let i = 0; i < 50; ++i) expect(run(pace, 200, 4)).toBe(0);
  });
});
