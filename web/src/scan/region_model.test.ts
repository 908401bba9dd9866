// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import type { Vec3 } from "../protocol";
import { inverted, type Volume } from "./nifti_model";
import { measureRegion, regionLines, regionOf, regionText } from "./region_model";

const SIDE = 24;

/** 0.5 x 0.5 x 1 mm, off the origin. */
function ct(value: (x: number, y: number, z: number) => number): Volume {
  const values = new Int16Array(SIDE ** 3);
  values.forEach((_, i) => {
    values[i] = value(i % SIDE, Math.floor(i / SIDE) % SIDE, Math.floor(i / SIDE ** 2));
  });
  const rows = [0.5, 0, 0, 3, 0, 0.5, 0, -4, 0, 0, 1, 7];
  const head = new Uint8Array(352);
  const size = [SIDE, SIDE, SIDE] as const;
  return { size, patientFromVoxel: rows, voxelFromPatient: inverted(rows), values, head };
}

const middle: Vec3 = [9, 2, 19];
const axial: Vec3 = [0, 0, 1];
const slanted: Vec3 = [0.6, 0, 0.8];

/** All voxels one by one. */
function slowly(volume: Volume, centre: Vec3, radius: number, away: Vec3): readonly number[] {
  const half = (0.5 * Math.abs(away[0]) + 0.5 * Math.abs(away[1]) + Math.abs(away[2])) / 2;
  const inside: number[] = [];
  volume.values.forEach((hu, i) => {
    const place = [
      3 + 0.5 * (i % SIDE),
      -4 + 0.5 * (Math.floor(i / SIDE) % SIDE),
      7 + Math.floor(i / SIDE ** 2),
    ];
    const d = place.map((v, axis) => v - (centre[axis] ?? 0));
    const off = d.reduce((sum, v, axis) => sum + v * (away[axis] ?? 0), 0);
    const flat = d.reduce((sum, v) => sum + v * v, 0) - off * off;
    if (Math.abs(off) < half - 1e-9 && flat <= radius * radius) inside.push(hu);
  });
  return inside;
}

describe("HU of a region", () => {
  it("are those of one layer where the slice lies along the scanner's", () => {
    const volume = ct((_x, _y, z) => 100 * z);
    for (const z of [18.6, 19, 19.4]) {
      const values = measureRegion(volume, { centre: [9, 2, z], radiusMm: 3, away: axial });
      expect(values.mean).toBe(1200);
      expect(values.sd).toBe(0);
      // pi 9 mm2 of 0.25 mm2.
      expect(values.voxels).toBeGreaterThan(105);
      expect(values.voxels).toBeLessThan(121);
    }
    // Between two layers it is one of them, not both and not none.
    const between = measureRegion(volume, { centre: [9, 2, 19.5], radiusMm: 3, away: axial });
    expect(between.sd).toBe(0);
    expect([1200, 1300]).toContain(between.mean);
  });
  it("are those of the voxels that an oblique slice goes through", () => {
    const volume = ct((x, y, z) => ((x * 7919 + y * 104729 + z * 1299709) % 2000) - 500);
    for (const radius of [0.8, 2.7, 5]) {
      const all = slowly(volume, middle, radius, slanted);
      const mean = all.reduce((sum, v) => sum + v, 0) / all.length;
      const sd = Math.sqrt(all.reduce((sum, v) => sum + (v - mean) ** 2, 0) / (all.length - 1));
      const values = measureRegion(volume, { centre: middle, radiusMm: radius, away: slanted });
      expect(values.voxels).toBe(all.length);
      expect(values.mean).toBeCloseTo(mean, 8);
      expect(values.sd).toBeCloseTo(sd, 8);
    }
  });
  it("end with the scan, and are none outside it", () => {
    const volume = ct(() => 40);
    const corner = measureRegion(volume, { centre: [3, -4, 7], radiusMm: 3, away: axial });
    expect(corner.voxels).toBeGreaterThan(25);
    expect(corner.voxels).toBeLessThan(40);
    const out = { centre: [100, 100, 7] as const, radiusMm: 3, away: axial };
    const none = measureRegion(volume, out);
    expect(none.voxels).toBe(0);
    expect(regionLines(out, none)).toEqual(["r 3.0 mm, 0 voxels"]);
    expect(regionText(out, none)).toContain("no voxels of the scan");
  });
  it("have a radius as it is seen, and no spread where there is one voxel", () => {
    expect(regionOf([0, 0, 0], [3, 4, 9], axial).radiusMm).toBe(5);
    const one = { centre: middle, radiusMm: 0.2, away: axial };
    const values = measureRegion(
      ct(() => 512),
      one,
    );
    expect(values.voxels).toBe(1);
    expect(regionLines(one, values)).toEqual(["512 HU", "r 0.2 mm, 1 voxel"]);
    expect(regionText(one, values)).toBe("Circle of radius 0.2 mm: mean 512 HU, 1 voxel");
  });
});
