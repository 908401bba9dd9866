// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { apartFrom, nearestOf, pointsAt, rimCorners } from "./skin_rim_model";

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
    const rim = pointsAt(positions, rimCorners(facets));
    const { distances, indices } = nearestOf(positions, rim);
    expect(rim).toHaveLength(3 * SIDES);
    expect(positions[3 * 5]).toBeCloseTo(rim[3 * (indices[5] ?? 0)] ?? NaN, 5);
    expect(distances[0]).toBe(0);
    expect(distances[SIDES]).toBeCloseTo(Math.hypot(10, 50), 3);
  });

  it("is far everywhere on a closed skin", () => {
    const { positions, facets } = sleeve();
    positions.push(0, 0, 0);
    for (let i = 0; i < SIDES; ++i) facets.push((i + 1) % SIDES, i, SIDES + 1);
    const rim = pointsAt(positions, rimCorners(facets));
    expect(Math.min(...nearestOf(positions, rim).distances)).toBeGreaterThan(1e5);
  });

  it("is open only where nothing goes on from it", () => {
    const { positions, facets } = sleeve();
    const rim = pointsAt(positions, rimCorners(facets));
    expect(apartFrom(rim, rim.slice(0, 3 * SIDES), 1)).toHaveLength(0);
    expect(apartFrom(rim, [0, 0, 200], 1)).toHaveLength(3 * SIDES);
  });
});
