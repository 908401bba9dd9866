// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { writtenLines, type Paragraph } from "./written_lines";

/** Each letter is half as wide as high. */
const measure = (text: string, sizePx: number): number => 0.5 * sizePx * text.length;
const room = { widthPx: 900, heightPx: 500 };
const said = (words: number, sizePx = 30): Paragraph => ({
  text: "words ".repeat(words).trim(),
  sizePx,
  weight: 400,
  color: "",
  gapPx: 10,
});

describe("the lines of a screen's words", () => {
  it("stand under each other in their wished sizes where there is room", () => {
    const lines = writtenLines([said(1, 46), said(20)], room, measure);
    expect(lines.map(({ sizePx }) => sizePx)).toEqual([46, 30, 30]);
    expect(lines[1]?.topPx).toBeCloseTo(46 * 1.28 + 10);
    expect(lines[2]?.topPx).toBeCloseTo((lines[1]?.topPx ?? 0) + 30 * 1.28);
  });

  it("are all smaller where they would run into what stands below, none left out", () => {
    const lines = writtenLines([said(1, 46), said(140)], room, measure);
    const words = lines.map(({ text }) => text).join(" ");
    expect(words.split(" ")).toHaveLength(141);
    expect(lines[0]?.sizePx).toBeLessThan(46);
    for (const { topPx, sizePx, text } of lines) {
      expect(topPx + sizePx).toBeLessThan(room.heightPx);
      expect(measure(text, sizePx)).toBeLessThanOrEqual(room.widthPx);
    }
  });

  it("end with the last that fits where even small ones do not", () => {
    const lines = writtenLines([said(4000)], room, measure);
    expect(lines.length).toBeGreaterThan(10);
    expect(lines.every(({ topPx, sizePx }) => sizePx === 15 && topPx + sizePx < 500)).toBe(true);
  });
});
