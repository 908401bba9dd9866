// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import type { Vec3 } from "../protocol";
import { isWhole } from "./measure_model";
import { MeasureTool } from "./measure_tool";
import { inverted, type Volume } from "./nifti_model";

const SIDE = 20;
const rows = [1, 0, 0, -10, 0, 1, 0, -10, 0, 0, 1, -10];
/** A millimetre a voxel; HU are x in voxels. */
const ct: Volume = {
  size: [SIDE, SIDE, SIDE],
  patientFromVoxel: rows,
  voxelFromPatient: inverted(rows),
  values: Int16Array.from({ length: SIDE ** 3 }, (_, i) => i % SIDE),
  head: new Uint8Array(352),
};
const away: Vec3 = [0, 0, 1];

describe("measures on a scan", () => {
  it("are laid place by place and said when they are whole", () => {
    const tool = new MeasureTool(ct);
    expect(tool.add([0, 0, 0], away)).toBeUndefined();
    expect(tool.measures).toEqual([]);
    expect(tool.toggle("distance")).toContain("its two ends");
    expect(tool.add([0, 0, 0], away)).toBeUndefined();
    expect(tool.add([0, 6, 0], away)).toBe("Distance 6.0 mm");
    expect(tool.toggle("angle")).toContain("the corner second");
    for (const at of [
      [1, 0, 0],
      [0, 0, 0],
    ] as const) {
      expect(tool.add(at, away)).toBeUndefined();
    }
    expect(tool.add([0, 1, 0], away)).toMatch(/^Angle 90/);
    expect(tool.measures).toHaveLength(2);
    tool.dropLast();
    expect(tool.measures).toHaveLength(1);
  });

  it("that are not whole go when the tool is put down or changed", () => {
    const tool = new MeasureTool(ct);
    tool.toggle("angle");
    tool.add([0, 0, 0], away);
    tool.putDown();
    expect([tool.measures, tool.kind]).toEqual([[], undefined]);
    tool.toggle("angle");
    tool.add([0, 0, 0], away);
    tool.toggle("distance");
    expect(tool.measures).toEqual([]);
    expect(tool.toggle("distance")).toBe("");
    expect(tool.kind).toBeUndefined();
  });
  it("of HU are circles that are dragged, with their values as they grow", () => {
    const tool = new MeasureTool(ct);
    expect(tool.toggle("region")).toContain("circle");
    expect(tool.press([0, 0, 0], away, "down")).toBeUndefined();
    expect(tool.press([3.2, 0, 1], away, "move")).toBeUndefined();
    const growing = tool.shown([9, 9, 9], away).at(-1);
    expect(growing?.region?.radiusMm).toBeCloseTo(3.2);
    // Whole-number offsets within 3.2 of the middle.
    expect(growing?.region?.values.voxels).toBe(37);
    expect(growing?.region?.values.mean).toBeCloseTo(10);
    expect(tool.measures.every(isWhole)).toBe(false);
    expect(tool.press([2, 0, 0], away, "up")).toBe(
      "Circle of radius 2.0 mm: mean 10 HU, SD 1 HU, 13 voxels",
    );
    expect(tool.measures.every(isWhole)).toBe(true);
    expect(tool.shown([9, 9, 9], away)).toEqual(tool.measures);
  });
  it("of HU may be clicked too: middle, then rim", () => {
    const tool = new MeasureTool(ct);
    tool.toggle("region");
    tool.press([0, 0, 0], away, "down");
    expect(tool.press([0, 0.1, 0], away, "up")).toBeUndefined();
    expect(tool.measures).toHaveLength(1);
    tool.press([0, 2, 0], away, "down");
    expect(tool.press([0, 2, 0], away, "up")).toContain("radius 2.0 mm");
    expect(tool.measures).toHaveLength(1);
  });
  it("laid by keys are shown up to the crosshair, and by mouse are not", () => {
    const tool = new MeasureTool(ct);
    tool.toggle("region");
    expect(tool.addByKey([0, 0, 0], away)).toBeUndefined();
    expect(tool.addByKey([0, 0, 0], away)).toContain("no size");
    expect(tool.shown([0, 1.5, 0], away)[0]?.region?.radiusMm).toBe(1.5);
    expect(tool.addByKey([0, 2, 0], away)).toContain("13 voxels");
    tool.toggle("distance");
    tool.press([0, 0, 0], away, "down");
    expect(tool.shown([5, 5, 5], away)).toEqual(tool.measures);
    tool.putDown();
    tool.toggle("distance");
    tool.addByKey([0, 0, 0], away);
    expect(tool.shown([0, 4, 0], away).at(-1)?.places).toHaveLength(2);
    expect(tool.measures.at(-1)?.places).toHaveLength(1);
  });
});
