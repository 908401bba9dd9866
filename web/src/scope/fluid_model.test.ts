// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import type { JointFluid } from "../protocol";
import { fluidAct } from "./fluid_controls";
import { fluidWords, highestPlaces, settingOf } from "./fluid_model";

const NOW: JointFluid = {
  inflow_mmhg: 35,
  step_mmhg: 5,
  most_inflow_mmhg: 100,
  outflow_open: true,
  dry: false,
  flushing: false,
  pressure_mmhg: 26,
  haze_per_mm: 0.05,
  bubbles: 0.5,
  fog: 0,
  smear: 0,
};

describe("what is asked of the fluid", () => {
  it("goes by the pump's steps and no further than it does", () => {
    expect(settingOf("more", NOW)).toEqual({ control: "inflow", value: 8 });
    expect(settingOf("less", { ...NOW, inflow_mmhg: 0 })).toBeUndefined();
    expect(settingOf("more", { ...NOW, inflow_mmhg: 100 })).toBeUndefined();
  });
  it("turns over what is open or shut", () => {
    expect(settingOf("outflow", NOW)).toEqual({ control: "outflow", value: 0 });
    expect(settingOf("dry", { ...NOW, dry: true })).toEqual({ control: "dry", value: 0 });
    expect(settingOf("flush", NOW)).toEqual({ control: "flush", value: 0 });
  });
  it("has a key each", () => {
    expect(fluidAct("PageUp")).toBe("more");
    expect(fluidAct("End")).toBe("outflow");
    expect(fluidAct("KeyA")).toBeUndefined();
  });
});

describe("what is told of it", () => {
  it("is what a pump shows, and never how cloudy it is", () => {
    expect(fluidWords(NOW)).toBe("Pump 35 mmHg · joint 26 mmHg · outflow open");
    expect(fluidWords({ ...NOW, dry: true })).toBe("Dry, no fluid");
    expect(fluidWords({ ...NOW, flushing: true })).toContain("flushing");
  });
});

describe("bubbles", () => {
  /** A room 8 mm high, seen from its middle. */
  const walls: number[] = [];
  for (let x = -8; x <= 8; ++x) for (let y = 2; y <= 8; ++y) walls.push(x, y, 4, x, y, -4);
  const view = {
    eyeMm: [0, 0, 0] as const,
    axis: [0, 1, 0] as const,
    high: [0, 0, 1] as const,
    halfFieldRad: 0.9,
  };
  it("lie under the roof, apart from each other", () => {
    const places = highestPlaces(walls, view, 6);
    expect(places).toHaveLength(6);
    expect(places.every((at) => at[2] === 4)).toBe(true);
  });
  it("are not seen by who looks down", () => {
    const down = { ...view, axis: [0, 0.5, -0.866] as const, halfFieldRad: 0.6 };
    expect(highestPlaces(walls, down, 6)).toHaveLength(0);
  });
});
