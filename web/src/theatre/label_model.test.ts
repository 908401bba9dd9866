// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { linesOf, roomAside, spread, type Label } from "./label_model";

const byLetter = (text: string): number => 7 * text.length;

describe("linesOf", () => {
  it("breaks a long name between words, and never one word", () => {
    const name = "Superficial radial nerve, branch to the thumb";
    const lines = linesOf(name, 130, byLetter);
    expect(lines).toEqual(["Superficial radial", "nerve, branch to", "the thumb"]);
    expect(linesOf("Extensor pollicis", 20, byLetter)).toEqual(["Extensor", "pollicis"]);
    expect(linesOf("Lunate", 130, byLetter)).toEqual(["Lunate"]);
  });
});

describe("roomAside", () => {
  it("leaves the picture most of the width", () => {
    for (const width of [390, 630, 800, 1400]) expect(roomAside(width)).toBeLessThan(0.22 * width);
  });
});

describe("spread", () => {
  const label = (y: number, height: number, left = true): Label => ({ y, height, left, labelY: y });

  it("keeps labels of one side apart and within", () => {
    const all = [label(100, 34), label(104, 17), label(395, 51), label(102, 17, false)];
    for (const left of [true, false]) spread(all, left, 16, 400);
    const side = all.slice(0, 3).sort((a, b) => a.labelY - b.labelY);
    side.forEach((one, i) => {
      const above = side[i - 1];
      if (above !== undefined)
        expect(one.labelY - one.height / 2).toBeGreaterThanOrEqual(above.labelY + above.height / 2);
      expect(one.labelY + one.height / 2).toBeLessThanOrEqual(400);
    });
    expect(all[3]?.labelY).toBe(102);
  });
});
