// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import type { Vec3 } from "../protocol";
import { inverted, voxelIndexAt, type Volume } from "./nifti_model";
import { LabelPaint } from "./paint_model";

const SIDE = 20;

/** Half a millimetre a voxel, off the origin, z twice as coarse. */
function labels(value: (x: number, y: number, z: number) => number): Volume & {
  readonly values: Uint8Array;
} {
  const values = new Uint8Array(SIDE ** 3);
  values.forEach((_, i) => {
    values[i] = value(i % SIDE, Math.floor(i / SIDE) % SIDE, Math.floor(i / SIDE ** 2));
  });
  const rows = [0.5, 0, 0, 3, 0, 0.5, 0, -4, 0, 0, 1, 7];
  return {
    size: [SIDE, SIDE, SIDE],
    patientFromVoxel: rows,
    voxelFromPatient: inverted(rows),
    values,
    head: new Uint8Array(352),
  };
}

const middle: Vec3 = [8, 1, 17];
const count = (of: { readonly values: Uint8Array }, label: number): number =>
  of.values.reduce((sum, v) => sum + (v === label ? 1 : 0), 0);

describe("labels that are mended", () => {
  it("are painted in a ball, whatever the voxels' shape", () => {
    const volume = labels(() => 0);
    const paint = new LabelPaint(volume);
    paint.begin();
    paint.stroke(middle, middle, 2, 5);
    paint.end();
    // 4/3 pi 8 mm3 of 0.25 mm3.
    expect(count(volume, 5)).toBeGreaterThan(120);
    expect(count(volume, 5)).toBeLessThan(148);
    expect(volume.values[voxelIndexAt(volume, [8, 1, 18.9])]).toBe(5);
    expect(volume.values[voxelIndexAt(volume, [8, 3.5, 17])]).toBe(0);
  });
  it("are painted between two places, without gaps, and not beyond the volume", () => {
    const volume = labels(() => 0);
    const paint = new LabelPaint(volume);
    paint.begin();
    paint.stroke([-5, 1, 17], [30, 1, 17], 0.3, 5);
    paint.end();
    expect(count(volume, 5)).toBe(SIDE);
  });
  it("take the host's answer as part of the stroke, or on its own where something came between", () => {
    const volume = labels(() => 0);
    const paint = new LabelPaint(volume);
    paint.begin();
    paint.stroke(middle, middle, 1, 5);
    paint.end();
    const stroke = paint.latest;
    paint.take(Uint32Array.of(0, 1), Uint8Array.of(5, 5), stroke === paint.latest);
    expect([volume.values[0], volume.values[1]]).toEqual([5, 5]);
    expect(paint.undo()).toBe(true);
    expect(count(volume, 5)).toBe(0);
    expect(paint.canUndo).toBe(false);
    expect(paint.redo()).toBe(true);
    paint.fill(5);
    paint.take(Uint32Array.of(7), Uint8Array.of(5), false);
    expect(paint.undo()).toBe(true);
    expect(volume.values[7]).toBe(0);
    expect(volume.values[0]).toBe(5);
  });
  it("come back by undo and go again by redo, to the voxel", () => {
    const volume = labels((x) => (x > 10 ? 2 : 1));
    const before = volume.values.slice();
    const paint = new LabelPaint(volume);
    expect(paint.undo()).toBe(false);
    paint.begin();
    paint.stroke(middle, middle, 2, 5);
    paint.stroke(middle, [9, 2, 17], 2, 6);
    paint.end();
    const once = volume.values.slice();
    paint.merge(2, 1);
    const twice = volume.values.slice();
    expect(paint.undo()).toBe(true);
    expect(volume.values).toEqual(once);
    expect(paint.undo()).toBe(true);
    expect(volume.values).toEqual(before);
    expect(paint.canUndo).toBe(false);
    expect(paint.redo() && paint.redo()).toBe(true);
    expect(volume.values).toEqual(twice);
    expect(paint.canRedo).toBe(false);
  });
  it("lose what could be made again when something else is painted", () => {
    const paint = new LabelPaint(labels((x) => (x > 10 ? 2 : 1)));
    paint.merge(2, 1);
    paint.undo();
    paint.merge(1, 2);
    expect(paint.redo()).toBe(false);
  });
  it("are no change where nothing changes", () => {
    const paint = new LabelPaint(labels(() => 3));
    paint.begin();
    paint.stroke(middle, middle, 2, 3);
    paint.end();
    expect(paint.canUndo).toBe(false);
  });
  it("are erased of one bone alone", () => {
    const volume = labels((x) => (x > 10 ? 2 : 1));
    const paint = new LabelPaint(volume);
    paint.begin();
    paint.stroke(middle, middle, 2, 0, 2);
    paint.end();
    expect(count(volume, 1)).toBe(SIDE * SIDE * 11);
    expect(count(volume, 0)).toBeGreaterThan(20);
  });
  it("are split by a line that is drawn, right of who walks along it", () => {
    const volume = labels(() => 3);
    const paint = new LabelPaint(volume);
    // On a screen with x right and y down one walks down: right is where x is less.
    const line = { a: [8.1, -4, 17], b: [8.1, 5, 17], away: [0, 0, 1] } as const;
    expect(paint.split(3, 16, line)).toBe(11 * SIDE * SIDE);
    expect(volume.values[voxelIndexAt(volume, [4, 0, 17])]).toBe(16);
    expect(volume.values[voxelIndexAt(volume, [11, 0, 17])]).toBe(3);
    expect(count(volume, 16)).toBe(11 * SIDE * SIDE);
  });
  it("are cut off by a line, and left alone where it parts nothing", () => {
    const volume = labels((_x, y) => (y > 2 ? 3 : 0));
    const before = volume.values.slice();
    const paint = new LabelPaint(volume);
    const line = { a: [8.1, -4, 17], b: [8.1, 5, 17], away: [0, 0, 1] } as const;
    expect(paint.split(3, 0, line)).toBe(11 * 17 * SIDE);
    expect(paint.count(3)).toBe(9 * 17 * SIDE);
    expect(paint.undo()).toBe(true);
    expect(volume.values).toEqual(before);
    // All of it on one side or the other: a line beside a bone renames nothing.
    for (const x of [-5, 40]) {
      const beside = { ...line, a: [x, -4, 17], b: [x, 5, 17] } as const;
      expect(paint.split(3, 16, beside)).toBe(0);
    }
    expect(paint.canUndo).toBe(false);
    expect(volume.values).toEqual(before);
  });
  it("are known as they were before the last change", () => {
    const volume = labels((x) => (x > 10 ? 2 : 1));
    const paint = new LabelPaint(volume);
    paint.merge(2, 1);
    const before = volume.values.slice();
    paint.begin();
    paint.stroke(middle, middle, 2, 5);
    paint.end();
    const now = volume.values.slice();
    expect(paint.beforeLatest()).toEqual(before);
    expect(volume.values).toEqual(now);
  });
  it("are counted, whatever is done to them", () => {
    const volume = labels((x, y) => (x > 10 ? 2 : y > 15 ? 1 : 0));
    const paint = new LabelPaint(volume);
    const isRight = (): void => {
      for (const label of [0, 1, 2, 5]) expect(paint.count(label)).toBe(count(volume, label));
    };
    isRight();
    paint.begin();
    paint.stroke(middle, middle, 2, 5);
    isRight();
    paint.rewind();
    isRight();
    paint.stroke(middle, [9, 2, 17], 2, 5);
    paint.end();
    isRight();
    paint.begin();
    paint.insteadOfLatest();
    isRight();
    paint.stroke([7, 1, 17], [7, 1, 17], 1, 5);
    paint.end();
    paint.take(Uint32Array.of(0, 1), Uint8Array.of(5, 5), true);
    isRight();
    paint.merge(2, 0);
    isRight();
    paint.undo();
    paint.undo();
    isRight();
    paint.redo();
    isRight();
  });
  it("are filled where they enclose nothing, but for other bones and what is open", () => {
    const inside = (v: number): boolean => v >= 5 && v <= 12;
    const hollow = (v: number): boolean => v >= 7 && v <= 10;
    const volume = labels((x, y, z) => {
      if (x === 8 && y === 8 && z === 8) return 9;
      if (hollow(x) && hollow(y) && hollow(z)) return 0;
      return inside(x) && inside(y) && inside(z) ? 4 : 0;
    });
    const paint = new LabelPaint(volume);
    paint.fill(4);
    expect(count(volume, 4)).toBe(8 ** 3 - 1);
    expect(count(volume, 9)).toBe(1);
    paint.fill(7);
    expect(count(volume, 7)).toBe(0);
  });
});
