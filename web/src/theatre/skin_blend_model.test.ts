// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The ends of the skin go with their bones, the wrist between bends without pinching.
import { describe, expect, it } from "vitest";
import type { Vec3 } from "../protocol";
import {
  blendedPoint,
  dualQuaternion,
  evened,
  handWeights,
  sideOf,
  type RigidMotion,
} from "./skin_blend_model";

const STILL: RigidMotion = { rotation: [0, 0, 0, 1], translationMm: [0, 0, 0] };

/** Turned by `deg` about an axis through the origin along y. */
function bent(deg: number, translationMm: Vec3 = [0, 0, 0]): RigidMotion {
  const half = (deg * Math.PI) / 360;
  return { rotation: [0, Math.sin(half), 0, Math.cos(half)], translationMm };
}

function expectAt(p: Vec3, wanted: Vec3): void {
  p.forEach((v, i) => {
    expect(v).toBeCloseTo(wanted[i] ?? NaN, 6);
  });
}

describe("sideOf", () => {
  it.each([
    ["radius", "forearm"],
    ["metacarpal3", "hand"],
    ["capitate", "hand"],
    ["scaphoid_distal", undefined],
    ["lunate", undefined],
  ])("gives %s to %s", (bone, side) => {
    expect(sideOf(bone)).toBe(side);
  });
});

describe("handWeights", () => {
  const rod = (from: number): number[] =>
    Array.from({ length: 51 }, (_, i) => [from + i, 0, 0]).flat();
  const bones = [
    { name: "radius", positions: rod(-60) },
    { name: "lunate", positions: [0, 0, 0] },
    { name: "capitate", positions: rod(10) },
  ];
  it("go from the forearm to the hand without a step, half way between them", () => {
    const skin = Array.from({ length: 121 }, (_, i) => [i - 60, 12, 0]).flat();
    const weights = handWeights(skin, bones);
    expect(weights[0]).toBe(0);
    expect(weights[120]).toBe(1);
    expect(weights[60]).toBeCloseTo(0.5, 6);
    for (let i = 1; i < weights.length; ++i) {
      const step = (weights[i] ?? 0) - (weights[i - 1] ?? 0);
      expect(step).toBeGreaterThanOrEqual(0);
      expect(step).toBeLessThan(0.12);
    }
  });

  it("leave the skin with the bones that there are", () => {
    expect([...handWeights([1, 2, 3], bones.slice(0, 1))]).toEqual([0]);
    expect([...handWeights([1, 2, 3], bones.slice(2))]).toEqual([1]);
    expect([...handWeights([1, 2, 3], [])]).toEqual([0]);
  });
});

describe("evened", () => {
  /** A strip of squares, two facets each. */
  const length = 60;
  const facets = Array.from({ length: length - 1 }, (_, i) => {
    const [a, b, c, d] = [2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 3];
    return [a, b, c, b, d, c];
  }).flat();
  it("turns a step into a slope and leaves the ends alone", () => {
    const step = Float32Array.from({ length: 2 * length }, (_, v) => (v < length ? 0 : 1));
    const weights = evened(step, facets);
    expect(weights[0]).toBeCloseTo(0, 2);
    expect(weights[2 * length - 1]).toBeCloseTo(1, 2);
    for (let v = 2; v < weights.length; ++v)
      expect((weights[v] ?? 0) - (weights[v - 2] ?? 0)).toBeLessThan(0.12);
  });
  it("changes nothing where all agree", () => {
    expect([...evened(new Float32Array(8).fill(0.5), facets.slice(0, 18))]).toEqual(
      Array.from({ length: 8 }, () => 0.5),
    );
  });
});

describe("blendedPoint", () => {
  const p: Vec3 = [3, 4, 5];
  it("leaves the skin where nothing moves, whatever the weight", () => {
    const still = dualQuaternion(STILL);
    for (const weight of [0, 0.4, 1]) expectAt(blendedPoint(p, still, still, weight), p);
  });

  it("moves each end as its own bone moves", () => {
    const [a, b] = [dualQuaternion(bent(90, [1, 2, 3])), dualQuaternion(bent(-90))];
    expectAt(blendedPoint(p, a, b, 0), [6, 6, 0]);
    expectAt(blendedPoint(p, a, b, 1), [-5, 4, 3]);
  });

  it("bends half way by half the angle and keeps the wrist's thickness", () => {
    const [a, b] = [dualQuaternion(STILL), dualQuaternion(bent(60))];
    const middle = blendedPoint([0, 0, 20], a, b, 0.5);
    expectAt(middle, [10, 0, 20 * Math.cos(Math.PI / 6)]);
    expect(Math.hypot(...middle)).toBeCloseTo(20, 6);
  });

  it("takes the short way where a rotation came with the other sign", () => {
    const b = bent(60);
    const [x, y, z, w] = b.rotation;
    const other = dualQuaternion({ ...b, rotation: [-x, -y, -z, -w] });
    const still = dualQuaternion(STILL);
    expectAt(blendedPoint(p, still, other, 0.5), blendedPoint(p, still, dualQuaternion(b), 0.5));
  });
});
