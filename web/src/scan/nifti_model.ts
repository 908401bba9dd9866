// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A volume as a case folder holds it: NIfTI-1, one file, int16 or uint8, with an sform. Its places are
// told in the Patient frame (LPS, mm); NIfTI itself counts in RAS.
import type { Vec3 } from "../protocol";

export interface Volume {
  readonly size: readonly [number, number, number];
  /** 3 x 4, row by row: voxel indices to Patient mm. */
  readonly patientFromVoxel: readonly number[];
  /** 3 x 4, row by row: Patient mm to voxel indices. */
  readonly voxelFromPatient: readonly number[];
  readonly values: Int16Array | Uint8Array;
  /** What stands in the file before the values. */
  readonly head: Uint8Array;
}

const HEADER = 348;
const TYPE_UINT8 = 2;
const TYPE_INT16 = 4;
/** As the host's readers have it. */
const MOST_VOXELS = 2 ** 30;

/** Of one voxel [mm3]. */
export function voxelVolume({ patientFromVoxel: m }: Volume): number {
  const [a = 0, b = 0, c = 0, , d = 0, e = 0, f = 0, , g = 0, h = 0, i = 0] = m;
  return Math.abs(a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g));
}

export function parseNifti(bytes: ArrayBuffer): Volume {
  if (bytes.byteLength < HEADER + 4) throw new Error("the volume is cut off");
  const view = new DataView(bytes);
  if (view.getInt32(0, true) !== HEADER || view.getUint32(344) !== 0x6e2b3100) {
    throw new Error("the volume is no NIfTI-1 file of this station");
  }
  const size: [number, number, number] = [0, 1, 2].map((i) => view.getInt16(42 + 2 * i, true)) as [
    number,
    number,
    number,
  ];
  const count = size[0] * size[1] * size[2];
  if (!size.every((n) => n > 0) || count > MOST_VOXELS) throw new Error("the volume has no size");
  const type = view.getInt16(70, true);
  const begin = view.getFloat32(108, true);
  const width = type === TYPE_INT16 ? 2 : 1;
  if (type !== TYPE_INT16 && type !== TYPE_UINT8) {
    throw new Error(`the volume's values are of type ${type}; int16 and uint8 are read`);
  }
  if (!(begin >= HEADER) || bytes.byteLength < begin + count * width) {
    throw new Error("the volume is cut off");
  }
  const rows = sformRows(view);
  const values =
    type === TYPE_INT16 ? shorts(bytes, begin, count) : new Uint8Array(bytes, begin, count);
  const head = new Uint8Array(bytes.slice(0, begin));
  return { size, patientFromVoxel: rows, voxelFromPatient: inverted(rows), values, head };
}

/** The file again, with the labels as they are now. */
export function niftiOf({ head, values }: Volume): Uint8Array<ArrayBuffer> {
  if (!(values instanceof Uint8Array)) throw new Error("labels are uint8");
  const bytes = new Uint8Array(head.length + values.length);
  bytes.set(head);
  bytes.set(values, head.length);
  return bytes;
}

function sformRows(view: DataView): number[] {
  if (view.getInt16(254, true) <= 0) throw new Error("the volume does not say where it lies");
  const rows: number[] = [];
  for (let i = 0; i < 12; ++i) {
    const ras = view.getFloat32(280 + 4 * i, true);
    rows.push(i < 8 ? -ras : ras);
  }
  if (!rows.every(Number.isFinite)) throw new Error("the volume does not say where it lies");
  return rows;
}

/** Little-endian as the file, whatever the machine is. */
function shorts(bytes: ArrayBuffer, begin: number, count: number): Int16Array {
  const littleEndian = new Uint8Array(new Uint16Array([1]).buffer)[0] === 1;
  if (littleEndian) return new Int16Array(bytes.slice(begin, begin + 2 * count));
  const view = new DataView(bytes, begin);
  return Int16Array.from({ length: count }, (_, i) => view.getInt16(2 * i, true));
}

/** Of an affine map, 3 x 4 row by row. */
export function inverted(m: readonly number[]): number[] {
  const at = (r: number, c: number): number => m[4 * r + c] ?? 0;
  const minor = (r: number, c: number): number => {
    const [r1, r2, c1, c2] = [(r + 1) % 3, (r + 2) % 3, (c + 1) % 3, (c + 2) % 3];
    return at(r1, c1) * at(r2, c2) - at(r1, c2) * at(r2, c1);
  };
  const det = at(0, 0) * minor(0, 0) + at(0, 1) * minor(0, 1) + at(0, 2) * minor(0, 2);
  if (!Number.isFinite(1 / det)) throw new Error("the volume's grid is flat");
  const result: number[] = [];
  for (let r = 0; r < 3; ++r) {
    const row = [0, 1, 2].map((c) => minor(c, r) / det);
    const shift = row.reduce((sum, value, c) => sum + value * at(c, 3), 0);
    result.push(...row, -shift);
  }
  return result;
}

export function applied(m: readonly number[], p: Vec3): Vec3 {
  const row = (r: number): number =>
    (m[4 * r] ?? 0) * p[0] +
    (m[4 * r + 1] ?? 0) * p[1] +
    (m[4 * r + 2] ?? 0) * p[2] +
    (m[4 * r + 3] ?? 0);
  return [row(0), row(1), row(2)];
}

/** Index of the voxel in whose box a place of the patient lies; -1 outside the volume. */
export function voxelIndexAt(volume: Volume, mm: Vec3): number {
  const [x, y, z] = applied(volume.voxelFromPatient, mm).map(Math.round) as [
    number,
    number,
    number,
  ];
  const [w, h, d] = volume.size;
  if (x < 0 || y < 0 || z < 0 || x >= w || y >= h || z >= d) return -1;
  return (z * h + y) * w + x;
}

/** The corners' box of a volume, seen along an axis: least and greatest place on it [mm]. */
export function extentAlong(volume: Volume, axis: Vec3): readonly [number, number] {
  let low = Infinity;
  let high = -Infinity;
  for (let corner = 0; corner < 8; ++corner) {
    const index = volume.size.map((n, i) => ((corner >> i) & 1) * (n - 1)) as unknown as Vec3;
    const p = applied(volume.patientFromVoxel, index);
    const along = p[0] * axis[0] + p[1] * axis[1] + p[2] * axis[2];
    low = Math.min(low, along);
    high = Math.max(high, along);
  }
  return [low, high];
}

/** The middle of the volume [mm]. */
export function middleOf({ size, patientFromVoxel }: Volume): Vec3 {
  return applied(patientFromVoxel, [(size[0] - 1) / 2, (size[1] - 1) / 2, (size[2] - 1) / 2]);
}

/** The same place, or the nearest along the volume's axes where it lies outside [mm]. */
export function heldInside({ size, voxelFromPatient, patientFromVoxel }: Volume, mm: Vec3): Vec3 {
  const [i, j, k] = applied(voxelFromPatient, mm);
  const held = (at: number, count: number): number => Math.min(count - 1, Math.max(0, at));
  return applied(patientFromVoxel, [held(i, size[0]), held(j, size[1]), held(k, size[2])]);
}

/** The shortest edge of a voxel [mm]. */
export function finestSpacing(volume: Volume): number {
  return Math.min(
    ...[0, 1, 2].map((c) =>
      Math.hypot(...[0, 1, 2].map((r) => volume.patientFromVoxel[4 * r + c] ?? 0)),
    ),
  );
}
