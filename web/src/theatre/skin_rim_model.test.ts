// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { distanceFromRim } from "./skin_rim_model";

const SIDES = 16;

/** A tube along z, open at z = 0, closed by a point at z = 50. */
function sleeve(): { positions: number[]; facets: number[] } {
  const positions: number[] = [];
  const facets: number[] = [];
  for (let i = 0; i < SIDES; ++i) {
    const angle = (2 * Math.PI * i) / SIDES;
    positions.push(10 * Math.cos(angle), 10 * Math.sin(angle), 0);
  }
  positions.push(0, 0, 50);
  for (let i = 0; i < SIDES; ++i) facets.push(i, (i + 1) % SIDES, SIDES);
  return { positions, facets };
}

describe("distance from the skin's rim", () => {
  it("is nothing on it and grows away from it", () => {
    const { positions, facets } = sleeve();
    const distances = distanceFromRim(positions, facets);
    expect(distances[0]).toBe(0);
    expect(distances[SIDES]).toBeCloseTo(Math.hypot(10, 50), 3);
  });

  it("is far everywhere on a closed skin", () => {
    const { positions, facets } = sleeve();
    positions.push(0, 0, 0);
    for (let i = 0; i < SIDES; ++i) facets.push((i + 1) % SIDES, i, SIDES + 1);
    expect(Math.min(...distanceFromRim(positions, facets))).toBeGreaterThan(1e5);
  });
});
