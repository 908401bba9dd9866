// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The list keeps the host's numbers and passes over what it cannot read.
import { describe, expect, it } from "vitest";
import { parseScrews } from "./screws_model";

const screw = { name: "A 20 mm", length_mm: 20, tip_diameter_mm: 3.3, tail_diameter_mm: 3.8 };

describe("parseScrews", () => {
  it("reads a list and an object that holds one", () => {
    expect(parseScrews([screw])[0]).toMatchObject({ index: 0, lengthMm: 20, confirmed: false });
    expect(parseScrews({ screws: [screw] }).length).toBe(1);
  });

  it("keeps positions where an entry is broken", () => {
    expect(parseScrews([{ name: "?" }, screw]).map((s) => s.index)).toEqual([1]);
    expect(parseScrews([{ ...screw, index: 9 }])[0]?.index).toBe(9);
  });

  it.each([null, 3, "x", {}, { screws: 3 }])("takes %j as an empty tray", (json) => {
    expect(parseScrews(json)).toEqual([]);
  });
});
