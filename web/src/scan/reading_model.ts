// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What lies at a place of a scan: HU, bone, coordinates.
import type { Vec3 } from "../protocol";
import { nameOfLabel } from "./bones_now_model";
import { voxelIndexAt, type Volume } from "./nifti_model";
import { boneTitle } from "./scan_case_model";

/** @return 0 where no bone lies, and beyond the labels */
export function labelAt(labels: Volume | undefined, mm: Vec3): number {
  const at = labels === undefined ? -1 : voxelIndexAt(labels, mm);
  return at < 0 ? 0 : (labels?.values[at] ?? 0);
}

/** "412 HU · Hamate · 17.4, -3.3, 28.1 mm" @param count  how many voxels have a label now */
export function readingAt(
  ct: Volume,
  labels: Volume | undefined,
  mm: Vec3,
  count: (label: number) => number,
): string {
  const at = voxelIndexAt(ct, mm);
  if (at < 0) return "outside the scan";
  const label = labelAt(labels, mm);
  const bone = label === 0 ? "no bone" : boneTitle(nameOfLabel(label, count));
  const place = mm.map((v) => v.toFixed(1)).join(", ");
  return `${ct.values[at] ?? 0} HU · ${bone} · ${place} mm`;
}
