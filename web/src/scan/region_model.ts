// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Hounsfield units of a round region of a slice: mean, standard deviation and how many voxels they are of. The
// voxels are those that the slice goes through and whose middles lie in the circle: of a slice along the scanner's
// one layer, of an oblique one those that it touches.
import type { Vec3 } from "../protocol";
import { applied, type Volume } from "./nifti_model";
import { along, dot } from "./planes_model";

export interface Region {
  /** Patient mm. */
  readonly centre: Vec3;
  readonly radiusMm: number;
  /** Across the slice, a unit vector of Patient. */
  readonly away: Vec3;
}

export interface RegionValues {
  readonly voxels: number;
  /** HU; NaN where there are no voxels. */
  readonly mean: number;
  /** Of the voxels as a sample (n - 1) [HU]; NaN of fewer than two. */
  readonly sd: number;
}

const AXES = [0, 1, 2] as const;

/** @param rim  a place on the circle, as seen along `away` */
export function regionOf(centre: Vec3, rim: Vec3, away: Vec3): Region {
  const d = along(rim, -1, centre);
  const flat = along(d, -dot(d, away), away);
  return { centre, radiusMm: Math.sqrt(dot(flat, flat)), away };
}

export function measureRegion(ct: Volume, { centre, radiusMm, away }: Region): RegionValues {
  const m = ct.patientFromVoxel;
  const column = (axis: number): Vec3 => [m[axis] ?? 0, m[4 + axis] ?? 0, m[8 + axis] ?? 0];
  // How far one voxel on goes across the slice.
  const steps = AXES.map((axis) => dot(column(axis), away));
  const half = steps.reduce((sum, step) => sum + Math.abs(step), 0) / 2;
  const steepest = AXES.reduce((best, axis) =>
    Math.abs(steps[axis] ?? 0) > Math.abs(steps[best] ?? 0) ? axis : best,
  );
  const [u, v] = AXES.filter((axis) => axis !== steepest) as [0 | 1 | 2, 0 | 1 | 2];
  const middle = applied(ct.voxelFromPatient, centre);
  const range = (axis: 0 | 1 | 2): readonly [number, number] => {
    const row = ct.voxelFromPatient.slice(4 * axis, 4 * axis + 3) as unknown as Vec3;
    const reach = (radiusMm + half) * Math.sqrt(dot(row, row)) + 1;
    return [
      Math.max(0, Math.ceil(middle[axis] - reach)),
      Math.min(ct.size[axis] - 1, Math.floor(middle[axis] + reach)),
    ];
  };
  const [us, vs] = [range(u), range(v)];
  const step = steps[steepest] ?? 0;
  let [voxels, mean, squares] = [0, 0, 0];
  const voxel: [number, number, number] = [0, 0, 0];
  for (voxel[u] = us[0]; voxel[u] <= us[1]; ++voxel[u]) {
    for (voxel[v] = vs[0]; voxel[v] <= vs[1]; ++voxel[v]) {
      voxel[steepest] = 0;
      const base = dot(along(applied(m, voxel), -1, centre), away);
      // Half a voxel on each side; of two layers that the slice lies between, one.
      const ends = [(-half - base) / step, (half - base) / step].sort((p, q) => p - q);
      const low = Math.max(0, Math.floor((ends[0] ?? 0) + 1e-9) + 1);
      const high = Math.min(ct.size[steepest] - 1, Math.floor((ends[1] ?? 0) + 1e-9));
      for (voxel[steepest] = low; voxel[steepest] <= high; ++voxel[steepest]) {
        const d = along(applied(m, voxel), -1, centre);
        const across = dot(d, away);
        if (dot(d, d) - across * across > radiusMm * radiusMm) continue;
        const [x, y, z] = voxel;
        const hu = ct.values[(z * ct.size[1] + y) * ct.size[0] + x] ?? 0;
        // Welford's way: no sum that grows.
        const by = hu - mean;
        mean += by / ++voxels;
        squares += by * (hu - mean);
      }
    }
  }
  return {
    voxels,
    mean: voxels > 0 ? mean : NaN,
    sd: voxels > 1 ? Math.sqrt(squares / (voxels - 1)) : NaN,
  };
}

/** "512 ± 88 HU", "r 3.2 mm, 214 voxels" */
export function regionLines(region: Region, { voxels, mean, sd }: RegionValues): readonly string[] {
  const size = `r ${region.radiusMm.toFixed(1)} mm, ${voxels} voxel${voxels === 1 ? "" : "s"}`;
  if (voxels === 0) return [size];
  const hu = mean.toFixed(0);
  return [Number.isNaN(sd) ? `${hu} HU` : `${hu} ± ${sd.toFixed(0)} HU`, size];
}

/** For who listens: what the figures are. */
export function regionText(region: Region, { voxels, mean, sd }: RegionValues): string {
  const circle = `Circle of radius ${region.radiusMm.toFixed(1)} mm`;
  if (voxels === 0) return `${circle}: no voxels of the scan`;
  const spread = Number.isNaN(sd) ? "" : `, SD ${sd.toFixed(0)} HU`;
  return `${circle}: mean ${mean.toFixed(0)} HU${spread}, ${voxels} voxel${voxels === 1 ? "" : "s"}`;
}
