// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The wrist is asked for nothing beyond its limits.
import { describe, expect, it } from "vitest";
import { nudged, readingText, REST } from "./wrist_model";

const LIMITS = {
  flexion_deg: { low: -60, high: 70 },
  radial_deviation_deg: { low: -30, high: 20 },
  pronation_deg: { low: -80, high: 75 },
  traction_n: { low: 0, high: 100 },
};

describe("nudged", () => {
  it("changes one way and leaves the others", () => {
    expect(nudged({ ...REST, pronation_deg: 5 }, LIMITS, "flexion_deg", -3)).toEqual({
      ...REST,
      pronation_deg: 5,
      flexion_deg: -3,
    });
  });

  it("stays within the limits", () => {
    expect(nudged(REST, LIMITS, "flexion_deg", -1e6).flexion_deg).toBe(-60);
    expect(nudged(REST, LIMITS, "traction_n", -1).traction_n).toBe(0);
    expect(nudged(REST, LIMITS, "traction_n", 1e6).traction_n).toBe(100);
  });
});

describe("readingText", () => {
  it("has the unit of its way and no minus zero", () => {
    expect(readingText("flexion_deg", -12.4)).toBe("−12°");
    expect(readingText("flexion_deg", -0.3)).toBe("0°");
    expect(readingText("traction_n", 15)).toBe("15 N");
  });
});
