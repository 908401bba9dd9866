// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where the bones are cut open: along the line that the procedure is after, turned about it towards the
// viewer, or through a point at right angles to the line of sight. What is nearer to the viewer is taken
// away. Pure.
import type { Vec3 } from "../protocol";

export const CUTS = ["off", "axis", "camera"] as const;
export type Cut = (typeof CUTS)[number];

export function nextCut(cut: Cut): Cut {
  return CUTS[(CUTS.indexOf(cut) + 1) % CUTS.length] ?? "off";
}

/** Points p with normal · p + constant < 0 are taken away. */
export interface CutPlane {
  readonly normal: Vec3;
  readonly constant: number;
}

function dot(a: Vec3, b: Vec3): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

function unit(v: Vec3): Vec3 | undefined {
  const size = Math.sqrt(dot(v, v));
  return size > 1e-6 ? [v[0] / size, v[1] / size, v[2] / size] : undefined;
}

/**
 * @param through  a point of the plane
 * @param sight  unit, from the viewer into the scene
 * @param axis  unit, lies in the plane; undefined for a plane across the line of sight
 * @return nothing while the viewer looks along the axis: no plane is the right one
 */
export function cutPlane(through: Vec3, sight: Vec3, axis: Vec3 | undefined): CutPlane | undefined {
  const along = axis === undefined ? 0 : dot(sight, axis);
  const [x, y, z] = axis ?? [0, 0, 0];
  const normal = unit([sight[0] - along * x, sight[1] - along * y, sight[2] - along * z]);
  if (normal === undefined) return undefined;
  return { normal, constant: -dot(normal, through) };
}
