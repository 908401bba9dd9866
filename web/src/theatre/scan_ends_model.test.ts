// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { scanEnds, UNCUT_MM } from "./scan_ends_model";

/** A square tube along z with a flat end at z = 0 and a pointed one at z = 50. */
const POSITIONS = [
  ...[-10, -10, 0, 10, -10, 0, 10, 10, 0, -10, 10, 0],
  ...[-10, -10, 40, 10, -10, 40, 10, 10, 40, -10, 10, 40],
  ...[0, 0, 50],
];
const END = [0, 2, 1, 0, 3, 2];
const POINT = [4, 5, 8, 5, 6, 8, 6, 7, 8, 7, 4, 8];

describe("ends of the scan", () => {
  it("are where the skin is flat at its bounds", () => {
    const { low, high } = scanEnds(POSITIONS, [...END, ...POINT]);
    expect(low).toEqual([-UNCUT_MM, -UNCUT_MM, 0]);
    expect(high).toEqual([UNCUT_MM, UNCUT_MM, UNCUT_MM]);
  });

  it("are nowhere on a skin that only reaches its bounds", () => {
    expect(scanEnds(POSITIONS, POINT).low[2]).toBe(-UNCUT_MM);
  });
});
