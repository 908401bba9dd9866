// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import type { Finding, PreparedPathology } from "../protocol";
import { draftOf, heldText, problemOf, wishOf, withGrade } from "./pathology_model";

const FINDINGS: readonly Finding[] = [
  {
    id: "scapholunate",
    label: "Scapholunate ligament",
    scale: "Geissler",
    grades: [
      { id: "0", label: "intact" },
      { id: "III", label: "III: step in both joints" },
    ],
  },
  {
    id: "loose_body",
    label: "Loose body",
    scale: "",
    grades: [
      { id: "0", label: "none" },
      { id: "1", label: "there is one" },
    ],
  },
];
const RANDOM: PreparedPathology = { origin: "random", seed: null, grades: [] };
const TORN: PreparedPathology = {
  origin: "chosen",
  seed: 7,
  grades: [{ finding: "scapholunate", grade: "III" }],
};

describe("draftOf and wishOf", () => {
  it("give back what the case holds", () => {
    for (const one of [RANDOM, TORN, { ...TORN, grades: [] }]) {
      expect(wishOf(draftOf(one))).toEqual(one);
    }
  });

  it("leave the grades of a number to the host", () => {
    const drawn: PreparedPathology = { ...TORN, origin: "seed" };
    expect(wishOf(draftOf(drawn))).toEqual({ origin: "seed", seed: 7, grades: [] });
  });

  it("know a healthy wrist as one of which nothing was chosen", () => {
    expect(draftOf({ ...TORN, grades: [] }).kind).toBe("healthy");
    expect(wishOf({ ...draftOf(TORN), kind: "healthy" }).grades).toEqual([]);
  });

  it("never send grades that are not shown", () => {
    expect(wishOf({ ...draftOf(TORN), kind: "random" })).toEqual(RANDOM);
  });
});

describe("withGrade", () => {
  it("sets one, and takes it back where it is well", () => {
    const draft = withGrade(draftOf(TORN), "loose_body", "1");
    expect(wishOf(draft).grades).toHaveLength(2);
    expect(wishOf(withGrade(draft, "scapholunate", "0")).grades).toEqual([
      { finding: "loose_body", grade: "1" },
    ]);
  });
});

describe("problemOf", () => {
  it("takes whole numbers alone, and only where one counts", () => {
    for (const seed of ["0", "7", " 42 "]) {
      expect(problemOf({ ...draftOf(TORN), kind: "seed", seed })).toBe("");
    }
    for (const seed of ["", "-1", "1.5", "x", "9007199254740992"]) {
      expect(problemOf({ ...draftOf(TORN), kind: "seed", seed })).toContain("whole");
      expect(problemOf({ ...draftOf(TORN), kind: "chosen", seed })).toBe("");
    }
  });
});

describe("heldText", () => {
  it("says what examinations will find", () => {
    expect(heldText(RANDOM, FINDINGS)).toBe("Each examination draws anew what is wrong.");
    expect(heldText(TORN, FINDINGS)).toBe(
      "Prepared, the same in each examination: Scapholunate ligament III.",
    );
    expect(heldText({ ...TORN, grades: [] }, FINDINGS)).toContain("nothing is wrong");
    const drawn: PreparedPathology = {
      origin: "seed",
      seed: 9,
      grades: [{ finding: "loose_body", grade: "1" }],
    };
    expect(heldText(drawn, FINDINGS)).toBe(
      "Drawn by number 9, the same in each examination: Loose body: there is one.",
    );
  });
});
