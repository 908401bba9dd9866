// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The one place that knows both frames. Patient: LPS, mm. Renderer: metres, Y up, seen from +Z.
//
// The wrist frame (docs/units_and_frames.md) is +x proximal, +z volar, +y ulnar on a left wrist and
// radial on a right one; here always that of the forearm as scanned, which is how the room stands. The
// renderer's axes are laid along it so that the camera looks as the C-arm does in PA, from dorsal
// with distal up: Y = distal = -x, Z = dorsal = -z, X = Y x Z = -y. A rotation, never a reflection:
// a left hand's thumb is on the right.
import type { Vec3 } from "../protocol";

const METRES_PER_MM = 0.001;

/** 16 numbers, column by column, as three.js takes them. */
export type Matrix16 = readonly number[];

/** @param wristFromPatient 4 x 4, row by row, rigid, mm. */
export function rendererFromPatient(wristFromPatient: readonly number[]): Matrix16 {
  if (wristFromPatient.length !== 16 || !wristFromPatient.every(Number.isFinite)) {
    throw new Error("wrist_from_patient must hold 16 finite numbers");
  }
  const row = (r: number): number[] =>
    [0, 1, 2, 3].map((c) => -METRES_PER_MM * (wristFromPatient[4 * r + c] ?? 0));
  const [x, y, z] = [row(1), row(0), row(2)];
  const matrix: number[] = [];
  for (let c = 0; c < 4; ++c) {
    matrix.push(x[c] ?? 0, y[c] ?? 0, z[c] ?? 0, c === 3 ? 1 : 0);
  }
  return matrix;
}

/** Renderer metres to Patient mm, and back, for points and directions. */
export interface FrameMap {
  readonly matrix: Matrix16;
  /** A point of the renderer [m] in Patient [mm]. */
  pointToPatient(x: number, y: number, z: number): Vec3;
  /** A point of Patient [mm] in the renderer [m]. */
  pointToRenderer(mm: Vec3): Vec3;
  /** A direction of the renderer in Patient; keeps its length. */
  directionToPatient(x: number, y: number, z: number): Vec3;
  /** A direction of Patient in the renderer; keeps its length. */
  directionToRenderer(v: Vec3): Vec3;
}

export function makeFrameMap(wristFromPatient: readonly number[]): FrameMap {
  const m = rendererFromPatient(wristFromPatient);
  const at = (i: number): number => m[i] ?? 0;
  const direction = (x: number, y: number, z: number): Vec3 => {
    const scale = 1 / METRES_PER_MM;
    return [
      scale * (at(0) * x + at(1) * y + at(2) * z),
      scale * (at(4) * x + at(5) * y + at(6) * z),
      scale * (at(8) * x + at(9) * y + at(10) * z),
    ];
  };
  return {
    matrix: m,
    directionToPatient: direction,
    pointToPatient(x, y, z) {
      const d = direction(x - at(12), y - at(13), z - at(14));
      return [d[0] / METRES_PER_MM, d[1] / METRES_PER_MM, d[2] / METRES_PER_MM];
    },
    pointToRenderer([x, y, z]) {
      return [
        at(0) * x + at(4) * y + at(8) * z + at(12),
        at(1) * x + at(5) * y + at(9) * z + at(13),
        at(2) * x + at(6) * y + at(10) * z + at(14),
      ];
    },
    directionToRenderer(v) {
      const scale = 1 / METRES_PER_MM;
      return [
        scale * (at(0) * v[0] + at(4) * v[1] + at(8) * v[2]),
        scale * (at(1) * v[0] + at(5) * v[1] + at(9) * v[2]),
        scale * (at(2) * v[0] + at(6) * v[1] + at(10) * v[2]),
      ];
    },
  };
}

export type AnatomicalSide = "Dorsal" | "Radial" | "Volar" | "Ulnar" | "Proximal" | "Distal";

export interface FaceNames {
  readonly right: AnatomicalSide;
  readonly left: AnatomicalSide;
  readonly up: AnatomicalSide;
  readonly down: AnatomicalSide;
  readonly front: AnatomicalSide;
  readonly back: AnatomicalSide;
}

const FACE_AXES: Readonly<Record<keyof FaceNames, Vec3>> = {
  right: [1, 0, 0],
  left: [-1, 0, 0],
  up: [0, 1, 0],
  down: [0, -1, 0],
  front: [0, 0, 1],
  back: [0, 0, -1],
};

/** Anatomical names of the six sides of the renderer's frame. */
export function faceNames(side: "left" | "right"): FaceNames {
  const radialIsRight = side === "left";
  return {
    right: radialIsRight ? "Radial" : "Ulnar",
    left: radialIsRight ? "Ulnar" : "Radial",
    up: "Distal",
    down: "Proximal",
    front: "Dorsal",
    back: "Volar",
  };
}

/** Unit vector of the renderer towards the side of this name. */
export function towards(side: AnatomicalSide, names: FaceNames): Vec3 {
  for (const face of Object.keys(FACE_AXES) as (keyof FaceNames)[]) {
    if (names[face] === side) return FACE_AXES[face];
  }
  throw new Error(`no face is named ${side}`);
}
