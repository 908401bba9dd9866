// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Labels changed by hand: a ball that paints or erases along a line, a hollow filled, two bones made one, a
// bone cut in two, and what the host found from a marker. Each change can be taken back and made again.
import type { Vec3 } from "../protocol";
import { cutNormal, type CutLine } from "./cut_line_model";
import { applied, type Volume } from "./nifti_model";
import { along, dot } from "./planes_model";

/** What one change did: which voxels, and what they held. */
interface Change {
  readonly indices: Uint32Array;
  readonly before: Uint8Array;
  readonly after: Uint8Array;
  /** The same for a change and for what it became. */
  readonly mark: object;
}

/** What is kept to be taken back, of all changes together. */
const MOST_KEPT = 40_000_000;

export class LabelPaint {
  private readonly done: Change[] = [];
  private readonly undone: Change[] = [];
  private open: Map<number, number> | undefined;
  private openMark: object = {};
  private readonly values: Uint8Array;
  private readonly counts = new Uint32Array(256);

  /** @param labels  changed in place, and by nobody else */
  constructor(private readonly labels: Volume) {
    if (!(labels.values instanceof Uint8Array)) throw new Error("labels are uint8");
    this.values = labels.values;
    for (let i = 0; i < this.values.length; ++i) {
      const label = this.values[i] ?? 0;
      this.counts[label] = (this.counts[label] ?? 0) + 1;
    }
  }

  /** How many voxels have a label now. */
  count(label: number): number {
    return this.counts[label] ?? 0;
  }

  get canUndo(): boolean {
    return this.done.length > 0;
  }

  get canRedo(): boolean {
    return this.undone.length > 0;
  }

  /** What follows until end() is one change. */
  begin(): void {
    this.end();
    this.open = new Map();
    this.openMark = {};
  }

  /** The change that is open begins anew. */
  rewind(): void {
    for (const [i, before] of this.open ?? []) this.put(i, before);
    this.open?.clear();
  }

  /** What the latest change did is undone within the one that is open. */
  insteadOfLatest(): void {
    const change = this.done.at(-1);
    change?.indices.forEach((i, k) => {
      if (this.values[i] === change.after[k]) this.set(i, change.before[k] ?? 0);
    });
  }

  end(): void {
    const { open } = this;
    this.open = undefined;
    if (open === undefined) return;
    const indices = Uint32Array.from(
      [...open].filter(([i, before]) => this.values[i] !== before).map(([i]) => i),
    );
    if (indices.length === 0) return;
    const before = Uint8Array.from(indices, (i) => open.get(i) ?? 0);
    const after = Uint8Array.from(indices, (i) => this.values[i] ?? 0);
    this.done.push({ indices, before, after, mark: this.openMark });
    this.undone.length = 0;
    let kept = this.done.reduce((sum, one) => sum + one.indices.length, 0);
    while (kept > MOST_KEPT && this.done.length > 1) kept -= this.done.shift()?.indices.length ?? 0;
  }

  /** The host's answer to what was painted: one change with it, unless something came between. */
  take(indices: Uint32Array, labels: Uint8Array, joins: boolean): void {
    const last = joins ? this.done.pop() : undefined;
    this.begin();
    if (last !== undefined) {
      this.openMark = last.mark;
      last.indices.forEach((i, k) => this.open?.set(i, last.before[k] ?? 0));
    }
    indices.forEach((i, k) => {
      this.set(i, labels[k] ?? 0);
    });
    this.end();
  }

  /** Names the last change that was not taken back: another name where something came between. */
  get latest(): object | undefined {
    return this.done.at(-1)?.mark;
  }

  /** Whether the change of this name was not taken back. */
  holds(mark: object): boolean {
    return this.done.some((change) => change.mark === mark);
  }

  /** A copy of the labels as they were before the last change that was not taken back. */
  beforeLatest(): Uint8Array {
    const before = this.values.slice();
    const change = this.done.at(-1);
    change?.indices.forEach((i, k) => {
      before[i] = change.before[k] ?? 0;
    });
    return before;
  }

  undo(): boolean {
    this.end();
    const change = this.done.pop();
    if (change === undefined) return false;
    change.indices.forEach((i, k) => {
      this.put(i, change.before[k] ?? 0);
    });
    this.undone.push(change);
    return true;
  }

  redo(): boolean {
    this.end();
    const change = this.undone.pop();
    if (change === undefined) return false;
    change.indices.forEach((i, k) => {
      this.put(i, change.after[k] ?? 0);
    });
    this.done.push(change);
    return true;
  }

  private set(i: number, label: number): void {
    const before = this.values[i] ?? 0;
    if (before === label) return;
    if (this.open !== undefined && !this.open.has(i)) this.open.set(i, before);
    this.put(i, label);
  }

  private put(i: number, label: number): void {
    const before = this.values[i] ?? 0;
    this.counts[before] = (this.counts[before] ?? 0) - 1;
    this.counts[label] = (this.counts[label] ?? 0) + 1;
    this.values[i] = label;
  }

  /** Runs over the voxels whose middles lie in the box of two places with a rim [mm]. */
  private near(a: Vec3, b: Vec3, rim: number, visit: (i: number, mm: Vec3) => void): void {
    const m = this.labels.voxelFromPatient;
    const [va, vb] = [applied(m, a), applied(m, b)];
    const range = [0, 1, 2].map((axis) => {
      const reach = rim * Math.hypot(m[4 * axis] ?? 0, m[4 * axis + 1] ?? 0, m[4 * axis + 2] ?? 0);
      const low = Math.min(va[axis] ?? 0, vb[axis] ?? 0) - reach;
      const high = Math.max(va[axis] ?? 0, vb[axis] ?? 0) + reach;
      const last = (this.labels.size[axis] ?? 1) - 1;
      return [Math.max(0, Math.ceil(low)), Math.min(last, Math.floor(high))] as const;
    });
    const [xs, ys, zs] = range;
    if (xs === undefined || ys === undefined || zs === undefined) return;
    const [w, h] = this.labels.size;
    for (let z = zs[0]; z <= zs[1]; ++z) {
      for (let y = ys[0]; y <= ys[1]; ++y) {
        for (let x = xs[0]; x <= xs[1]; ++x) {
          visit((z * h + y) * w + x, applied(this.labels.patientFromVoxel, [x, y, z]));
        }
      }
    }
  }

  /**
   * With a ball from one place to another. @param only  changes this label alone; any where undefined
   */
  stroke(from: Vec3, to: Vec3, radiusMm: number, label: number, only?: number): void {
    const line = along(to, -1, from);
    const length2 = dot(line, line);
    this.near(from, to, radiusMm, (i, mm) => {
      if (only !== undefined && this.values[i] !== only) return;
      const d = along(mm, -1, from);
      const s = length2 > 0 ? Math.min(1, Math.max(0, dot(d, line) / length2)) : 0;
      const off = along(d, -s, line);
      if (dot(off, off) <= radiusMm * radiusMm) this.set(i, label);
    });
  }

  /** All of one label becomes another. */
  merge(from: number, into: number): void {
    this.begin();
    for (let i = 0; i < this.values.length; ++i) if (this.values[i] === from) this.set(i, into);
    this.end();
  }

  /**
   * What of a bone lies to the right of a line gets another label, 0 for none.
   * @return the voxels that were cut off; none where the bone lies on one side of the line, and stays as it is
   */
  split(label: number, into: number, line: CutLine): number {
    const right = cutNormal(line);
    const [w, h] = this.labels.size;
    const cut: number[] = [];
    for (let i = 0; i < this.values.length; ++i) {
      if (this.values[i] !== label) continue;
      const voxel: Vec3 = [i % w, Math.floor(i / w) % h, Math.floor(i / (w * h))];
      const mm = applied(this.labels.patientFromVoxel, voxel);
      if (dot(along(mm, -1, line.a), right) > 0) cut.push(i);
    }
    if (cut.length === this.count(label)) return 0;
    this.begin();
    for (const i of cut) this.set(i, into);
    this.end();
    return cut.length;
  }

  /** Hollows of a bone, which water from outside does not reach, become bone. */
  fill(label: number): void {
    const [w, h, d] = this.labels.size;
    const box = boundsOf(this.labels, label);
    if (box === undefined) return;
    const low = box.low.map((v) => Math.max(0, v - 1));
    const high = box.high.map((v, i) => Math.min(([w, h, d][i] ?? 1) - 1, v + 1));
    const [x0 = 0, y0 = 0, z0 = 0] = low;
    const [x1 = 0, y1 = 0, z1 = 0] = high;
    const [bw, bh, bd] = [x1 - x0 + 1, y1 - y0 + 1, z1 - z0 + 1];
    const wet = new Uint8Array(bw * bh * bd);
    const queue: number[] = [];
    const at = (x: number, y: number, z: number): number => ((z + z0) * h + y + y0) * w + x + x0;
    const pour = (x: number, y: number, z: number): void => {
      if (x < 0 || y < 0 || z < 0 || x >= bw || y >= bh || z >= bd) return;
      const i = (z * bh + y) * bw + x;
      if (wet[i] === 1 || this.values[at(x, y, z)] === label) return;
      wet[i] = 1;
      queue.push(i);
    };
    for (let z = 0; z < bd; ++z) {
      for (let y = 0; y < bh; ++y) {
        for (let x = 0; x < bw; ++x) {
          const isRim =
            x === 0 || y === 0 || z === 0 || x === bw - 1 || y === bh - 1 || z === bd - 1;
          if (isRim) pour(x, y, z);
        }
      }
    }
    for (let i = queue.pop(); i !== undefined; i = queue.pop()) {
      const x = i % bw;
      const y = Math.floor(i / bw) % bh;
      const z = Math.floor(i / (bw * bh));
      pour(x - 1, y, z);
      pour(x + 1, y, z);
      pour(x, y - 1, z);
      pour(x, y + 1, z);
      pour(x, y, z - 1);
      pour(x, y, z + 1);
    }
    this.begin();
    for (let z = 0; z < bd; ++z) {
      for (let y = 0; y < bh; ++y) {
        for (let x = 0; x < bw; ++x) {
          const i = at(x, y, z);
          // Another bone that is enclosed stays one.
          if (wet[(z * bh + y) * bw + x] === 0 && this.values[i] === 0) this.set(i, label);
        }
      }
    }
    this.end();
  }
}

export interface Bounds {
  readonly low: readonly [number, number, number];
  readonly high: readonly [number, number, number];
}

export function boundsOf(labels: Volume, label: number): Bounds | undefined {
  const [w, h, d] = labels.size;
  const low: [number, number, number] = [w, h, d];
  const high: [number, number, number] = [-1, -1, -1];
  for (let z = 0, i = 0; z < d; ++z) {
    for (let y = 0; y < h; ++y) {
      for (let x = 0; x < w; ++x, ++i) {
        if (labels.values[i] !== label) continue;
        if (x < low[0]) low[0] = x;
        if (x > high[0]) high[0] = x;
        if (y < low[1]) low[1] = y;
        if (y > high[1]) high[1] = y;
        if (z < low[2]) low[2] = z;
        high[2] = z;
      }
    }
  }
  return high[0] < 0 ? undefined : { low, high };
}
