// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The view quiz in the review room: a curve, figures beside the others', and the answers as files.
import { button, make } from "../dom";
import type { AnsweredQuestion } from "../protocol";
import { quizCurve } from "./quiz_curve";
import {
  answersInScope,
  compareQuiz,
  firstAnswers,
  LAST,
  playerOf,
  quizCsv,
  quizJson,
  type QuizFigures,
} from "./quiz_answers_model";
import type { ReviewFilter } from "./review_model";

const HEADS = [
  "Who",
  "Questions",
  "Where, right",
  "View, right",
  "Of those out, found",
  "Of those in, called in",
  "False safety",
  "Views each",
];

/** @param save  gives a text to the reader as a file */
export function quizSection(
  answers: readonly AnsweredQuestion[],
  filter: ReviewFilter,
  save: (text: string, name: string) => void,
): HTMLElement {
  const scope = answersInScope(answers, filter);
  const counted = firstAnswers(scope);
  const isShown = (answer: AnsweredQuestion): boolean =>
    filter.trainee === "" || playerOf(answer) === filter.trainee;
  const own = counted.filter(isShown);
  const head = make("h2", { id: "quiz-title" }, "View quiz");
  const section = make("section.review-quiz", { "aria-labelledby": "quiz-title" }, head);
  if (own.length === 0) {
    const quiz = make("a", { href: "#/views" }, "To the view quiz");
    section.append(make("p.secondary", {}, "No question was answered yet. ", quiz));
    return section;
  }
  const repeated = scope.filter(isShown).length - own.length;
  section.append(
    quizCurve(own),
    make(
      "p.secondary.curve-legend",
      {},
      make("span.strip-key.quiz-place", {}),
      `where the screw is, of the last ${LAST} `,
      make("span.strip-key.quiz-view", {}),
      "which view would tell ",
      make("span.harm", {}, "✕"),
      " called in, and it was out.",
      repeated === 0
        ? ""
        : ` ${repeated} answered again ${repeated === 1 ? "is" : "are"} not counted.`,
    ),
    make(
      "div.table-frame",
      { tabindex: "0", role: "region", "aria-label": "Table of the view quiz" },
      table(compareQuiz(counted, filter.trainee)),
    ),
    make(
      "p.quiz-files",
      {},
      button("Quiz answers as CSV", "", () => {
        save(quizCsv(scope.filter(isShown)), "carpus-view-quiz.csv");
      }),
      button("as JSON", "", () => {
        save(quizJson(scope.filter(isShown)), "carpus-view-quiz.json");
      }),
    ),
  );
  return section;
}

function table(rows: readonly QuizFigures[]): HTMLElement {
  const percent = (value: number | undefined): HTMLElement =>
    make("td.figure", {}, value === undefined ? "–" : `${Math.round(100 * value)} %`);
  return make(
    "table.review-compare",
    {},
    make("thead", {}, make("tr", {}, ...HEADS.map((head) => make("th", { scope: "col" }, head)))),
    make(
      "tbody",
      {},
      ...rows.map((row) =>
        make(
          "tr",
          {},
          make("th", { scope: "row" }, row.name),
          make("td.figure", {}, String(row.answers)),
          percent(row.place),
          percent(row.view),
          percent(row.found),
          percent(row.cleared),
          make("td.figure", {}, String(row.falseSafety)),
          make("td.figure", {}, row.views === undefined ? "–" : row.views.toFixed(1)),
        ),
      ),
    ),
  );
}
