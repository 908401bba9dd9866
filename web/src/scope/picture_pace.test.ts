// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { PicturePace } from "./picture_pace";

/** @returns the share after so many pictures, so far apart */
function after(pace: PicturePace, pictures: number, gapMs: number, fromMs = 0): number {
  let share = 1;
  for (let i = 1; i <= pictures; ++i) share = pace.share(fromMs + i * gapMs);
  return share;
}

describe("the pace of pictures", () => {
  it("keeps all pixels where pictures come fast enough, and where one is late", () => {
    const pace = new PicturePace();
    expect(after(pace, 200, 16)).toBe(1);
    expect(pace.share(200 * 16 + 300)).toBe(1);
    expect(after(pace, 200, 50, 4000)).toBe(1);
  });

  it("draws fewer pixels where pictures come slowly, never under two fifths of a side", () => {
    const pace = new PicturePace();
    const soon = after(pace, 17, 150);
    expect(soon).toBeLessThan(1);
    expect(soon).toBeGreaterThan(0.4);
    expect(after(pace, 200, 150, 3000)).toBe(0.4);
  });

  it("leaves a small picture as it is", () => {
    const pace = new PicturePace();
    after(pace, 200, 150);
    expect(pace.pixels(800, 30_150)).toBe(320);
    expect(pace.pixels(436, 30_300)).toBe(220);
    expect(pace.pixels(180, 30_450)).toBe(180);
  });

  it("gives them back, and is not misled by a page that was away", () => {
    const pace = new PicturePace();
    after(pace, 100, 150);
    expect(after(pace, 200, 16, 20_000)).toBe(1);
    expect(pace.share(120_000)).toBe(1);
    expect(after(pace, 10, 5000, 120_000)).toBe(1);
  });
});
