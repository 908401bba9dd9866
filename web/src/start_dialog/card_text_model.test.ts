// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { cardText, difficultyText, doubtText, scanDoubts } from "./card_text_model";

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

describe("scanDoubts", () => {
  const ofScan = ["the wrist is 70 % of an adult's size", "one body may be a fragment: look"];

  it("says in practice what is to be known of all of the scan, in sentences", () => {
    expect(scanDoubts([], "practice")).toEqual([]);
    expect(scanDoubts(ofScan, "practice")).toEqual([
      "The wrist is 70 % of an adult's size.",
      "One body may be a fragment: look.",
    ]);
  });

  it("says to whoever is to be assessed only that there is something", () => {
    expect(scanDoubts([], "assessed")).toEqual([]);
    expect(scanDoubts(ofScan, "assessed").join(" ")).toMatch(/warnings/);
    expect(scanDoubts(ofScan, "assessed").join(" ")).not.toMatch(/fragment/);
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
    of_scan: [],
    has_preview: true,
  };

  it("says in practice what is to be learnt", () => {
    expect(cardText(one, 8, "practice")).toMatchObject({
      title: "Old humpback",
      what: "Know when not to.",
    });
  });

  it("has what is to be checked and what is to be known of the scan", () => {
    const doubtful = { ...one, flagged: ["lunate"], of_scan: ["not found: pisiform"] };
    expect(cardText(doubtful, 0, "practice").doubts).toEqual([
      "Check the lunate on its scan",
      "Not found: pisiform.",
    ]);
  });

  it("gives no diagnosis away to whoever is to be assessed by it", () => {
    const told = Object.values(cardText(one, 8, "assessed")).join(" ");
    expect(told.replace(/ +/g, " ")).toBe(
      "Case 9 Difficulty 43 of 100: demanding Fell two years ago.",
    );
  });
});
