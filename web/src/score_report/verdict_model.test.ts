// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { answerText, mustHaveWords, showsCartilage, verdictText } from "./verdict_model";

describe("verdictText", () => {
  const text = (
    good: boolean,
    isVoid: boolean | null,
    declined: readonly string[] | null,
    axisMm = 26,
  ): string =>
    verdictText({
      fixation_acceptable: good,
      is_void: isVoid,
      declined_for: declined,
      central_axis_length_mm: axisMm,
    });

  it("tells a fixation", () => {
    expect(text(true, null, null)).toContain("fixation is acceptable");
    expect(text(false, null, null)).toContain("not acceptable");
    expect(text(false, true, null)).toContain("before a screw was in");
  });

  it("speaks of no fixation where nothing was to be fixed", () => {
    for (const said of [text(true, null, null, 0), text(false, null, null, 0)]) {
      expect(said).toMatch(/condition.* below/);
      expect(said).not.toContain("fixation");
    }
    expect(text(false, true, null, 0)).toContain("Void");
    expect(text(false, true, null, 0)).not.toContain("screw");
  });

  it("tells a decline, right, wrong, and made without a look", () => {
    expect(text(true, null, ["It is flexed"])).toBe("✓ Declined, rightly.");
    expect(text(true, null, ["It is flexed"], 0)).toBe("✓ Declined, rightly.");
    expect(text(false, true, ["It is flexed"], 0)).toContain("declined before it was looked at");
    expect(text(false, null, ["There is no fracture"])).toContain("not as it should be");
    expect(text(false, true, ["There is no fracture"])).toContain("before it was looked at");
  });
});

describe("answerText", () => {
  it("says what was right and why", () => {
    const answer = {
      title: "Old humpback",
      right_answer: "decline",
      reason: "It is flexed.",
    } as const;
    expect(answerText(answer)).toBe(
      "Old humpback. Right is to decline, and to say why. It is flexed.",
    );
    expect(answerText(null)).toBe("");
  });
});

describe("mustHaveWords", () => {
  it("tells what nothing could be judged by apart from what is broken", () => {
    expect(mustHaveWords({ fulfilled: true, not_measured: null }).after).toBe("");
    expect(mustHaveWords({ fulfilled: false, not_measured: null }).after).toBe(": not fulfilled");
    const unjudged = mustHaveWords({ fulfilled: false, not_measured: true });
    expect(unjudged).toEqual({ sign: "–", kind: "secondary", after: ": not judged" });
  });
});

describe("showsCartilage", () => {
  it("is where it was looked at, or scuffed", () => {
    const scuff = { body: "lunate", at_mm: [0, 0, 0], how: "shaved", t_s: 1 };
    expect(showsCartilage({ items: [], scuffs: null })).toBe(false);
    expect(showsCartilage({ items: [], scuffs: [] })).toBe(false);
    expect(showsCartilage({ items: [], scuffs: [scuff] as never })).toBe(true);
  });
});
