// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The three planes, laid along the wrist or as the scanner lay: what is right and down on the screen, and
// the words at a picture's edges. Coronal as a PA film: from dorsal, distal up. As scanned: radiological
// convention, the patient's right on the left.
import type { Vec3 } from "../protocol";

export type PlaneId = "axial" | "coronal" | "sagittal";
export const PLANE_IDS: readonly PlaneId[] = ["axial", "coronal", "sagittal"];
export type Alignment = "wrist" | "scan";

export interface EdgeWords {
  readonly right: string;
  readonly left: string;
  readonly up: string;
  readonly down: string;
}

/** Unit vectors of Patient, orthogonal; away = right x down points into the screen. */
export interface Plane {
  readonly id: PlaneId;
  readonly right: Vec3;
  readonly down: Vec3;
  readonly away: Vec3;
  readonly words: EdgeWords;
}

export const dot = (a: Vec3, b: Vec3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a: Vec3, b: Vec3): Vec3 => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
/** a + s b */
export const along = (a: Vec3, s: number, b: Vec3): Vec3 => [
  a[0] + s * b[0],
  a[1] + s * b[1],
  a[2] + s * b[2],
];

function plane(id: PlaneId, right: Vec3, down: Vec3, words: readonly string[]): Plane {
  const [r = "", l = "", u = "", d = ""] = words;
  return {
    id,
    right,
    down,
    away: cross(right, down),
    words: { right: r, left: l, up: u, down: d },
  };
}

/** @param wristFromPatient three rows: +x proximal, +z volar, +y ulnar on a left wrist, else radial. */
export function planesOf(
  alignment: Alignment,
  wristFromPatient: readonly Vec3[],
  side: "left" | "right",
): Readonly<Record<PlaneId, Plane>> {
  const [x, y, z] = alignment === "wrist" ? wristFromPatient : SCAN;
  if (x === undefined || y === undefined || z === undefined) throw new Error("no planes");
  const opposite = (v: Vec3): Vec3 => [-v[0], -v[1], -v[2]];
  if (alignment === "scan") {
    const up = opposite(z);
    return {
      axial: plane("axial", x, y, ["Left", "Right", "Anterior", "Posterior"]),
      coronal: plane("coronal", x, up, ["Left", "Right", "Superior", "Inferior"]),
      sagittal: plane("sagittal", y, up, ["Posterior", "Anterior", "Superior", "Inferior"]),
    };
  }
  const across = side === "left" ? ["Radial", "Ulnar"] : ["Ulnar", "Radial"];
  return {
    axial: plane("axial", opposite(y), z, [...across, "Dorsal", "Volar"]),
    coronal: plane("coronal", opposite(y), x, [...across, "Distal", "Proximal"]),
    sagittal: plane("sagittal", z, x, ["Volar", "Dorsal", "Distal", "Proximal"]),
  };
}

const SCAN: readonly Vec3[] = [
  [1, 0, 0],
  [0, 1, 0],
  [0, 0, 1],
];
