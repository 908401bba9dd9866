// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { MeasureTool } from "./measure_tool";

describe("measures on a scan", () => {
  it("are laid place by place and said when they are whole", () => {
    const tool = new MeasureTool();
    expect(tool.add([0, 0, 0])).toBeUndefined();
    expect(tool.measures).toEqual([]);
    expect(tool.toggle("distance")).toContain("its two ends");
    expect(tool.add([0, 0, 0])).toBeUndefined();
    expect(tool.add([0, 6, 0])).toBe("Distance 6.0 mm");
    expect(tool.toggle("angle")).toContain("the corner second");
    for (const at of [
      [1, 0, 0],
      [0, 0, 0],
    ] as const) {
      expect(tool.add(at)).toBeUndefined();
    }
    expect(tool.add([0, 1, 0])).toMatch(/^Angle 90/);
    expect(tool.measures).toHaveLength(2);
    tool.dropLast();
    expect(tool.measures).toHaveLength(1);
  });

  it("that are not whole go when the tool is put down or changed", () => {
    const tool = new MeasureTool();
    tool.toggle("angle");
    tool.add([0, 0, 0]);
    tool.putDown();
    expect([tool.measures, tool.kind]).toEqual([[], undefined]);
    tool.toggle("angle");
    tool.add([0, 0, 0]);
    tool.toggle("distance");
    expect(tool.measures).toEqual([]);
    expect(tool.toggle("distance")).toBe("");
    expect(tool.kind).toBeUndefined();
  });
});
