// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import {
  answersOf,
  chosenOf,
  DOMAINS,
  HIGHEST_TOTAL,
  LEVELS,
  lowDomains,
  missingRows,
  ROWS,
  standingText,
  stepText,
  summaryText,
  totalOf,
  verdictText,
} from "./asset_model";

/** All rows at most at so many points. */
const all = (points: number): Map<string, number> =>
  new Map(ROWS.map(({ id, highest }) => [id, Math.min(points, highest)]));

describe("the form", () => {
  it("has eight domains that make 38, and what is not counted", () => {
    expect(DOMAINS).toHaveLength(8);
    expect(ROWS).toHaveLength(9);
    expect(totalOf(all(5))).toBe(HIGHEST_TOTAL);
    expect(LEVELS).toEqual([
      [1, "novice"],
      [3, "competent"],
      [5, "expert"],
    ]);
  });
  it("says which rows are missing", () => {
    expect(standingText(new Map())).toBe("Nothing chosen yet.");
    const most = all(4);
    most.delete("autonomy");
    most.delete("complexity");
    expect(missingRows(most)).toHaveLength(2);
    expect(standingText(most)).toBe("Missing: Autonomy, Added complexity of procedure.");
  });
  it("passes where each domain has three, whatever the sum", () => {
    expect(standingText(all(3))).toContain("✓ Passes");
    const one = all(5);
    one.set("safety", 2).set("autonomy", 2);
    expect(totalOf(one)).toBe(34);
    expect(lowDomains(one).map(({ id }) => id)).toEqual(["safety", "autonomy"]);
    expect(standingText(one)).toBe(
      "✕ Does not pass: Safety is 2, Autonomy is 2; each of the eight must be 3 or better.",
    );
  });
  it("does not count how hard the case was", () => {
    const hard = all(3);
    expect(totalOf(hard)).toBe(24);
    hard.set("complexity", 1);
    expect(totalOf(hard)).toBe(24);
    expect(standingText(hard)).toContain("✓ Passes");
  });
  it("writes and reads its answers", () => {
    const chosen = new Map([
      ["autonomy", 2],
      ["safety", 4],
      ["of a newer form", 1],
    ]);
    const answers = answersOf(chosen);
    expect(answers).toEqual([
      { domain: "safety", points: 4 },
      { domain: "autonomy", points: 2 },
    ]);
    expect(answersOf(chosenOf({ answers }))).toEqual(answers);
  });
});

describe("its words", () => {
  it("say what a step is, or between which it lies", () => {
    const [safety] = DOMAINS;
    const autonomy = DOMAINS.at(-1);
    if (safety === undefined || autonomy === undefined) throw new Error("no rows");
    expect(stepText(safety, 5)).toBe("Harms nothing at all");
    expect(stepText(safety, 2)).toBe("Between novice and competent");
    expect(stepText(safety, 4)).toBe("Between competent and expert");
    expect(stepText(autonomy, 2)).toBe("Finished, with help or words on the way");
  });
  it("tell one form's verdict, and several together", () => {
    expect(verdictText({ passes: null })).toBe("unfinished");
    expect(verdictText({ passes: true })).toBe("✓ passes");
    expect(verdictText({ passes: false })).toBe("✕ does not pass");
    expect(summaryText(null)).toBe("");
    expect(summaryText({ forms: 1, passed: 1, mean_total: 31 })).toBe("31 of 38 ✓");
    expect(summaryText({ forms: 1, passed: 0, mean_total: 31 })).toBe("31 of 38 ✕");
    expect(summaryText({ forms: 3, passed: 2, mean_total: 28.333 })).toBe(
      "28.3 of 38, 2 of 3 pass",
    );
  });
});
