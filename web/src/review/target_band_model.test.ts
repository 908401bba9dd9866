// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { bandOf } from "./target_band_model";

describe("bandOf", () => {
  it.each([
    ["at most 16.7 % good, over 33.3 % fails", "%", -Infinity, 16.7],
    ["at most 5° good, over 15° fails", "deg", -Infinity, 5],
    ["at least 1 mm good, under 0 mm fails", "mm", 1, Infinity],
    ["at least 4 good, under 3 fails", "1", 4, Infinity],
    ["none; a single one fails", "1", -Infinity, 0],
    ["none is good, over 2 fails", "1", -Infinity, 0],
    ["1.25 to 2.75 mm good; under 0.5 mm or over 6 mm fails", "mm", 1.25, 2.75],
    ["-1 to 0 mm good; under -4.5 mm or over 0.1 mm fails", "mm", -1, 0],
    ["at most 10 min good, over 30 min fails", "s", -Infinity, 600],
    ["at most 20 cGy cm² good, over 45.6 cGy cm² fails", "cGy cm2", -Infinity, 20],
  ])("of '%s'", (target, unit, from, to) => {
    expect(bandOf(target, unit)).toEqual({ from, to });
  });
  it("has none of what says no limit", () => {
    expect(bandOf("as short as it may be", "mm")).toBeUndefined();
    expect(bandOf("", "mm")).toBeUndefined();
  });
});
