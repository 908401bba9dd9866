// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import {
  blurRad,
  focusPerMm,
  focusTurned,
  focusWords,
  NEAREST_STEP,
  sharpRangeMm,
  SHARP_RAD,
  PUPIL_MM,
  WELL_SET_STEP,
} from "./focus_model";

describe("focus of the camera head", () => {
  it("is set for 6 mm at first, and all from a little over 3 mm to 10 cm is as sharp as can be", () => {
    expect(1 / focusPerMm(WELL_SET_STEP)).toBeCloseTo(6);
    for (const farMm of [3.2, 4, 5, 10, 30, 60, 100]) expect(blurRad(farMm, WELL_SET_STEP)).toBe(0);
    expect(blurRad(2, WELL_SET_STEP)).toBeGreaterThan(0.01);
  });

  it("draws a point as wide as a thin lens does", () => {
    // The pupil's width over what is in focus, seen from its middle: by similar triangles.
    for (const [farMm, step] of [
      [2, 0],
      [2.5, 2],
      [25, NEAREST_STEP],
    ] as const) {
      const inFocus = focusPerMm(step);
      const thin = PUPIL_MM * Math.abs((1 - inFocus * farMm) / farMm);
      expect(Math.hypot(blurRad(farMm, step), SHARP_RAD)).toBeCloseTo(thin, 9);
    }
  });

  it("is the softer the nearer, and softer there if set for far", () => {
    for (const step of [0, WELL_SET_STEP]) {
      const soft = [2.8, 2.5, 2, 1.5, 1].map((farMm) => blurRad(farMm, step));
      soft.slice(1).forEach((blur, i) => {
        expect(blur).toBeGreaterThan(soft[i] ?? NaN);
      });
    }
    expect(blurRad(3, 0)).toBeGreaterThan(blurRad(3, WELL_SET_STEP));
    expect(blurRad(3, NEAREST_STEP)).toBe(0);
    expect(blurRad(30, NEAREST_STEP)).toBeGreaterThan(0);
  });

  it("is sharp just within what it says", () => {
    for (let step = 0; step <= NEAREST_STEP; ++step) {
      const [from, to] = sharpRangeMm(step);
      expect(blurRad(from * 1.001, step)).toBe(0);
      expect(blurRad(from * 0.99, step)).toBeGreaterThan(0);
      if (to === Infinity) continue;
      expect(blurRad(to * 0.999, step)).toBe(0);
      expect(blurRad(to * 1.01, step)).toBeGreaterThan(0);
    }
  });

  it("turns from end to end and no farther", () => {
    expect(focusTurned(NEAREST_STEP, 1)).toBe(NEAREST_STEP);
    expect(focusTurned(0, -1)).toBe(0);
    expect(focusTurned(WELL_SET_STEP, -1)).toBe(WELL_SET_STEP - 1);
  });

  it("says where it stands", () => {
    expect(focusWords(WELL_SET_STEP)).toBe("Focus 6 mm · sharp from 3.1 mm");
    expect(focusWords(0)).toBe("Focus far · sharp from 6.4 mm");
    expect(focusWords(NEAREST_STEP)).toBe("Focus 3 mm · sharp 2 to 5.7 mm");
  });
});
