// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The wall ends on the bone's surface, faces its axis, and is bright at its openings only.
import { describe, expect, it } from "vitest";
import type { Track, Vec3 } from "../protocol";
import { isTrack, outsideTrack, tunnelWall, type Clip } from "./tunnel_model";

/** Bone between z = -10 and 0, without sides. */
const slab: Clip = (origin, direction, lengthMm) => {
  const [z, dz] = [origin[2], direction[2]];
  if (Math.abs(dz) < 1e-12) return z <= 0 && z >= -10 ? [[0, lengthMm]] : [];
  const cuts = [-z / dz, (-10 - z) / dz].sort((a, b) => a - b);
  const from = Math.max(0, cuts[0] ?? 0);
  const to = Math.min(lengthMm, cuts[1] ?? 0);
  return to > from ? [[from, to]] : [];
};

function track(to: Vec3, more: Partial<Track> = {}): Track {
  return {
    body: "scaphoid",
    from_mm: [0, 0, 0],
    to_mm: to,
    from_radius_mm: 2,
    to_radius_mm: 2,
    ...more,
  };
}

function points(array: Float32Array): Vec3[] {
  return Array.from({ length: array.length / 3 }, (_, i) => [
    array[3 * i] ?? 0,
    array[3 * i + 1] ?? 0,
    array[3 * i + 2] ?? 0,
  ]);
}

const dot = (a: Vec3, b: Vec3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

describe("tunnelWall", () => {
  const oblique = track([3, 0, -6]);

  it.each([
    ["straight", track([0, 0, -6])],
    ["oblique", oblique],
    ["tapered", track([0, 0, -6], { to_radius_mm: 1 })],
    ["through and through", track([0, 0, -14])],
  ])("lies on a %s track and nowhere outside the bone", (_, one) => {
    const wall = tunnelWall(one, slab);
    expect(wall.index.length).toBeGreaterThan(300);
    expect(Math.max(...wall.index)).toBe(wall.positions.length / 3 - 1);
    for (const p of points(wall.positions)) {
      expect(p[2]).toBeLessThan(1e-4);
      expect(p[2]).toBeGreaterThan(-10 - 1e-4);
      expect(outsideTrack(one, p)).toBeLessThan(1e-4);
      expect(outsideTrack(one, p)).toBeGreaterThan(-2.01);
    }
  });

  it("reaches the surface all round an oblique mouth", () => {
    const rim = points(tunnelWall(oblique, slab).positions).filter((p) => Math.abs(p[2]) < 1e-4);
    const angles = new Set(rim.map((p) => Math.round((Math.atan2(p[1], p[0]) * 8) / Math.PI)));
    expect(angles.size).toBeGreaterThanOrEqual(16);
  });

  it("has a bottom where it ends within the bone, and none where it goes through", () => {
    const up = (one: Track): number =>
      points(tunnelWall(one, slab).normals).filter((n) => n[2] > 0.99).length;
    expect(up(track([0, 0, -6]))).toBeGreaterThan(60);
    expect(up(track([0, 0, -14]))).toBe(0);
  });

  it("has no cracks: each edge within it is shared by two triangles", () => {
    const wall = tunnelWall(oblique, slab);
    const name = (i: number): string =>
      [0, 1, 2].map((k) => Math.round(1e4 * (wall.positions[3 * i + k] ?? 0))).join(" ");
    const faces = new Map<string, number>();
    for (let i = 0; i < wall.index.length; i += 3) {
      const corners = [0, 1, 2].map((k) => name(wall.index[i + k] ?? 0));
      if (new Set(corners).size < 3) continue;
      corners.forEach((a, k) => {
        const edge = [a, corners[(k + 1) % 3] ?? ""].sort().join(" to ");
        faces.set(edge, (faces.get(edge) ?? 0) + 1);
      });
    }
    const open = [...faces].filter(([, count]) => count !== 2).map(([edge]) => edge);
    const atSurface = open.filter((edge) => / 0 to .* 0$/.test(edge));
    expect(atSurface.length).toBeGreaterThan(60);
    expect(open.filter((edge) => !atSurface.includes(edge))).toEqual([]);
  });

  it("is closed where the track begins within the bone", () => {
    const within = tunnelWall(track([0, 0, -8], { from_mm: [0, 0, -5] }), slab);
    const z = points(within.positions).map((p) => p[2]);
    const faces = (sign: number): number =>
      points(within.normals).filter((n, i) => sign * n[2] > 0.99 && z[i] === (sign > 0 ? -8 : -2))
        .length;
    expect(faces(1)).toBeGreaterThan(60);
    expect(faces(-1)).toBeGreaterThan(60);
  });

  it("turns its triangles and normals to the axis", () => {
    const wall = tunnelWall(oblique, slab);
    const [p, n] = [points(wall.positions), points(wall.normals)];
    const minus = (a: Vec3, b: Vec3): Vec3 => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    const middle: Vec3 = [1.5, 0, -3];
    for (let i = 0; i < wall.index.length; i += 3) {
      const [a, b, c] = [0, 1, 2].map((k) => wall.index[i + k] ?? 0) as [number, number, number];
      const [pa, pb, pc] = [p[a], p[b], p[c]] as [Vec3, Vec3, Vec3];
      const [u, v] = [minus(pb, pa), minus(pc, pa)];
      const face: Vec3 = [
        u[1] * v[2] - u[2] * v[1],
        u[2] * v[0] - u[0] * v[2],
        u[0] * v[1] - u[1] * v[0],
      ];
      if (Math.hypot(...face) < 1e-6) continue; // the bottom's middle
      expect(dot(face, n[a] ?? [0, 0, 0])).toBeGreaterThan(0);
      expect(dot(minus(middle, pa), n[a] ?? [0, 0, 0])).toBeGreaterThan(0);
    }
  });

  it("is bright at the mouth, dark at the bottom, and lit from both ends where it goes through", () => {
    const lights = (one: Track, z: number): number[] => {
      const wall = tunnelWall(one, slab);
      return points(wall.positions).flatMap((p, i) =>
        Math.abs(p[2] - z) < 1e-3 ? [wall.depths[2 * i] ?? NaN] : [],
      );
    };
    const deep = track([0, 0, -9]);
    expect(Math.min(...lights(deep, 0))).toBeCloseTo(1, 5);
    expect(Math.max(...lights(deep, -9))).toBeLessThan(0.1);
    const through = lights(track([0, 0, -14]), -10);
    expect(Math.min(...through)).toBeCloseTo(1, 5);
  });

  it("is empty beside the bone and for a track that is none", () => {
    expect(tunnelWall(track([0, 0, 9], { from_mm: [0, 0, 5] }), slab).index.length).toBe(0);
    expect(tunnelWall(track([0, 0, 0]), slab).index.length).toBe(0);
  });
});

describe("isTrack", () => {
  it.each([
    ["without length", track([0, 0, 0])],
    ["that is not finite", track([0, NaN, 1])],
    ["without radius", track([0, 0, 1], { from_radius_mm: 0, to_radius_mm: 0 })],
    ["of a negative radius", track([0, 0, 1], { to_radius_mm: -1 })],
  ])("refuses one %s", (_, one) => {
    expect(isTrack(one)).toBe(false);
  });

  it("takes one with a point", () => {
    expect(isTrack(track([0, 0, -6], { to_radius_mm: 0 }))).toBe(true);
  });
});

describe("outsideTrack", () => {
  const one = track([0, 0, -10], { to_radius_mm: 1 });
  it.each([
    [[0, 0, -5], -1.5],
    [[2, 0, -5], 0.5],
    [[0, 0, -12], 2],
    [[0, 0, 4], 1],
    [[1, 0, 2], -1],
  ] as const)("of %j is %f mm", (p, mm) => {
    expect(outsideTrack(one, p)).toBeCloseTo(mm, 6);
  });
});
