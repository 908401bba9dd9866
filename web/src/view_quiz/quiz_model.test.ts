// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import type { QuizTruthMessage } from "../protocol";
import {
  polygonPoints,
  seedOf,
  tallyRows,
  truthText,
  verdictText,
  viewOfPicture,
  viewVerdictText,
} from "./quiz_model";

const views = [
  { id: "pa", label: "PA", name: "PA", rotation_deg: 0, tilt_deg: 0 },
  { id: "skyline", label: "SKY", name: "skyline", rotation_deg: 0, tilt_deg: -60 },
];
const tally = { answers: 5, right_places: 4, right_views: 3, false_safety: 1, views_taken: 8 };
const truth: QuizTruthMessage = {
  type: "quiz_truth",
  number: 5,
  place: "distal",
  depth_mm: 1.26,
  towards: "trapezium",
  answered: "inside",
  next_view: "pa",
  is_place_right: false,
  is_view_right: false,
  is_false_safety: true,
  best_view: "skyline",
  revealed_mm: 0.5,
  views: [
    { view: "pa", overhang_mm: -0.4, reveals: false, bone: [], screw: { pixels: [] } },
    { view: "skyline", overhang_mm: 1.1, reveals: true, bone: [], screw: { pixels: [] } },
  ],
  tally,
};

describe("what is said of an answer", () => {
  it("tells the truth in mm and calls false safety by its name", () => {
    expect(truthText(truth)).toBe("It is out at its distal end by 1.3 mm, towards the trapezium.");
    expect(verdictText(truth)).toMatch(/^False safety/);
    expect(viewVerdictText(truth, views)).toBe(
      "Another view would tell: PA hides it behind the bone's own outline; best is skyline.",
    );
  });
  it("tells of a screw that is in how well it is covered", () => {
    const inside: QuizTruthMessage = {
      ...truth,
      place: "inside",
      depth_mm: -0.84,
      is_place_right: true,
      is_false_safety: false,
    };
    expect(truthText(inside)).toContain("at least 0.8 mm of bone");
    expect(verdictText(inside)).toBe("Right: in.");
    expect(viewVerdictText(inside, views)).toContain("skyline shows it best");
  });
  it("counts", () => {
    expect(tallyRows(tally)[0]).toEqual(["Where", "4 of 5"]);
    expect(tallyRows(tally)[2]).toEqual(["False safety", "1"]);
  });
});

describe("pictures and addresses", () => {
  it("knows a picture's view by its angles", () => {
    expect(viewOfPicture(views, 0.1, -60)).toBe(1);
    expect(viewOfPicture(views, 45, 0)).toBeUndefined();
  });
  it("puts corners into the middle of pixels", () => {
    expect(polygonPoints([1, 2, 3.5, 4])).toBe("1.5,2.5 4,4.5");
  });
  it("reads a seed and nothing else", () => {
    expect(seedOf("#/views?seed=7")).toBe(7);
    expect(seedOf("#/views")).toBeUndefined();
    expect(seedOf("#/views?seed=99999999999")).toBeUndefined();
  });
});
