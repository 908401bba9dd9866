// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where the scan's field cut the skin off: flat faces of its bounding box. There it is draped.

export interface Box {
  /** x, y, z [mm] */
  readonly low: readonly [number, number, number];
  readonly high: readonly [number, number, number];
}

/** A facet lies in a face of the box when its corners are this near [mm]. */
const IN_FACE_MM = 0.6;
/** A face is a cut when so much of the skin lies in it [mm^2]; less is a skin that just reaches it. */
const LEAST_AREA_MM2 = 60;

/** Nowhere [mm]. */
export const UNCUT_MM = 1e9;

/**
 * The box with every face at which the skin was not cut moved out of sight.
 * @param positions  x, y, z per corner [mm]
 * @param facets     three corners each
 */
export function scanEnds(positions: ArrayLike<number>, facets: ArrayLike<number>): Box {
  const low: [number, number, number] = [Infinity, Infinity, Infinity];
  const high: [number, number, number] = [-Infinity, -Infinity, -Infinity];
  const at = (corner: number, axis: number): number => positions[3 * corner + axis] ?? 0;
  for (let v = 0; 3 * v + 2 < positions.length; ++v) {
    for (const axis of [0, 1, 2] as const) {
      low[axis] = Math.min(low[axis], at(v, axis));
      high[axis] = Math.max(high[axis], at(v, axis));
    }
  }
  const area = { low: [0, 0, 0], high: [0, 0, 0] };
  for (let f = 0; f + 2 < facets.length; f += 3) {
    const corners = [facets[f] ?? 0, facets[f + 1] ?? 0, facets[f + 2] ?? 0];
    for (const axis of [0, 1, 2] as const) {
      const isIn = (side: number): boolean =>
        corners.every((corner) => Math.abs(at(corner, axis) - side) <= IN_FACE_MM);
      if (isIn(low[axis])) area.low[axis] = (area.low[axis] ?? 0) + facetArea(corners, at);
      if (isIn(high[axis])) area.high[axis] = (area.high[axis] ?? 0) + facetArea(corners, at);
    }
  }
  for (const axis of [0, 1, 2] as const) {
    if ((area.low[axis] ?? 0) < LEAST_AREA_MM2) low[axis] = -UNCUT_MM;
    if ((area.high[axis] ?? 0) < LEAST_AREA_MM2) high[axis] = UNCUT_MM;
  }
  return { low, high };
}

function facetArea(
  corners: readonly number[],
  at: (corner: number, axis: number) => number,
): number {
  const [a = 0, b = 0, c = 0] = corners;
  const side = (to: number): number[] => [0, 1, 2].map((axis) => at(to, axis) - at(a, axis));
  const [ux = 0, uy = 0, uz = 0] = side(b);
  const [vx = 0, vy = 0, vz = 0] = side(c);
  return 0.5 * Math.hypot(uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx);
}
