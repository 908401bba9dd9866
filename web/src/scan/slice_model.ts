// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One slice through a volume at any angle, in grey, with the labels over it. Linear between voxels for the
// CT, the nearest voxel for labels: a label has no value between.
import type { Vec3 } from "../protocol";
import { applied, type Volume } from "./nifti_model";
import { along, type Plane } from "./planes_model";

/** What of a plane a picture shows. */
export interface SliceView {
  readonly plane: Plane;
  /** In the picture's middle, Patient mm. */
  readonly centre: Vec3;
  readonly mmPerPixel: number;
}

export interface GreyWindow {
  readonly centre: number;
  readonly width: number;
}

/** How labels are laid over: colours by label, 0xbbggrr. */
export interface Overlay {
  readonly colors: Uint32Array;
  /** 0 to 1, of the filling; the rim is drawn as long as it is over 0. */
  readonly opacity: number;
}

/** Beyond the scan. */
const NOTHING = 0xff14_100e;
const RIM = 0.9;

export function placeAt(
  view: SliceView,
  width: number,
  height: number,
  x: number,
  y: number,
): Vec3 {
  const right = (x - width / 2) * view.mmPerPixel;
  const down = (y - height / 2) * view.mmPerPixel;
  return along(along(view.centre, right, view.plane.right), down, view.plane.down);
}

export function pixelOf(
  view: SliceView,
  width: number,
  height: number,
  mm: Vec3,
): readonly [number, number] {
  const d = along(mm, -1, view.centre);
  const { right, down } = view.plane;
  return [
    width / 2 + (d[0] * right[0] + d[1] * right[1] + d[2] * right[2]) / view.mmPerPixel,
    height / 2 + (d[0] * down[0] + d[1] * down[1] + d[2] * down[2]) / view.mmPerPixel,
  ];
}

/** Voxel coordinates of the first pixel's middle, and what one pixel right and down adds. */
function steps(
  volume: Volume,
  view: SliceView,
  width: number,
  height: number,
): readonly [Vec3, Vec3, Vec3] {
  const first = applied(volume.voxelFromPatient, placeAt(view, width, height, 0.5, 0.5));
  const right = applied(volume.voxelFromPatient, placeAt(view, width, height, 1.5, 0.5));
  const down = applied(volume.voxelFromPatient, placeAt(view, width, height, 0.5, 1.5));
  return [first, along(right, -1, first), along(down, -1, first)];
}

/** @param out  width x height pixels, 0xaabbggrr as canvases have them */
export function drawGrey(
  ct: Volume,
  view: SliceView,
  grey: GreyWindow,
  width: number,
  height: number,
  out: Uint32Array,
): void {
  const [first, right, down] = steps(ct, view, width, height);
  const [w, h, d] = ct.size;
  const values = ct.values;
  const slab = w * h;
  const gain = 255 / Math.max(1, grey.width);
  const least = grey.centre - grey.width / 2;
  for (let j = 0, i = 0; j < height; ++j) {
    let x = first[0] + j * down[0];
    let y = first[1] + j * down[1];
    let z = first[2] + j * down[2];
    for (let k = 0; k < width; ++k, ++i, x += right[0], y += right[1], z += right[2]) {
      if (!(x >= -0.5 && y >= -0.5 && z >= -0.5 && x < w - 0.5 && y < h - 0.5 && z < d - 0.5)) {
        out[i] = NOTHING;
        continue;
      }
      const cx = x < 0 ? 0 : x > w - 1 ? w - 1 : x;
      const cy = y < 0 ? 0 : y > h - 1 ? h - 1 : y;
      const cz = z < 0 ? 0 : z > d - 1 ? d - 1 : z;
      const ix = cx | 0;
      const iy = cy | 0;
      const iz = cz | 0;
      const fx = cx - ix;
      const fy = cy - iy;
      const fz = cz - iz;
      const at = iz * slab + iy * w + ix;
      const dx = ix < w - 1 ? 1 : 0;
      const dy = iy < h - 1 ? w : 0;
      const dz = iz < d - 1 ? slab : 0;
      const a = mix(values, at, dx, dy, fx, fy);
      const b = mix(values, at + dz, dx, dy, fx, fy);
      let v = ((a + (b - a) * fz - least) * gain) | 0;
      v = v < 0 ? 0 : v > 255 ? 255 : v;
      out[i] = 0xff00_0000 | (v << 16) | (v << 8) | v;
    }
  }
}

function mix(
  values: Int16Array | Uint8Array,
  at: number,
  dx: number,
  dy: number,
  fx: number,
  fy: number,
): number {
  const a = values[at] as number;
  const b = values[at + dx] as number;
  const c = values[at + dy] as number;
  const e = values[at + dx + dy] as number;
  const low = a + (b - a) * fx;
  return low + (c + (e - c) * fx - low) * fy;
}

/** Lays the labels over what `out` holds. A rim is a pixel whose label differs from its left or upper one's. */
export function drawLabels(
  labels: Volume,
  view: SliceView,
  overlay: Overlay,
  width: number,
  height: number,
  out: Uint32Array,
): void {
  if (!(overlay.opacity > 0)) return;
  const [first, right, down] = steps(labels, view, width, height);
  const [w, h, d] = labels.size;
  const { values } = labels;
  const above = new Uint8Array(width);
  for (let j = 0, i = 0; j < height; ++j) {
    let x = first[0] + j * down[0] + 0.5;
    let y = first[1] + j * down[1] + 0.5;
    let z = first[2] + j * down[2] + 0.5;
    let before = 0;
    for (let k = 0; k < width; ++k, ++i, x += right[0], y += right[1], z += right[2]) {
      const inside = x >= 0 && y >= 0 && z >= 0 && x < w && y < h && z < d;
      const label = inside ? (values[((z | 0) * h + (y | 0)) * w + (x | 0)] as number) : 0;
      const isRim = (label !== before && k > 0) || (label !== above[k] && j > 0);
      const shown = label !== 0 ? label : isRim ? before || (above[k] as number) : 0;
      above[k] = before = label;
      if (shown === 0) continue;
      const share = isRim ? RIM : overlay.opacity;
      out[i] = blended(out[i] as number, overlay.colors[shown] ?? 0xffffff, share);
    }
  }
}

function blended(under: number, over: number, share: number): number {
  const s = (share * 256) | 0;
  const channel = (shift: number): number => {
    const u = (under >>> shift) & 255;
    return (u + (((((over >>> shift) & 255) - u) * s) >> 8)) << shift;
  };
  return 0xff00_0000 | channel(0) | channel(8) | channel(16);
}
