// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Lengths at the isocentre: the 80 mm field of the receptor is 64 mm there, whatever its pixels.
import { describe, expect, it } from "vitest";
import { rulerMm, withPoint, type Ruler, keyStep, nudgedPoint } from "./ruler_model";

const left = { x: 0, y: 0.5 };
const right = { x: 1, y: 0.5 };
const whole: Ruler = withPoint(withPoint([], left), right);

describe("rulerMm", () => {
  it.each([512, 256])("takes the magnification out, of %d pixels", (width) => {
    expect(rulerMm(whole, { width, mmPerPixel: 80 / width })).toBeCloseTo(64, 9);
  });

  it("measures along the slope", () => {
    const ruler = [left, { x: 0.3, y: 0.9 }];
    expect(rulerMm(ruler, { width: 512, mmPerPixel: 80 / 512 })).toBeCloseTo(32, 9);
  });

  it("needs both points, and a third begins anew", () => {
    const picture = { width: 512, mmPerPixel: 80 / 512 };
    expect(rulerMm(withPoint([], left), picture)).toBeUndefined();
    expect(withPoint(whole, left)).toEqual([left]);
  });
});

describe("the ruler by keys", () => {
  it("goes by pixels, with Shift far, and stays on the picture", () => {
    expect(keyStep("ArrowLeft", false)).toEqual({ right: -1, down: 0 });
    expect(keyStep("ArrowDown", true)).toEqual({ right: 0, down: 20 });
    expect(keyStep("a", false)).toBeUndefined();
    expect(nudgedPoint({ x: 0.5, y: 0.99 }, 0.1, 0.1)).toEqual({ x: 0.6, y: 1 });
  });
});
