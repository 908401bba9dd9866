// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { earlierVersion, rememberVersion } from "./earlier_version";
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

describe("the version before", () => {
  const store = (): Storage => {
    const all = new Map<string, string>();
    return {
      getItem: (key: string) => all.get(key) ?? null,
      setItem: (key: string, value: string) => all.set(key, value),
    } as unknown as Storage;
  };

  it("is remembered as long as there is such a case", () => {
    const kept = store();
    rememberVersion("demo-2", "demo", kept);
    rememberVersion("demo-3", "demo-2", kept);
    expect(earlierVersion("demo-3", ["demo", "demo-2"], kept)).toBe("demo-2");
    expect(earlierVersion("demo-2", ["demo", "demo-2"], kept)).toBe("demo");
    expect(earlierVersion("demo-3", ["demo"], kept)).toBeUndefined();
    expect(earlierVersion("demo", ["demo"], kept)).toBeUndefined();
  });

  it("is nothing where what was kept is damaged", () => {
    const kept = store();
    kept.setItem("carpus.versions", "{");
    expect(earlierVersion("a", ["b"], kept)).toBeUndefined();
    rememberVersion("a", "b", kept);
    expect(earlierVersion("a", ["b"], kept)).toBe("b");
  });
});
