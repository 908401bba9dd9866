// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Named views by name, any other by its angles.
import { describe, expect, it } from "vitest";
import { narrowViewName, signed, viewName, wrapped } from "./view_name_model";

const asItIs = { flexion_deg: null, radial_deviation_deg: null };
const views = [
  { id: "pa", label: "PA", rotation_deg: 0, tilt_deg: 0, ...asItIs },
  { id: "sky", label: "SKY", rotation_deg: 0, tilt_deg: -60, ...asItIs },
];

describe("viewName", () => {
  it("tells views of one rotation apart by their tilt", () => {
    expect(viewName(views, 0.1, 0)).toBe("PA");
    expect(viewName(views, 0, -60)).toBe("SKY");
  });
  it("names the angles of any other", () => {
    expect(viewName(views, 15, -5)).toBe("+15° / −5°");
    expect(signed(-0.2)).toBe("0°");
    expect(narrowViewName(views, 100, -5)).toBe("+100°\n−5°");
    expect(narrowViewName(views, 0, 0)).toBe("PA");
  });
});

describe("wrapped", () => {
  it("stays within half a turn", () => {
    expect([185, -180, 180, 540, -5].map(wrapped)).toEqual([-175, 180, 180, 180, -5]);
  });
});
