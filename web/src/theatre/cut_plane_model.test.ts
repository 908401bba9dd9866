// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { cutPlane, nextCut } from "./cut_plane_model";

describe("cutPlane", () => {
  it("goes through the point and takes away what is nearer", () => {
    const plane = cutPlane([0, 0, 5], [0, 0, -1], undefined);
    expect(plane?.normal).toEqual([-0, -0, -1].map((v) => expect.closeTo(v, 9)));
    const side = (z: number): number => (plane?.normal[2] ?? 0) * z + (plane?.constant ?? 0);
    expect(side(9)).toBeLessThan(0);
    expect(side(1)).toBeGreaterThan(0);
  });

  it("holds the axis and faces the viewer as far as it can", () => {
    const slanted = Math.SQRT1_2;
    const plane = cutPlane([1, 0, 0], [slanted, 0, -slanted], [1, 0, 0]);
    expect(plane?.normal[0]).toBeCloseTo(0, 9);
    expect(plane?.normal[2]).toBeCloseTo(-1, 9);
  });

  it("is none while one looks along the axis", () => {
    expect(cutPlane([0, 0, 0], [0, 1, 0], [0, 1, 0])).toBeUndefined();
  });
});

describe("nextCut", () => {
  it("goes round", () => {
    expect(nextCut(nextCut(nextCut("off")))).toBe("off");
  });
});
