// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { CutTool } from "./cut_tool";

const away = [0, 0, 1] as const;

describe("the line of a cut", () => {
  it("is seen while it is dragged, and stays when it is whole", () => {
    const tool = new CutTool();
    expect(tool.shown([9, 9, 9], away)).toBeUndefined();
    expect(tool.press([0, 0, 0], away, "down")).toBe(false);
    expect(tool.press([3, 0, 0], away, "move")).toBe(false);
    expect(tool.shown([9, 9, 9], away)).toEqual({ a: [0, 0, 0], b: [3, 0, 0], away });
    expect(tool.whole).toBeUndefined();
    expect(tool.press([4, 0, 0], away, "up")).toBe(true);
    expect(tool.whole).toEqual({ a: [0, 0, 0], b: [4, 0, 0], away });
    tool.drop();
    expect(tool.whole).toBeUndefined();
  });
  it("is none where it is a click", () => {
    const tool = new CutTool();
    tool.press([0, 0, 0], away, "down");
    expect(tool.press([0.4, 0, 0], away, "up")).toBe(false);
    expect(tool.shown([9, 9, 9], away)).toBeUndefined();
  });
  it("is laid end by end by keys, the second at the crosshair until then", () => {
    const tool = new CutTool();
    expect(tool.addEnd([0, 0, 0], away)).toBe(false);
    expect(tool.whole).toBeUndefined();
    expect(tool.shown([2, 0, 0], away)).toEqual({ a: [0, 0, 0], b: [2, 0, 0], away });
    expect(tool.addEnd([5, 0, 0], away)).toBe(true);
    expect(tool.whole?.b).toEqual([5, 0, 0]);
    // Behind each other as they are seen: no line.
    tool.addEnd([0, 0, 0], away);
    expect(tool.addEnd([0, 0, 8], away)).toBe(false);
    expect(tool.whole).toBeUndefined();
  });
});
