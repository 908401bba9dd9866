// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where the scan's field cut the skin off it has an open rim. Around it the limb is draped.

/** Corners of edges that belong to one facet alone. */
function rimOf(facets: ArrayLike<number>): number[] {
  const facetsOf = new Map<string, [count: number, a: number, b: number]>();
  for (let f = 0; f + 2 < facets.length; f += 3) {
    for (const [from, to] of [
      [0, 1],
      [1, 2],
      [2, 0],
    ] as const) {
      const [a, b] = [facets[f + from] ?? 0, facets[f + to] ?? 0];
      const key = a < b ? `${a} ${b}` : `${b} ${a}`;
      facetsOf.set(key, [(facetsOf.get(key)?.[0] ?? 0) + 1, a, b]);
    }
  }
  const open = [...facetsOf.values()].filter(([count]) => count === 1);
  return [...new Set(open.flatMap(([, a, b]) => [a, b]))];
}

/**
 * How far each corner is from the rim [mm]; far where there is none.
 * @param positions  x, y, z per corner [mm]
 * @param facets     three corners each
 */
export function distanceFromRim(
  positions: ArrayLike<number>,
  facets: ArrayLike<number>,
): Float32Array {
  const at = (corner: number, axis: number): number => positions[3 * corner + axis] ?? 0;
  const rim = rimOf(facets);
  const distances = new Float32Array(positions.length / 3).fill(1e6);
  for (let v = 0; v < distances.length; ++v) {
    let least = 1e12;
    for (const corner of rim) {
      const [x, y, z] = [
        at(v, 0) - at(corner, 0),
        at(v, 1) - at(corner, 1),
        at(v, 2) - at(corner, 2),
      ];
      least = Math.min(least, x * x + y * y + z * z);
    }
    distances[v] = Math.sqrt(least);
  }
  return distances;
}
