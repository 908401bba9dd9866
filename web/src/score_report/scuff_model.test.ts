// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import type { ScuffedPlace } from "../protocol";
import { moreText, scuffRows } from "./scuff_model";

const pressed: ScuffedPlace = {
  bone: "scaphoid_proximal",
  at_mm: [1, 2, 3],
  tick: 83_400,
  how: "pressed",
  force_n: 9.13,
  instrument: "Hook probe",
};

describe("scuffed cartilage", () => {
  it("is told by bone, force and instrument, with its number in the view", () => {
    const [first, second] = scuffRows(
      [pressed, { ...pressed, how: "bitten", force_n: 0, instrument: "Punch" }],
      7,
    );
    expect(first).toMatchObject({
      number: "1",
      bone: "scaphoid proximal",
      how: "pressed with up to 9.1 N, Hook probe",
    });
    expect(second).toMatchObject({ number: "2", how: "bitten, Punch" });
  });

  it("leads into the replay a moment before, and not before its begin", () => {
    expect(scuffRows([pressed], 7)[0]?.replay).toBe("#/replay/7?t=81.4");
    expect(scuffRows([{ ...pressed, tick: 500 }], 7)[0]?.replay).toBe("#/replay/7?t=0.0");
  });

  it("says how many have no place", () => {
    expect(moreText(32, 35)).toBe("and 3 more, whose places were not kept");
    expect(moreText(2, 2)).toBe("");
    expect(moreText(2, null)).toBe("");
  });
});
