// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { cardText, difficultyText, doubtText } from "./card_text_model";

describe("difficultyText", () => {
  it("puts the figure into words", () => {
    expect(difficultyText(16.4)).toBe("Difficulty 16 of 100: straightforward");
    expect(difficultyText(52)).toBe("Difficulty 52 of 100: demanding");
    expect(difficultyText(86)).toBe("Difficulty 86 of 100: hard");
  });

  it("says nothing where nothing was measured", () => {
    expect(difficultyText(null)).toBe("");
  });
});

describe("doubtText", () => {
  it("names up to three bones and counts more", () => {
    expect(doubtText([])).toBe("");
    expect(doubtText(["metacarpal1"])).toBe("Check the metacarpal 1 on its scan");
    expect(doubtText(["lunate", "capitate"])).toBe("Check the lunate and the capitate on its scan");
    expect(doubtText(["a", "b", "c", "d"])).toBe("Check 4 bones on its scan");
  });
});

describe("cardText", () => {
  const one = {
    id: "humpback_right",
    title: "Old humpback",
    history: "Fell two years ago.",
    goal: "Know when not to.",
    difficulty: 43,
    flagged: [],
    has_preview: true,
  };

  it("says in practice what is to be learnt", () => {
    expect(cardText(one, 8, "practice")).toMatchObject({
      title: "Old humpback",
      what: "Know when not to.",
    });
  });

  it("gives no diagnosis away to whoever is to be assessed by it", () => {
    const told = Object.values(cardText(one, 8, "assessed")).join(" ");
    expect(told.replace(/ +/g, " ")).toBe(
      "Case 9 Difficulty 43 of 100: demanding Fell two years ago.",
    );
  });
});
