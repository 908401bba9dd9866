// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Steps down on a slow machine only, to the simplest drawing at most, not for a hiccup or a rest; a
// picture at rest is drawn sharp once.
import { describe, expect, it } from "vitest";
import { DrawingPace, DRAWINGS } from "./drawing_pace_model";

function move(pace: DrawingPace, ms: number, frames: number): void {
  for (let i = 0; i < frames; ++i) pace.moves(1000 + i * ms);
}

describe("DrawingPace", () => {
  it("leaves a fast machine alone", () => {
    const pace = new DrawingPace();
    move(pace, 16, 1000);
    expect(pace.drawing).toBe(DRAWINGS[0]);
  });

  it("becomes simpler step by step on a slow one, each step no finer than the last", () => {
    const pace = new DrawingPace();
    let before = pace.drawing;
    let steps = 0;
    for (let i = 0; i < 100; ++i) {
      pace.moves(1000 + i * 200);
      const now = pace.drawing;
      if (now !== before) ++steps;
      expect(now.shadowPixels).toBeLessThanOrEqual(before.shadowPixels);
      expect(now.pixelRatio).toBeLessThanOrEqual(before.pixelRatio);
      before = now;
    }
    expect(steps).toBe(DRAWINGS.length - 1);
    expect(before).toBe(DRAWINGS.at(-1));
  });

  it("ignores hiccups and rests", () => {
    const pace = new DrawingPace();
    for (let i = 0; i < 50; ++i) {
      move(pace, 200, 4);
      pace.rests(5000);
    }
    expect(pace.drawing).toBe(DRAWINGS[0]);
  });

  it("draws once more, sharp, a moment after the last change, and coarsely again when moved", () => {
    const simplest = DRAWINGS.length - 1;
    const pace = new DrawingPace(simplest);
    pace.moves(1000);
    const asked = Array.from({ length: 100 }, (_, i) => pace.rests(1016 + 16 * i));
    expect(asked.filter((once) => once)).toHaveLength(1);
    expect(asked.indexOf(true) * 16).toBeGreaterThan(200);
    expect(pace.drawing.pixelRatio).toBeGreaterThanOrEqual(1);
    pace.moves(9000);
    expect(pace.drawing).toBe(DRAWINGS[simplest]);
  });

  it("asks for no second picture where the first is sharp", () => {
    const pace = new DrawingPace();
    pace.moves(1000);
    for (let i = 0; i < 100; ++i) expect(pace.rests(1016 + 16 * i)).toBe(false);
  });
});
