// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The inner wall of what was drilled. Method: 1. lines run along the track's side and across its
// ends; 2. each is clipped to where it lies within the bone; 3. strips between neighbours, so that the
// wall ends exactly on the bone's surface; 4. each point knows how far the nearest opening is: there light
// comes in, and the bone is hard.
import type { Track, Vec3 } from "../protocol";

/** More in one bone are not shown: a uniform array of the shader. */
export const MAX_TRACKS = 64;

/**
 * Before its start a track goes on by so many radii: surface that rises round an oblique mouth is
 * gone as well.
 */
export const MOUTH_RADII = 1.5;

/** Stretches of a line that lie within the bone, by distance from its origin [mm]. */
export type Clip = (
  origin: Vec3,
  direction: Vec3,
  lengthMm: number,
) => readonly (readonly [number, number])[];

/** Triangles turned to the inside of the tunnel. */
export interface TunnelWall {
  /** x, y, z per point [mm]. */
  readonly positions: Float32Array;
  /** Unit normals to the inside. */
  readonly normals: Float32Array;
  /** Light that comes in (0 to 1) and distance to the nearest opening [mm], per point. */
  readonly depths: Float32Array;
  readonly index: Uint32Array;
}

/** Around the track. */
const LINES = 64;
/** Along a line, in radii; at most. */
const STEP_RADII = 0.35;
const MAX_STEPS = 64;
/** Light falls off within the tunnel: half at about one radius. */
const LIGHT_FALL = 0.9;
/** An end this near to the line's own end is no opening [mm]. */
const END_MM = 1e-3;

interface Line {
  readonly origin: Vec3;
  readonly direction: Vec3;
  readonly lengthMm: number;
  /** To the inside. */
  readonly normal: Vec3;
  readonly stretches: readonly (readonly [number, number])[];
}

interface Grid {
  readonly positions: number[];
  readonly normals: number[];
  readonly depths: number[];
  readonly index: number[];
}

function along(origin: Vec3, direction: Vec3, mm: number): Vec3 {
  return [
    origin[0] + mm * direction[0],
    origin[1] + mm * direction[1],
    origin[2] + mm * direction[2],
  ];
}

function minus(a: Vec3, b: Vec3): Vec3 {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

function crossed(a: Vec3, b: Vec3): Vec3 {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

function unit(v: Vec3): Vec3 {
  const size = Math.hypot(...v);
  return [v[0] / size, v[1] / size, v[2] / size];
}

/** Two directions across `axis`, so that first, second and axis are right-handed. */
function across(axis: Vec3): [Vec3, Vec3] {
  const [x, y, z] = axis.map(Math.abs) as [number, number, number];
  const least: Vec3 = x <= y && x <= z ? [1, 0, 0] : y <= z ? [0, 1, 0] : [0, 0, 1];
  const first = unit(crossed(least, axis));
  return [first, crossed(axis, first)];
}

/** Distance of a point from the track's surface [mm], negative within: what the shader computes. */
export function outsideTrack(track: Track, p: Vec3): number {
  const axis = minus(track.to_mm, track.from_mm);
  const lengthMm = Math.hypot(...axis);
  if (!(lengthMm > 0)) return Infinity;
  const q = minus(p, track.from_mm);
  const s = (q[0] * axis[0] + q[1] * axis[1] + q[2] * axis[2]) / lengthMm;
  const radial = Math.hypot(...minus(q, along([0, 0, 0], axis, s / lengthMm)));
  const { from_radius_mm: r0, to_radius_mm: r1 } = track;
  const r = r0 + ((r1 - r0) * s) / lengthMm;
  return Math.max(radial - r, -MOUTH_RADII * r0 - s, s - lengthMm);
}

/** Whether a track can be shown: finite, of some length and radius. */
export function isTrack(track: Track): boolean {
  const numbers = [...track.from_mm, ...track.to_mm, track.from_radius_mm, track.to_radius_mm];
  return (
    numbers.every(Number.isFinite) &&
    Math.max(track.from_radius_mm, track.to_radius_mm) > 0 &&
    Math.min(track.from_radius_mm, track.to_radius_mm) >= 0 &&
    Math.hypot(...minus(track.to_mm, track.from_mm)) > 0
  );
}

/** @param clip  where a line lies within the bone */
export function tunnelWall(track: Track, clip: Clip): TunnelWall {
  const grid: Grid = { positions: [], normals: [], depths: [], index: [] };
  if (isTrack(track)) {
    const sides = sideLines(track, clip);
    const radius = Math.max(track.from_radius_mm, track.to_radius_mm);
    const sideLight = (line: Line, at: number): [number, number] => openness(line, at, radius);
    strips(grid, sides, radius, sideLight);
    const { start, startRadius } = mouth(track);
    const ends = [
      // Within the bone only where the track does not begin at its surface.
      { lines: endLines(track, start, startRadius, 1, clip), at: (): number => 0 },
      {
        lines: endLines(track, track.to_mm, track.to_radius_mm, -1, clip),
        at: (line: Line): number => line.lengthMm,
      },
    ];
    for (const { lines, at } of ends) {
      const lights = sides.map((line) => sideLight(line, at(line)));
      const mean = (pick: 0 | 1): number =>
        lights.reduce((sum, light) => sum + light[pick], 0) / lights.length;
      const light: [number, number] = [mean(0), mean(1)];
      strips(grid, lines, radius, () => light);
    }
  }
  return {
    positions: new Float32Array(grid.positions),
    normals: new Float32Array(grid.normals),
    depths: new Float32Array(grid.depths),
    index: new Uint32Array(grid.index),
  };
}

/** Where the track begins with its mouth. */
function mouth(track: Track): { readonly start: Vec3; readonly startRadius: number } {
  const { from_radius_mm: r0, to_radius_mm: r1 } = track;
  const axis = minus(track.to_mm, track.from_mm);
  const mouthMm = MOUTH_RADII * r0;
  return {
    start: along(track.from_mm, unit(axis), -mouthMm),
    startRadius: Math.max(0, r0 - ((r1 - r0) * mouthMm) / Math.hypot(...axis)),
  };
}

function sideLines(track: Track, clip: Clip): Line[] {
  const axis = unit(minus(track.to_mm, track.from_mm));
  const [u, v] = across(axis);
  const { start, startRadius } = mouth(track);
  return Array.from({ length: LINES }, (_, i) => {
    const angle = (2 * Math.PI * i) / LINES;
    const out = along(along([0, 0, 0], u, Math.cos(angle)), v, Math.sin(angle));
    const origin = along(start, out, startRadius);
    const reach = minus(along(track.to_mm, out, track.to_radius_mm), origin);
    const lengthMm = Math.hypot(...reach);
    const direction = unit(reach);
    return {
      origin,
      direction,
      lengthMm,
      // Across the line, in its plane with the axis.
      normal: unit(crossed(crossed(out, direction), direction)),
      stretches: clip(origin, direction, lengthMm),
    };
  });
}

/** Across one end of the track. @param facing 1 along the axis, -1 against it */
function endLines(track: Track, centre: Vec3, radius: number, facing: 1 | -1, clip: Clip): Line[] {
  const axis = unit(minus(track.to_mm, track.from_mm));
  const [u, v] = across(axis);
  if (!(radius > 0)) return [];
  return Array.from({ length: LINES }, (_, i) => {
    const angle = (-facing * 2 * Math.PI * i) / LINES;
    // From the rim inwards, the way round that turns the strips to where the end faces.
    const direction = along(along([0, 0, 0], u, -Math.cos(angle)), v, -Math.sin(angle));
    const origin = along(centre, direction, -radius);
    return {
      origin,
      direction,
      lengthMm: radius,
      normal: along([0, 0, 0], axis, facing),
      stretches: clip(origin, direction, radius),
    };
  });
}

/** Light and distance of the nearest opening at `at` on the line. */
function openness(line: Line, at: number, radius: number): [number, number] {
  let nearest = Infinity;
  for (const [from, to] of line.stretches) {
    if (at < from - END_MM || at > to + END_MM) continue;
    if (from > END_MM) nearest = Math.min(nearest, at - from);
    if (to < line.lengthMm - END_MM) nearest = Math.min(nearest, to - at);
  }
  if (nearest === Infinity) return [0, line.lengthMm];
  const mm = Math.max(0, nearest);
  const far = (LIGHT_FALL * mm) / radius;
  return [1 / (1 + far * far), mm];
}

/** Strips between neighbouring lines, wherever stretches of both run side by side. */
function strips(
  grid: Grid,
  lines: readonly Line[],
  radius: number,
  light: (line: Line, at: number) => [number, number],
): void {
  // The same everywhere: neighbouring strips share all points of the line between them.
  const longest = Math.max(0, ...lines.flatMap((l) => l.stretches.map(([from, to]) => to - from)));
  const steps = Math.min(MAX_STEPS, Math.max(1, Math.ceil(longest / (STEP_RADII * radius))));
  const firsts = lines.map((line) =>
    line.stretches.map((stretch) => layPoints(grid, line, stretch, steps, light)),
  );
  lines.forEach((line, i) => {
    const j = (i + 1) % lines.length;
    line.stretches.forEach((a, k) => {
      lines[j]?.stretches.forEach((b, l) => {
        if (Math.min(a[1], b[1]) <= Math.max(a[0], b[0])) return;
        const [here, there] = [firsts[i]?.[k] ?? 0, firsts[j]?.[l] ?? 0];
        for (let step = 0; step < steps; ++step) {
          const [p, q] = [here + step, there + step];
          grid.index.push(p, p + 1, q, q, p + 1, q + 1);
        }
      });
    });
  });
}

/** @return index of the first of `steps + 1` points */
function layPoints(
  grid: Grid,
  line: Line,
  [from, to]: readonly [number, number],
  steps: number,
  light: (line: Line, at: number) => [number, number],
): number {
  const first = grid.positions.length / 3;
  for (let k = 0; k <= steps; ++k) {
    const at = from + ((to - from) * k) / steps;
    grid.positions.push(...along(line.origin, line.direction, at));
    grid.normals.push(...line.normal);
    grid.depths.push(...light(line, at));
  }
  return first;
}
