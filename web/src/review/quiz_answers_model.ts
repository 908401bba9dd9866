// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How somebody goes on in the view quiz: which answers count, the share that was right of the last ones, and
// the same as a file.
import type { AnsweredQuestion } from "../protocol";
import { cell, dayOf, NOT_NAMED, type ReviewFilter } from "./review_model";

/** So many answers make a share. */
export const LAST = 10;

export function playerOf(answer: Pick<AnsweredQuestion, "trainee">): string {
  return answer.trainee === "" ? NOT_NAMED : answer.trainee;
}

/** What the filter leaves but for who answered; oldest first. The quiz knows no procedure and no mode. */
export function answersInScope(
  answers: readonly AnsweredQuestion[],
  filter: ReviewFilter,
): AnsweredQuestion[] {
  return answers
    .filter((answer) => {
      const day = dayOf(answer.answered_at);
      return (
        (filter.case === "" || answer.case === filter.case) &&
        (filter.from === "" || day >= filter.from) &&
        (filter.to === "" || day <= filter.to)
      );
    })
    .sort((a, b) => a.id - b.id);
}

/** The same seed asks the same questions: of each, a person's first answer counts. */
export function firstAnswers(answers: readonly AnsweredQuestion[]): AnsweredQuestion[] {
  const known = new Set<string>();
  return answers.filter((answer) => {
    const question = JSON.stringify([
      answer.trainee,
      answer.case_fingerprint,
      answer.seed,
      answer.number,
    ]);
    if (known.has(question)) return false;
    known.add(question);
    return true;
  });
}

/** After each answer the share of the last LAST ones for which it holds, 0 to 100. */
export function shareOfLast(holds: readonly boolean[]): number[] {
  return holds.map((_, index) => {
    const last = holds.slice(Math.max(0, index + 1 - LAST), index + 1);
    return (100 * last.filter(Boolean).length) / last.length;
  });
}

export interface QuizFigures {
  readonly name: string;
  readonly answers: number;
  /** Shares, undefined where nothing was asked of that kind. */
  readonly place: number | undefined;
  readonly view: number | undefined;
  /** Of screws that were out: called out, wherever. */
  readonly found: number | undefined;
  /** Of screws that were in: called in. */
  readonly cleared: number | undefined;
  readonly falseSafety: number;
  readonly views: number | undefined;
}

function share(
  answers: readonly AnsweredQuestion[],
  holds: (answer: AnsweredQuestion) => boolean,
): number | undefined {
  return answers.length === 0 ? undefined : answers.filter(holds).length / answers.length;
}

function figuresOf(name: string, answers: readonly AnsweredQuestion[]): QuizFigures {
  const isIn = (answer: AnsweredQuestion): boolean => answer.place === "inside";
  return {
    name,
    answers: answers.length,
    place: share(answers, (answer) => answer.is_place_right),
    view: share(answers, (answer) => answer.is_view_right),
    found: share(
      answers.filter((answer) => !isIn(answer)),
      (answer) => !answer.is_false_safety,
    ),
    cleared: share(answers.filter(isIn), (answer) => answer.is_place_right),
    falseSafety: answers.filter((answer) => answer.is_false_safety).length,
    views:
      answers.length === 0
        ? undefined
        : answers.reduce((sum, answer) => sum + answer.views_taken, 0) / answers.length,
  };
}

/** @param answers  in scope, the first of each question. */
export function compareQuiz(
  answers: readonly AnsweredQuestion[],
  trainee: string,
): readonly QuizFigures[] {
  if (trainee === "") {
    const names = [...new Set(answers.map(playerOf))].sort((a, b) => a.localeCompare(b, "en"));
    const each = names.map((name) =>
      figuresOf(
        name,
        answers.filter((answer) => playerOf(answer) === name),
      ),
    );
    return names.length > 1 ? [figuresOf("All trainees", answers), ...each] : each;
  }
  const own = answers.filter((answer) => playerOf(answer) === trainee);
  const others = answers.filter((answer) => playerOf(answer) !== trainee);
  const rows = [figuresOf(trainee, own)];
  if (own.length >= 2 * LAST) {
    rows.push(figuresOf(`First ${LAST}`, own.slice(0, LAST)));
    rows.push(figuresOf(`Last ${LAST}`, own.slice(-LAST)));
  }
  if (others.length > 0) rows.push(figuresOf("Others", others));
  return rows;
}

const COLUMNS = [
  "id",
  "answered_at",
  "trainee",
  "case",
  "case_fingerprint",
  "seed",
  "number",
  "place",
  "depth_mm",
  "answered",
  "is_place_right",
  "is_false_safety",
  "next_view",
  "is_view_right",
  "views_taken",
] as const satisfies readonly (keyof AnsweredQuestion)[];

export function quizCsv(answers: readonly AnsweredQuestion[]): string {
  const rows = answers.map((answer) => COLUMNS.map((column) => cell(answer[column])).join(","));
  return [COLUMNS.join(","), ...rows, ""].join("\r\n");
}

export function quizJson(answers: readonly AnsweredQuestion[]): string {
  return `${JSON.stringify({ answers, older: false }, undefined, 2)}\n`;
}
