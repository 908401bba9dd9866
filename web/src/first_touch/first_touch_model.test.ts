// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Ticked by what happened, not by what was pressed.
import { describe, expect, it } from "vitest";
import { FirstTouch, type Observation } from "./first_touch_model";

const rest: Observation = {
  screenRight: [1, 0, 0],
  screenUp: [0, 1, 0],
  free: { tip: [0, 0, 0], shaft: [0, 0, 1] },
  depthMm: 0,
  shots: 4,
  undos: 1,
};

describe("FirstTouch", () => {
  it("ticks nothing for an operation as it stands", () => {
    const touch = new FirstTouch();
    expect(touch.observe(rest)).toBe(false);
    expect(touch.observe({ ...rest })).toBe(false);
    expect(touch.current).toBe("look");
  });

  it.each([
    ["look", { screenRight: [0.9, 0, -0.436] }],
    ["move", { free: { tip: [0, 3.1, 0], shaft: [0, 0, 1] } }],
    ["aim", { free: { tip: [0, 0, 0], shaft: [0.1, 0, 0.995] } }],
    ["drive", { free: undefined, depthMm: 1.1 }],
    ["shot", { shots: 5 }],
    ["undo", { undos: 2 }],
  ] as const)("ticks %s", (task, more) => {
    const touch = new FirstTouch();
    touch.observe(rest);
    expect(touch.observe({ ...rest, ...more })).toBe(true);
    expect(touch.isDone(task)).toBe(true);
    expect(touch.finished).toBe(false);
  });

  it("passes over what trembles", () => {
    const touch = new FirstTouch();
    touch.observe(rest);
    const trembling = { tip: [0.5, 0.5, 0], shaft: [0.02, 0, 0.9998] } as const;
    expect(touch.observe({ ...rest, free: trembling, depthMm: 0.4 })).toBe(false);
  });

  it("takes things in any order and ends with the last", () => {
    const touch = new FirstTouch();
    touch.observe(rest);
    touch.observe({ ...rest, shots: 5 });
    expect(touch.current).toBe("look");
    const all: Observation = {
      screenRight: [0, 0, 1],
      screenUp: [0, 1, 0],
      free: { tip: [9, 0, 0], shaft: [1, 0, 0] },
      depthMm: 2,
      shots: 5,
      undos: 2,
    };
    expect(touch.observe(all)).toBe(true);
    expect(touch.finished).toBe(true);
    expect(touch.current).toBeUndefined();
  });
});
