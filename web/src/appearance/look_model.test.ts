// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import {
  defaultLook,
  hexOf,
  lookOf,
  materialOf,
  rgbOf,
  roughnessOf,
  withLamp,
  withLampCount,
  withMaterial,
} from "./look_model";

describe("a look", () => {
  it("begins with the data's materials and two lamps", () => {
    const look = defaultLook();
    expect(look.materials.bone).toEqual(materialOf("bone"));
    expect(roughnessOf(look.materials.bone)).toBeCloseTo(0.72, 3);
    expect(roughnessOf(look.materials.tendon)).toBeCloseTo(0.38, 2);
    expect(look.lamps.length).toBe(2);
    expect(look.texture).toBe(true);
  });

  it("comes back as it was remembered", () => {
    const changed = withLamp(
      withMaterial(withLampCount(defaultLook(), 3), "bone", { shininess: 0.5 }),
      2,
      { up: -30 },
    );
    expect(lookOf(JSON.stringify(changed))).toEqual(changed);
    expect(changed.materials.nerve).toEqual(materialOf("nerve"));
  });

  it.each([
    "",
    "nonsense",
    "null",
    "[]",
    JSON.stringify({ ...defaultLook(), lamps: [] }),
    JSON.stringify({
      ...defaultLook(),
      lamps: [{ color: [1, 1, 2], strength: 1, right: 0, up: 0 }],
    }),
    JSON.stringify(withMaterial(defaultLook(), "bone", { transparency: 2 })),
    JSON.stringify({ ...defaultLook(), materials: { bone: materialOf("bone") } }),
  ])("is the default where what was remembered is none: %s", (text) => {
    expect(lookOf(text)).toEqual(defaultLook());
  });

  it("counts lamps from one up, new ones white from above", () => {
    const four = withLampCount(defaultLook(), 4);
    expect(four.lamps[3]?.up).toBe(60);
    expect(withLampCount(four, 1).lamps).toEqual([defaultLook().lamps[0]]);
    expect(withLampCount(withLampCount(four, 1), 2)).toEqual(defaultLook());
  });

  it("tells colours as the page's inputs do", () => {
    expect(hexOf([1, 0.5, 0])).toBe("#ff8000");
    expect(rgbOf("#ff8000")[1]).toBeCloseTo(0.502, 3);
    expect(rgbOf("red")).toEqual([0, 0, 0]);
  });
});
