// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Figures as people write them, and no figure where none was measured.
import { describe, expect, it } from "vitest";
import { longestLineText, valueText } from "./score_model";

describe("longestLineText", () => {
  it("tells angle and length, and what was not measured", () => {
    expect(longestLineText({ longest_line_mm: 27.46, angle_to_longest_line_deg: 6.25 })).toBe(
      "To the longest line through the bone, 27.5 mm: 6.3°",
    );
    expect(longestLineText({ longest_line_mm: 27, angle_to_longest_line_deg: null })).toBe(
      "To the longest line through the bone, 27.0 mm: not measured",
    );
  });
});

describe("valueText", () => {
  it("writes units as people do", () => {
    expect(valueText({ value: 4.25, unit: "deg" })).toBe("4.3°");
    expect(valueText({ value: 125.4, unit: "s" })).toBe("2 min 5 s");
    expect(valueText({ value: 2, unit: "1" })).toBe("2");
    expect(valueText({ value: 3.5, unit: "cGy cm2" })).toBe("3.5 cGy cm²");
    expect(valueText({ value: null, unit: "mm" })).toBe("not measured");
  });
});
