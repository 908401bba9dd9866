// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A joint's wall has two sides, which may nearly touch as they were scanned: what lies on one is told by its
// bone, and by how near it is only where no bone is told. Pure.
import type { Vec3 } from "../protocol";

/** A wall as it was scanned. */
export interface SidedWall {
  /** Three a vertex, Patient [mm]. */
  readonly rest: ArrayLike<number>;
  /** By vertex the bone that it lies nearest to, on the proximal and on the distal side, by its place in the case's order ... */
  readonly proximal: readonly number[];
  readonly distal: readonly number[];
  /** ... and how far it goes with the distal one, 0 to 1: which side it is. */
  readonly distalShare: readonly number[];
}

/** 0 proximal, 1 distal. */
export type Side = 0 | 1;

/** So near to a line a bone bounds it [mm]. */
const BESIDE_MM = 2.5;

/** Of a bone; what bounds no wall by itself, as the ulna under its disc, goes with the forearm. */
export function sideOf(wall: Pick<SidedWall, "distal">, body: number): Side {
  return wall.distal.includes(body) ? 1 : 0;
}

/** Of a place on the surface of a bone that is not told: the wall of its own side is nearest. */
export function sideAt(wall: SidedWall, at: Vec3): Side {
  let least = Infinity;
  let share = 0;
  wall.distalShare.forEach((value, v) => {
    const off = squaredToLine(wall.rest, v, at, at);
    if (off >= least) return;
    least = off;
    share = value;
  });
  return share > 0.5 ? 1 : 0;
}

/** The other bone of a bone's side that a line lies beside: those two part where it is torn. */
export function partsFrom(wall: SidedWall, body: number, from: Vec3, to: Vec3): number | undefined {
  const side = sideOf(wall, body);
  const counts = new Map<number, number>();
  wall.distalShare.forEach((share, v) => {
    const other = (side === 1 ? wall.distal : wall.proximal)[v];
    if (other === undefined || other === body || Math.abs(share - side) > 0.5) return;
    if (squaredToLine(wall.rest, v, from, to) > BESIDE_MM ** 2) return;
    counts.set(other, (counts.get(other) ?? 0) + 1);
  });
  return [...counts].sort((a, b) => b[1] - a[1] || a[0] - b[0])[0]?.[0];
}

function squaredToLine(rest: ArrayLike<number>, vertex: number, from: Vec3, to: Vec3): number {
  const off = [0, 1, 2].map((k) => (rest[3 * vertex + k] ?? 0) - (from[k] ?? 0));
  const along = [0, 1, 2].map((k) => (to[k] ?? 0) - (from[k] ?? 0));
  const dot = (a: readonly number[], b: readonly number[]): number =>
    a.reduce((sum, value, k) => sum + value * (b[k] ?? 0), 0);
  const share = Math.min(1, Math.max(0, dot(off, along) / Math.max(dot(along, along), 1e-9)));
  return off.reduce((sum, value, k) => sum + (value - share * (along[k] ?? 0)) ** 2, 0);
}
