// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How the skin follows the bent wrist: each of its points goes with the forearm, with the hand, or
// between them with both. Two rigid motions are blended as dual quaternions [kavan2007skinning]: means of
// matrices would pinch the wrist.
import type { Vec3 } from "../protocol";

/** x, y, z, w of a unit quaternion. */
export type Rotation = readonly [number, number, number, number];

/** Patient from where the bone was in the case: turns about Patient's origin, then moves [mm]. */
export interface RigidMotion {
  readonly rotation: Rotation;
  readonly translationMm: Vec3;
}

export interface DualQuaternion {
  readonly real: Rotation;
  readonly dual: Rotation;
}

const FOREARM = ["radius", "ulna"];
/** Those of the distal row move with the metacarpals; those of the proximal row lie between. */
const HAND = ["metacarpal", "trapezium", "trapezoid", "capitate", "hamate"];
/** Of the whole way from forearm to hand: nearer than this to one end only that end counts. */
const BLEND_FROM = 0.2;
const BLEND_TO = 0.8;
/** Of each side so many points of bone are enough for a smooth distance. */
const SAMPLES = 400;

export type SkinSide = "forearm" | "hand";

/** Which end of the skin a bone carries. */
export function sideOf(bone: string): SkinSide | undefined {
  if (FOREARM.some((name) => bone.startsWith(name))) return "forearm";
  if (HAND.some((name) => bone.startsWith(name))) return "hand";
  return undefined;
}

export interface NamedPoints {
  readonly name: string;
  /** x, y, z per point [mm]. */
  readonly positions: ArrayLike<number>;
}

function samples(bones: readonly NamedPoints[], side: SkinSide): Vec3[] {
  const chosen = bones.filter(({ name }) => sideOf(name) === side);
  const total = chosen.reduce((sum, { positions }) => sum + positions.length / 3, 0);
  const every = Math.max(1, Math.floor(total / SAMPLES));
  const out: Vec3[] = [];
  for (const { positions } of chosen) {
    for (let i = 0; i + 2 < positions.length; i += 3 * every)
      out.push([positions[i] ?? 0, positions[i + 1] ?? 0, positions[i + 2] ?? 0]);
  }
  return out;
}

function distance(points: readonly Vec3[], x: number, y: number, z: number): number {
  let least = Infinity;
  for (const p of points) {
    const [dx, dy, dz] = [p[0] - x, p[1] - y, p[2] - z];
    least = Math.min(least, dx * dx + dy * dy + dz * dz);
  }
  return Math.sqrt(least);
}

/** How far each point of the skin goes with the hand, 0 to 1; computed once. */
export function handWeights(skin: ArrayLike<number>, bones: readonly NamedPoints[]): Float32Array {
  const forearm = samples(bones, "forearm");
  const hand = samples(bones, "hand");
  const weights = new Float32Array(skin.length / 3);
  if (hand.length === 0) return weights;
  if (forearm.length === 0) return weights.fill(1);
  for (let v = 0; v < weights.length; ++v) {
    const [x, y, z] = [skin[3 * v] ?? 0, skin[3 * v + 1] ?? 0, skin[3 * v + 2] ?? 0];
    const toForearm = distance(forearm, x, y, z);
    const toHand = distance(hand, x, y, z);
    const way = toForearm / Math.max(1e-6, toForearm + toHand);
    const t = Math.min(1, Math.max(0, (way - BLEND_FROM) / (BLEND_TO - BLEND_FROM)));
    weights[v] = t * t * (3 - 2 * t);
  }
  return weights;
}

/** Passes of evening out: some 15 mm on a skin whose corners are 2 mm apart. */
const PASSES = 60;

/**
 * The same, evened out along the skin itself: where forearm and hand are about as near (under the thumb),
 * neighbours must not part when the wrist bends.
 * @param facets  three corners each
 */
export function evened(weights: Float32Array, facets: ArrayLike<number>): Float32Array {
  let now = weights;
  for (let pass = 0; pass < PASSES; ++pass) {
    const sum = Float32Array.from(now);
    const count = new Float32Array(now.length).fill(1);
    for (let f = 0; f + 2 < facets.length; f += 3) {
      for (const [from, to] of [
        [0, 1],
        [1, 2],
        [2, 0],
      ] as const) {
        const [a, b] = [facets[f + from] ?? 0, facets[f + to] ?? 0];
        sum[a] = (sum[a] ?? 0) + (now[b] ?? 0);
        sum[b] = (sum[b] ?? 0) + (now[a] ?? 0);
        count[a] = (count[a] ?? 0) + 1;
        count[b] = (count[b] ?? 0) + 1;
      }
    }
    now = sum.map((total, i) => total / (count[i] ?? 1));
  }
  return now;
}

export function dualQuaternion({ rotation, translationMm }: RigidMotion): DualQuaternion {
  const [x, y, z, w] = rotation;
  const [tx, ty, tz] = translationMm;
  return {
    real: rotation,
    dual: [
      0.5 * (tx * w + ty * z - tz * y),
      0.5 * (ty * w + tz * x - tx * z),
      0.5 * (tz * w + tx * y - ty * x),
      -0.5 * (tx * x + ty * y + tz * z),
    ],
  };
}

/** The point moved by both, the second by `weight`: what the skin's shader computes. */
export function blendedPoint(
  p: Vec3,
  first: DualQuaternion,
  second: DualQuaternion,
  weight: number,
): Vec3 {
  const dot = first.real.reduce((sum, v, i) => sum + v * (second.real[i] ?? 0), 0);
  const sign = dot < 0 ? -1 : 1;
  const mix = (a: Rotation, b: Rotation): number[] =>
    a.map((v, i) => (1 - weight) * v + weight * sign * (b[i] ?? 0));
  const real = mix(first.real, second.real);
  const size = Math.hypot(...real);
  const [x = 0, y = 0, z = 0, w = 1] = real.map((v) => v / size);
  const [dx = 0, dy = 0, dz = 0, dw = 0] = mix(first.dual, second.dual).map((v) => v / size);
  const cx = y * p[2] - z * p[1] + w * p[0];
  const cy = z * p[0] - x * p[2] + w * p[1];
  const cz = x * p[1] - y * p[0] + w * p[2];
  return [
    p[0] + 2 * (y * cz - z * cy) + 2 * (w * dx - dw * x + y * dz - z * dy),
    p[1] + 2 * (z * cx - x * cz) + 2 * (w * dy - dw * y + z * dx - x * dz),
    p[2] + 2 * (x * cy - y * cx) + 2 * (w * dz - dw * z + x * dy - y * dx),
  ];
}
