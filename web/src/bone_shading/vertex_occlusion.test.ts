// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A lone plane is fully lit; between two near planes it is dark; the outside of the pair is lit.
import { describe, expect, it } from "vitest";
import { vertexOcclusion, type Surface } from "./vertex_occlusion";

function plane(z: number, up: 1 | -1): Surface {
  const positions: number[] = [];
  const normals: number[] = [];
  for (let x = -15; x <= 15; x += 0.5) {
    for (let y = -15; y <= 15; y += 0.5) {
      positions.push(x, y, z);
      normals.push(0, 0, up);
    }
  }
  return { positions: new Float32Array(positions), normals: new Float32Array(normals) };
}

function centre(light: Float32Array | undefined): number {
  return light?.[Math.floor((light.length - 1) / 2)] ?? NaN;
}

describe("vertexOcclusion", () => {
  it("leaves a lone plane in full light", () => {
    expect(centre(vertexOcclusion([plane(0, 1)])[0])).toBeCloseTo(1, 6);
  });

  it("darkens what faces another surface near by, and less what faces it farther away", () => {
    const near = centre(vertexOcclusion([plane(0, 1), plane(4, -1)])[0]);
    const far = centre(vertexOcclusion([plane(0, 1), plane(10, -1)])[0]);
    expect(near).toBeLessThan(0.6);
    expect(far).toBeGreaterThan(near + 0.1);
    expect(far).toBeLessThan(1);
  });

  it("does not darken the outer sides", () => {
    expect(centre(vertexOcclusion([plane(0, -1), plane(4, 1)])[0])).toBeCloseTo(1, 6);
  });

  it("takes an empty list and an empty surface", () => {
    const nothing: Surface = { positions: new Float32Array(), normals: new Float32Array() };
    expect(vertexOcclusion([])).toEqual([]);
    expect(vertexOcclusion([nothing])[0]?.length).toBe(0);
  });
});
