// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Whatever the host stored, the page shows what can be read and invents nothing.
import { describe, expect, it } from "vitest";
import { longestLineText, parseScore, valueText } from "./score_model";

const item = {
  id: "angle_to_central_axis_deg",
  label: "Angle to the central axis",
  value: 4.25,
  unit: "deg",
  target: "at most 5° good, over 15° fail",
  grade: "good",
  points: 15,
  points_possible: 15,
  reason: "",
};

describe("parseScore", () => {
  it("reads a report", () => {
    const score = parseScore({
      overall: 81.5,
      fixation_acceptable: true,
      must_haves: [{ id: "angle", label: "Within 15 degrees", fulfilled: true }],
      items: [item],
      true_length_mm: 25.5,
      placement: {
        central_axis: { proximal_mm: [0, 0, 0], distal_mm: [0, 0, 25] },
        wire: { entry_mm: [1, 0, 0], tip_mm: [1, 0, 24] },
        screw: null,
      },
    });
    expect(score).toMatchObject({ overall: 81.5, acceptable: true, trueLengthMm: 25.5 });
    expect(score?.items[0]).toMatchObject({ grade: "good", value: 4.25 });
    expect(score?.placement).toMatchObject({ axisDistalMm: [0, 0, 25], screw: undefined });
  });

  it.each([null, undefined, [], 3, {}, { overall: "90" }])("finds no report in %j", (json) => {
    expect(parseScore(json)).toBeUndefined();
  });

  it("leaves out what is broken and keeps the rest", () => {
    const score = parseScore({ overall: 1, items: [null, 5, {}, item, { id: "x", value: "7" }] });
    expect(score?.items.map((i) => i.id)).toEqual(["angle_to_central_axis_deg", "x"]);
    expect(score?.items[1]).toMatchObject({ value: undefined, grade: "not_measured" });
    expect(score?.placement).toBeUndefined();
  });
});

describe("longestLineText", () => {
  const line = (fields: object): string => {
    const report = parseScore({ overall: 1, ...fields });
    return report === undefined ? "no report" : longestLineText(report);
  };
  it("tells angle and length, and what was not measured", () => {
    expect(line({ longest_line_mm: 27.46, angle_to_longest_line_deg: 6.25 })).toBe(
      "To the longest line through the bone, 27.5 mm: 6.3°",
    );
    expect(line({ longest_line_mm: 27, angle_to_longest_line_deg: null })).toBe(
      "To the longest line through the bone, 27.0 mm: not measured",
    );
  });
  it("says nothing where the report has no such line", () => {
    expect(line({ angle_to_longest_line_deg: 6.25 })).toBe("");
  });
});

describe("valueText", () => {
  it("writes units as people do", () => {
    expect(valueText({ value: 4.25, unit: "deg" })).toBe("4.3°");
    expect(valueText({ value: 125.4, unit: "s" })).toBe("2 min 5 s");
    expect(valueText({ value: 2, unit: "1" })).toBe("2");
    expect(valueText({ value: 3.5, unit: "cGy cm2" })).toBe("3.5 cGy cm²");
    expect(valueText({ value: undefined, unit: "mm" })).toBe("not measured");
  });
});
