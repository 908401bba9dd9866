// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import type { SkinMessage } from "../protocol";
import { skinWords, whyHeldBySkin, whyNotSwung, worksOnSkin } from "./skin_words_model";

const still: SkinMessage["hands"][number] = {
  felt: "nothing",
  firm_share: 0,
  on_skin_mm: [0, 0, 0],
  out_of_skin: [0, 0, 1],
  under_mm: 0,
  is_wet: false,
  is_spreading: false,
};

describe("skinWords", () => {
  it("says what a finger feels, and nothing where it does not press", () => {
    expect(skinWords(still, "palpate")).toBe("");
    expect(skinWords({ ...still, felt: "soft" }, "palpate")).toBe("soft");
    expect(skinWords({ ...still, felt: "bone" }, "palpate")).toContain("bone");
    expect(skinWords({ ...still, felt: "bone" }, "needle")).toBe("");
  });
  it("says how deep a needle is, and that fluid comes back", () => {
    expect(skinWords({ ...still, under_mm: 4.26 }, "needle")).toBe("needle 4.3 mm in");
    expect(skinWords({ ...still, under_mm: 9, is_wet: true }, "needle")).toContain("fluid");
  });
  it("tells an open clamp from a closed one", () => {
    expect(skinWords({ ...still, under_mm: 6 }, "spread")).toContain("closed");
    expect(skinWords({ ...still, under_mm: 6, is_spreading: true }, "spread")).toContain("open");
  });
});

describe("whyHeldBySkin", () => {
  it("holds what is deep and goes straight, and nothing else", () => {
    expect(whyHeldBySkin({ ...still, under_mm: 6 }, "needle")).toContain("{KeyD}");
    expect(whyHeldBySkin({ ...still, under_mm: 1 }, "needle")).toBeUndefined();
    expect(whyHeldBySkin({ ...still, under_mm: 6 }, "incise")).toBeUndefined();
    expect(whyHeldBySkin(undefined, "sheath")).toBeUndefined();
  });
});

describe("whyNotSwung", () => {
  it("lets a fingertip go round, and nothing that pricks, cuts or inks", () => {
    expect(whyNotSwung("palpate")).toBeUndefined();
    expect(whyNotSwung("none")).toBeUndefined();
    for (const work of ["mark", "needle", "incise", "spread", "sheath"] as const)
      expect(whyNotSwung(work)).toContain("fingertip");
  });
});

describe("worksOnSkin", () => {
  it("goes by what lies on the tray", () => {
    expect(worksOnSkin([{ skin_work: "none" }])).toBe(false);
    expect(worksOnSkin([{ skin_work: "none" }, { skin_work: "mark" }])).toBe(true);
  });
});
