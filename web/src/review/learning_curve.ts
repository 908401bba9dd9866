// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Two pictures one above the other, attempt by attempt: the score beside group and expert, and the
// cumulative sum of failures between its limits. SVG, so that they print.
import { makeSvg } from "../dom";
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
import type { CusumLimits, CusumPoint } from "./cusum_model";

export interface CurveData {
  readonly scores: readonly number[];
  readonly group: readonly {
    readonly low: number;
    readonly middle: number;
    readonly high: number;
  }[];
  readonly expert: number | undefined;
  readonly proficient: number;
  readonly flatAfter: readonly {
    readonly from: number;
    readonly to: number;
    readonly text: string;
  }[];
}

export function scoreCurve(data: CurveData): SVGElement {
  const height = 250;
  const { scores } = data;
  const place = placing(scores.length, height, 0, 100);
  const grid = [0, 25, 50, 75, 100].flatMap((value) => {
    const y = place(0, value)[1];
    return [
      makeSvg("line", { x1: LEFT, x2: WIDTH - RIGHT, y1: y, y2: y, class: "curve-grid" }),
      text(LEFT - 8, y + 4, String(value), "curve-number", "end"),
    ];
  });
  const bands = data.flatAfter.map(({ from, to, text: says }, index) => {
    const room = Math.max(10, scores.length);
    const step = (WIDTH - LEFT - RIGHT) / room;
    const x = LEFT + step * (from - 1);
    const width = Math.min(step * (to - from + 1), WIDTH - RIGHT - x);
    if (width <= 0) return [];
    return [
      makeSvg("rect", { x, y: TOP, width, height: height - 2 * TOP, class: "curve-flat" }),
      // The first leans on its right edge, the next on its left: they stand beside each other.
      index === 0
        ? text(x + width - 6, TOP - 6, says, "curve-number", "end")
        : text(x + 6, TOP - 6, says, "curve-number"),
    ];
  });
  const { group } = data;
  const band =
    group.length < 2
      ? []
      : [
          makeSvg("polygon", {
            class: "curve-group",
            points: [
              ...group.map((point, index) => place(index, point.high)),
              ...group.map((point, index) => place(index, point.low)).reverse(),
            ]
              .map(([x, y]) => `${x.toFixed(1)},${y.toFixed(1)}`)
              .join(" "),
          }),
          line(
            group.map((point, index) => place(index, point.middle)),
            "curve-group-middle",
          ),
        ];
  const own = scores.map((score, index) => place(index, score));
  return frame(
    height,
    `Score of ${scores.length} attempts: ${scores.map((score) => Math.round(score)).join(", ")}`,
    ...bands.flat(),
    ...grid,
    ...band,
    ...level(place, data.proficient, `surgeons, elsewhere ${data.proficient}`, "curve-mark"),
    ...(data.expert === undefined
      ? []
      : level(place, data.expert, `expert, in silico ${Math.round(data.expert)}`, "curve-expert")),
    line(own, "curve-own"),
    ...own.map(([cx, cy], index) =>
      (scores[index] ?? 0) <= 0
        ? cross(cx, cy)
        : makeSvg("circle", { cx, cy, r: 4.5, class: "curve-dot" }),
    ),
    ...numbers(scores.length, place, height - 6),
    text(LEFT, TOP - 6, "Score", "curve-number"),
  );
}

export function cusumCurve(points: readonly CusumPoint[], limits: CusumLimits): SVGElement {
  const height = 200;
  const reach = Math.max(
    limits.upper * 1.25,
    limits.lower * 1.4,
    ...points.map((point) => Math.abs(point.sum) * 1.1),
  );
  const place = placing(points.length, height, -reach, reach);
  // A limit that was passed begins anew at 0: the line is drawn in pieces.
  const pieces: (readonly [number, number])[][] = [[]];
  points.forEach((point, index) => {
    const piece = pieces.at(-1);
    if (piece?.length === 0) piece.push(place(index - 0.5, 0));
    piece?.push(place(index, point.sum));
    if (point.verdict !== "") pieces.push([]);
  });
  const zero = place(0, 0)[1];
  const verdicts = points.flatMap((point, index) => {
    if (point.verdict === "") return [];
    const [x, y] = place(index, point.sum);
    const isGood = point.verdict === "proficient";
    return [
      makeSvg("circle", { cx: x, cy: y, r: 6, class: isGood ? "curve-good" : "curve-bad" }),
      text(
        x + 9,
        y + (isGood ? 14 : -4),
        isGood ? "✓ proficient" : "✕ practise on",
        "curve-number",
      ),
    ];
  });
  const last = points.at(-1)?.sum.toFixed(2) ?? "0";
  return frame(
    height,
    `Cumulative sum of failures after ${points.length} attempts: ${last}`,
    makeSvg("line", { x1: LEFT, x2: WIDTH - RIGHT, y1: zero, y2: zero, class: "curve-grid" }),
    text(LEFT - 8, zero + 4, "0", "curve-number", "end"),
    ...level(place, limits.upper, "fails too often", "curve-harm"),
    ...level(place, -limits.lower, "acceptable", "curve-safe"),
    ...pieces.filter((piece) => piece.length > 1).map((piece) => line(piece, "curve-own")),
    ...points.map((point, index) => {
      const [cx, cy] = place(index, point.sum);
      return point.failed ? cross(cx, cy) : makeSvg("circle", { cx, cy, r: 3, class: "curve-dot" });
    }),
    ...verdicts,
    ...numbers(points.length, place, height - 4),
    text(4, TOP - 6, "CUSUM of failures", "curve-number"),
  );
}
