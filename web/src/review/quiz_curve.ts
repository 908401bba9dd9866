// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The view quiz question by question: the share that was right of the last ten, where and which view, and
// each false safety.
import { makeSvg } from "../dom";
import type { AnsweredQuestion } from "../protocol";
import {
  cross,
  frame,
  LEFT,
  level,
  line,
  numbers,
  placing,
  RIGHT,
  text,
  TOP,
  WIDTH,
} from "./curve_frame";
import { LAST, shareOfLast } from "./quiz_answers_model";

/** Of four places, one is right by chance. */
const CHANCE = 25;
const HEIGHT = 220;

/** @param answers  of one or of all, oldest first, at least one. */
export function quizCurve(answers: readonly AnsweredQuestion[]): SVGElement {
  const place = placing(answers.length, HEIGHT, 0, 100);
  const places = shareOfLast(answers.map((answer) => answer.is_place_right));
  const views = shareOfLast(answers.map((answer) => answer.is_view_right));
  const points = (shares: readonly number[]): (readonly [number, number])[] =>
    shares.map((share, index) => place(index, share));
  const grid = [0, 50, 100].flatMap((value) => {
    const y = place(0, value)[1];
    return [
      makeSvg("line", { x1: LEFT, x2: WIDTH - RIGHT, y1: y, y2: y, class: "curve-grid" }),
      text(LEFT - 8, y + 4, `${value} %`, "curve-number", "end"),
    ];
  });
  const last = Math.round(places.at(-1) ?? 0);
  return frame(
    HEIGHT,
    `${answers.length} questions answered; of the last ${LAST}, ${last} % of the places right`,
    ...grid,
    ...level(place, CHANCE, "by chance 25 %", "curve-mark"),
    line(points(views), "curve-view"),
    line(points(places), "curve-own"),
    ...answers.flatMap((answer, index) => {
      const [x, y] = place(index, places[index] ?? 0);
      return answer.is_false_safety
        ? [cross(x, y)]
        : [makeSvg("circle", { cx: x, cy: y, r: 3, class: "curve-dot" })];
    }),
    ...numbers(answers.length, place, HEIGHT - 4),
    text(LEFT, TOP - 8, `Right of the last ${LAST}`, "curve-number"),
  );
}
