// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { meanGrey, nextExposure } from "./auto_exposure";

/** What a scene of that brightness is shown as. */
const shown = (light: number, exposure: number): number =>
  Math.min(1, light * exposure) ** (1 / 2.2);

describe("automatic exposure", () => {
  it("settles on a grey that is neither burnt out nor dark", () => {
    for (const light of [0.2, 0.4, 0.65]) {
      let exposure = 1;
      for (let look = 0; look < 40; ++look)
        exposure = nextExposure(exposure, shown(light, exposure), 0.2);
      expect(shown(light, exposure)).toBeCloseTo(0.52, 1);
    }
  });

  it("takes as long on a slow machine as on a fast one", () => {
    const often = nextExposure(nextExposure(1, 0.65, 0.2), 0.65, 0.2);
    const slow = nextExposure(1, 0.65, 4);
    expect(slow).toBeLessThan(often);
    expect(shown(0.4, nextExposure(1, shown(0.4, 1), 4))).toBeCloseTo(0.52, 1);
  });

  it("does not jump, nor lights the dark up without end", () => {
    expect(nextExposure(1, 0.9, 0.2)).toBeGreaterThan(0.4);
    let exposure = 1;
    for (let look = 0; look < 40; ++look) exposure = nextExposure(exposure, 0, 0.2);
    expect(exposure).toBeLessThan(2);
  });

  it("means the round field alone", () => {
    const across = 16;
    const rgba = new Uint8ClampedArray(4 * across * across).fill(255);
    for (let y = 0; y < across; ++y) {
      for (let x = 0; x < across; ++x) {
        if (Math.hypot(x - 7.5, y - 7.5) <= 8) continue;
        rgba.fill(0, 4 * (y * across + x), 4 * (y * across + x) + 3);
      }
    }
    expect(meanGrey(rgba)).toBeCloseTo(1, 5);
  });
});
