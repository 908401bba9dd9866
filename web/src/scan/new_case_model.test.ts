// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { parseState, progressText, seriesFigures, seriesTitle } from "./new_case_model";

describe("what the host tells of a new case", () => {
  it("is read without belief", () => {
    const state = parseState('{"state":3,"fraction":-2,"series":[{"slices":"x"}]}');
    expect(state).toEqual({
      state: "",
      doing: "",
      fraction: 0,
      id: "",
      problem: "",
      series: [{ description: "", slices: 0, spacingMm: [] }],
    });
    expect(parseState('{"fraction":1e9}').fraction).toBe(1);
  });

  it("is said in words", () => {
    const known = { description: "Wrist 0.6 B70", slices: 214, spacingMm: [0.3, 0.3, 0.5] };
    expect(seriesTitle(known)).toBe("Wrist 0.6 B70");
    expect(seriesFigures(known)).toBe("214 slices, voxels of 0.30 × 0.30 × 0.50 mm");
    expect(seriesTitle({ ...known, description: " " })).toBe("without a description");
    expect(seriesFigures({ ...known, spacingMm: [0.3, 0.3, 0] })).toBe(
      "214 slices, spacing not known",
    );
    expect(progressText("surfaces", 0.426)).toBe("surfaces: 43 %");
  });
});
