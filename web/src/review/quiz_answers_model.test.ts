// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import type { AnsweredQuestion } from "../protocol";
import {
  answersInScope,
  compareQuiz,
  firstAnswers,
  quizCsv,
  quizJson,
  shareOfLast,
} from "./quiz_answers_model";
import { NO_FILTER } from "./review_model";

let id = 0;
const answer = (more: Partial<AnsweredQuestion>): AnsweredQuestion => {
  const place = more.place ?? "distal";
  const answered = more.answered ?? place;
  return {
    id: ++id,
    trainee: "Ada",
    case: "demo wrist",
    case_fingerprint: "00",
    seed: 1,
    number: id,
    answered_at: "2026-11-02T10:00:00Z",
    place,
    depth_mm: place === "inside" ? -1 : 1.2,
    answered,
    next_view: "skyline",
    is_place_right: place === answered,
    is_view_right: true,
    is_false_safety: answered === "inside" && place !== "inside",
    views_taken: 2,
    ...more,
  };
};

describe("answers of the view quiz", () => {
  it("are those of the case and the days asked for, oldest first", () => {
    const late = answer({ answered_at: "2026-11-05T10:00:00Z" });
    const early = answer({});
    const elsewhere = answer({ case: "other" });
    const scope = answersInScope([late, elsewhere, early], {
      ...NO_FILTER,
      case: "demo wrist",
      procedure: "dorsal_scaphoid_fixation",
    });
    expect(scope).toEqual([late, early]);
    expect(answersInScope([late, early], { ...NO_FILTER, to: "2026-11-03" })).toEqual([early]);
  });
  it("count once a question and person", () => {
    const first = answer({ number: 3 });
    const again = answer({ number: 3, answered: "inside" });
    const other = answer({ number: 3, trainee: "Bela" });
    const another = answer({ number: 3, seed: 2 });
    expect(firstAnswers([first, again, other, another])).toEqual([first, other, another]);
  });
  it("make a share of the last ten", () => {
    expect(shareOfLast([true, false])).toEqual([100, 50]);
    const late = shareOfLast([...Array<boolean>(10).fill(false), true, true]);
    expect(late.at(-1)).toBe(20);
  });
  it("tell what was missed from what was called out in vain", () => {
    const rows = compareQuiz(
      [
        answer({ place: "distal", answered: "side" }),
        answer({ place: "distal", answered: "inside" }),
        answer({ place: "inside" }),
        answer({ place: "inside", answered: "proximal", trainee: "Bela" }),
      ],
      "Ada",
    );
    expect(rows.map((row) => row.name)).toEqual(["Ada", "Others"]);
    expect(rows[0]).toMatchObject({ answers: 3, found: 0.5, cleared: 1, falseSafety: 1, views: 2 });
    expect(rows[0]?.place).toBeCloseTo(1 / 3);
    expect(rows[1]).toMatchObject({ found: undefined, cleared: 0 });
  });
  it("name everybody where nobody is chosen", () => {
    const rows = compareQuiz([answer({ trainee: "Bela" }), answer({ trainee: "" })], "");
    expect(rows.map((row) => row.name)).toEqual(["All trainees", "Bela", "not named"]);
  });
  it("leave as files", () => {
    const odd = answer({ trainee: "=1+1" });
    const [head, row] = quizCsv([odd]).split("\r\n");
    expect(head).toContain("is_false_safety");
    expect(row).toContain("'=1+1");
    expect(JSON.parse(quizJson([odd]))).toEqual({ answers: [odd], older: false });
  });
});
