// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where the scan's field cut the skin off it has an open rim. There the limb goes on, or is draped.

/** Corners of edges that belong to one facet alone. @param facets  three corners each */
export function rimCorners(facets: ArrayLike<number>): number[] {
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

/** x, y, z of these corners [mm]. */
export function pointsAt(positions: ArrayLike<number>, corners: readonly number[]): Float32Array {
  return Float32Array.from(
    corners.flatMap((corner) => [0, 1, 2].map((axis) => positions[3 * corner + axis] ?? 0)),
  );
}

export interface Nearest {
  /** Far where there are no others [mm]. */
  readonly distances: Float32Array<ArrayBuffer>;
  /** Which of the others it is. */
  readonly indices: Uint32Array;
}

/** Of each point the nearest of the others. */
export function nearestOf(points: ArrayLike<number>, others: ArrayLike<number>): Nearest {
  const distances = new Float32Array(points.length / 3).fill(1e6);
  const indices = new Uint32Array(distances.length);
  for (let v = 0; v < distances.length; ++v) {
    let least = 1e12;
    for (let o = 0; o + 2 < others.length; o += 3) {
      const x = (points[3 * v] ?? 0) - (others[o] ?? 0);
      const y = (points[3 * v + 1] ?? 0) - (others[o + 1] ?? 0);
      const z = (points[3 * v + 2] ?? 0) - (others[o + 2] ?? 0);
      const square = x * x + y * y + z * z;
      if (square >= least) continue;
      least = square;
      indices[v] = o / 3;
    }
    distances[v] = Math.sqrt(least);
  }
  return { distances, indices };
}

/** Those of the points that lie farther than so much from all of the others. */
export function apartFrom(
  points: Float32Array,
  others: ArrayLike<number>,
  mm: number,
): Float32Array<ArrayBuffer> {
  const far = nearestOf(points, others).distances;
  return Float32Array.from(points.filter((_, i) => (far[Math.floor(i / 3)] ?? 0) > mm));
}
