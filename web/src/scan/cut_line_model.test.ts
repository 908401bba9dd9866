// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import type { Vec3 } from "../protocol";
import { cutNormal, isLongEnough, traceOfCut, type CutLine } from "./cut_line_model";
import { along, dot, planesOf } from "./planes_model";
import { placeAt, type SliceView } from "./slice_model";

const planes = planesOf("scan", [], "left");
const line: CutLine = { a: [2, -1, 3], b: [4, 5, 3], away: planes.axial.away };
const view = (id: "axial" | "coronal" | "sagittal", centre: Vec3): SliceView => ({
  plane: planes[id],
  centre,
  mmPerPixel: 0.25,
});

describe("a cut", () => {
  it("is seen in every picture where its plane passes, with the side that is cut off", () => {
    for (const id of ["axial", "coronal", "sagittal"] as const) {
      const at = view(id, [1, 2, 5]);
      const trace = traceOfCut(line, at, 200, 100);
      expect(trace).toBeDefined();
      if (trace === undefined) continue;
      const n = cutNormal(line);
      const off = ([x, y]: readonly [number, number]): number =>
        dot(along(placeAt(at, 200, 100, x, y), -1, line.a), n);
      expect(off(trace.from)).toBeCloseTo(0, 6);
      expect(off(trace.to)).toBeCloseTo(0, 6);
      const beside = [trace.from[0] + trace.side[0], trace.from[1] + trace.side[1]] as const;
      expect(off(beside)).toBeGreaterThan(0);
      // Beyond both edges.
      const reach = Math.hypot(trace.to[0] - trace.from[0], trace.to[1] - trace.from[1]);
      expect(reach).toBeGreaterThan(2 * 200);
      expect(trace.ends === undefined).toBe(id !== "axial");
    }
  });
  it("lies on its right, walking along it on the screen", () => {
    // Down the screen: right is where the screen's left is.
    const down: CutLine = { a: [0, 0, 0], b: [0, 5, 0], away: [0, 0, 1] };
    expect(traceOfCut(down, view("axial", [0, 0, 0]), 100, 100)?.side).toEqual([-1, 0]);
  });
  it("passes nowhere through a slice that lies along it", () => {
    const across: CutLine = { a: [0, 0, 0], b: [5, 0, 0], away: [0, 0, 1] };
    expect(traceOfCut(across, view("coronal", [0, 3, 0]), 100, 100)).toBeUndefined();
  });
  it("needs ends that lie apart as they are seen", () => {
    expect(isLongEnough(line)).toBe(true);
    expect(isLongEnough({ ...line, b: [2.4, -1, 3] })).toBe(false);
    expect(isLongEnough({ ...line, b: [2, -1, 30] })).toBe(false);
  });
});
