// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import type { Vec3 } from "../protocol";
import { inverted, voxelIndexAt, type Volume } from "./nifti_model";
import { LabelPaint } from "./paint_model";
import { Stroke, type StrokeKind } from "./stroke_model";

const SIDE = 24;
const ROWS = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];
const MARKER: StrokeKind = { radiusMm: 1.2, label: 5, only: undefined, grows: true };

function empty(): Volume & { readonly values: Uint8Array } {
  return {
    size: [SIDE, SIDE, SIDE],
    patientFromVoxel: ROWS,
    voxelFromPatient: inverted(ROWS),
    values: new Uint8Array(SIDE ** 3),
    head: new Uint8Array(352),
  };
}

function painted(paint: LabelPaint): Stroke {
  const stroke = new Stroke(MARKER, paint, [5, 5, 5]);
  stroke.goOn([9, 5, 5]);
  stroke.end();
  return stroke;
}

function move(stroke: Stroke, ...offsets: readonly Vec3[]): void {
  stroke.beginMove();
  for (const offset of offsets) stroke.moveBy(offset);
  stroke.endMove(offsets.at(-1) ?? [0, 0, 0]);
}

describe("the stroke that was painted last", () => {
  it("is laid elsewhere by one change, whatever was seen on the way", () => {
    const volume = empty();
    const paint = new LabelPaint(volume);
    const stroke = painted(paint);
    const before = volume.values.slice();
    move(stroke, [0, 1, 0], [0, 9, 0], [0, 8, 3]);
    const elsewhere = empty();
    new Stroke(MARKER, new LabelPaint(elsewhere), [5, 13, 8]).goOn([9, 13, 8]);
    expect(volume.values).toEqual(elsewhere.values);
    expect(stroke.middle).toEqual([7, 13, 8]);
    paint.undo();
    expect(volume.values).toEqual(before);
    paint.undo();
    expect(volume.values.every((v) => v === 0)).toBe(true);
  });
  it("takes with it what was found from it, and can be moved again", () => {
    const volume = empty();
    const paint = new LabelPaint(volume);
    const stroke = painted(paint);
    const far = voxelIndexAt(volume, [20, 20, 20]);
    paint.take(Uint32Array.of(far), Uint8Array.of(5), true);
    expect(stroke.isLatest).toBe(true);
    move(stroke, [0, 4, 0]);
    expect(volume.values[far]).toBe(0);
    move(stroke, [0, 4, 0]);
    expect(volume.values[voxelIndexAt(volume, [7, 13, 5])]).toBe(5);
    expect(volume.values[voxelIndexAt(volume, [7, 9, 5])]).toBe(0);
  });
  it("is not the latest once something else was changed, or it changed nothing", () => {
    const volume = empty();
    const paint = new LabelPaint(volume);
    const stroke = painted(paint);
    const again = painted(paint);
    expect(again.isLatest).toBe(false);
    expect(stroke.isLatest).toBe(true);
    paint.fill(5);
    paint.merge(5, 6);
    expect(stroke.isLatest).toBe(false);
    paint.undo();
    expect(stroke.isLatest).toBe(true);
  });
  it("leaves what others painted where it had been", () => {
    const volume = empty();
    const paint = new LabelPaint(volume);
    paint.begin();
    paint.stroke([5, 5, 5], [5, 5, 5], 3, 2);
    paint.end();
    const before = volume.values.slice();
    const stroke = painted(paint);
    move(stroke, [0, 12, 0]);
    expect(volume.values[voxelIndexAt(volume, [5, 5, 5])]).toBe(
      before[voxelIndexAt(volume, [5, 5, 5])],
    );
  });
});
