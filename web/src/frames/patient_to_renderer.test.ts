// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The conversion is a rotation with a scale, the fingers are up, and it can be undone.
import { describe, expect, it } from "vitest";
import { faceNames, makeFrameMap, rendererFromPatient, towards } from "./patient_to_renderer";

const identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
// 90 degrees about z and a shift, row by row.
const turned = [0, -1, 0, 10, 1, 0, 0, -20, 0, 0, 1, 30, 0, 0, 0, 1];

function apply(m: readonly number[], p: readonly number[]): number[] {
  return [0, 1, 2].map(
    (r) =>
      (m[r] ?? 0) * (p[0] ?? 0) +
      (m[4 + r] ?? 0) * (p[1] ?? 0) +
      (m[8 + r] ?? 0) * (p[2] ?? 0) +
      (m[12 + r] ?? 0),
  );
}

describe("rendererFromPatient", () => {
  it("puts distal up, dorsal in front, in metres", () => {
    const m = rendererFromPatient(identity);
    expect(apply(m, [-1000, 0, 0])).toEqual([0, 1, 0].map((v) => expect.closeTo(v, 12)));
    expect(apply(m, [0, 0, -1000])).toEqual([0, 0, 1].map((v) => expect.closeTo(v, 12)));
  });

  it("shows a left thumb (radial, -y) on the right", () => {
    expect(apply(rendererFromPatient(identity), [0, -1000, 0])[0]).toBeCloseTo(1, 12);
    expect(faceNames("left").right).toBe("Radial");
    expect(faceNames("right").right).toBe("Ulnar");
  });

  it("is never a reflection", () => {
    for (const pose of [identity, turned]) {
      const m = rendererFromPatient(pose).map((v) => v * 1000);
      const [a, b, c, d, e, f, g, h, i] = [
        m[0],
        m[1],
        m[2],
        m[4],
        m[5],
        m[6],
        m[8],
        m[9],
        m[10],
      ].map((v) => v ?? 0) as [
        number,
        number,
        number,
        number,
        number,
        number,
        number,
        number,
        number,
      ];
      expect(a * (e * i - f * h) - d * (b * i - c * h) + g * (b * f - c * e)).toBeCloseTo(1, 9);
    }
  });

  it("refuses what is no pose", () => {
    expect(() => rendererFromPatient([1, 2, 3])).toThrow("16 finite numbers");
    expect(() => rendererFromPatient(identity.map(() => NaN))).toThrow("16 finite numbers");
  });
});

describe("makeFrameMap", () => {
  it("returns points and directions to where they came from", () => {
    const map = makeFrameMap(turned);
    const point = [3, -7, 11] as const;
    const there = apply(map.matrix, point) as [number, number, number];
    const back = map.pointToPatient(...there);
    for (let i = 0; i < 3; ++i) expect(back[i]).toBeCloseTo(point[i] ?? 0, 9);
    const direction = map.directionToPatient(...map.directionToRenderer([0.6, 0, 0.8]));
    expect(direction[0]).toBeCloseTo(0.6, 12);
    expect(direction[1]).toBeCloseTo(0, 12);
    expect(direction[2]).toBeCloseTo(0.8, 12);
  });
});

describe("towards", () => {
  it("names the wrist frame's own axes, of either hand", () => {
    // Rows of the turned pose: proximal, +y, volar in Patient.
    const axes = { Proximal: [0, -1, 0], "+y": [1, 0, 0], Volar: [0, 0, 1] } as const;
    const map = makeFrameMap(turned);
    for (const side of ["left", "right"] as const) {
      const names = faceNames(side);
      const inPatient = (name: Parameters<typeof towards>[0]) =>
        map.directionToPatient(...towards(name, names)).map((v) => Math.round(v * 1e9) / 1e9 + 0);
      expect(inPatient("Proximal")).toEqual(axes.Proximal);
      expect(inPatient("Volar")).toEqual(axes.Volar);
      expect(inPatient(side === "left" ? "Ulnar" : "Radial")).toEqual(axes["+y"]);
      for (const [one, other] of [
        ["Dorsal", "Volar"],
        ["Radial", "Ulnar"],
        ["Distal", "Proximal"],
      ] as const) {
        expect(inPatient(one)).toEqual(inPatient(other).map((v) => -v + 0));
      }
    }
  });
});
