// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One figure as a strip: what is good as a band, the middle half of the others, the expert, one's own
// attempts, the last one large. SVG, so that it prints; the numbers stand beside it in the table.
import { makeSvg } from "../dom";
import { scaleOf, type FigureRow } from "./figures_model";

const WIDTH = 300;
const HEIGHT = 34;
const MIDDLE = HEIGHT / 2;
const EDGE = 8;

export function figureStrip(row: FigureRow): SVGElement {
  const [low, high] = scaleOf(row);
  const x = (value: number): number => {
    const share = (value - low) / (high - low);
    return EDGE + (WIDTH - 2 * EDGE) * Math.min(1, Math.max(0, share));
  };
  const box = (from: number, to: number, height: number, kind: string): SVGElement =>
    makeSvg("rect", {
      x: x(from),
      y: MIDDLE - height / 2,
      width: Math.max(2, x(to) - x(from)),
      height,
      rx: 2,
      class: kind,
    });
  const { band, expert, group, own } = row;
  const earlier = own.slice(0, -1);
  const last = own.at(-1);
  return makeSvg(
    "svg",
    { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, class: "figure-strip", "aria-hidden": "true" },
    ...(band === undefined ? [] : [box(band.from, band.to, HEIGHT - 4, "strip-band")]),
    makeSvg("line", { x1: EDGE, x2: WIDTH - EDGE, y1: MIDDLE, y2: MIDDLE, class: "strip-line" }),
    ...(group === undefined
      ? []
      : [
          box(group.low, group.high, 12, "strip-group"),
          makeSvg("line", {
            x1: x(group.middle),
            x2: x(group.middle),
            y1: MIDDLE - 8,
            y2: MIDDLE + 8,
            class: "strip-group-middle",
          }),
        ]),
    ...earlier.map((value, index) =>
      makeSvg("circle", {
        cx: x(value),
        cy: MIDDLE,
        r: 3,
        class: "strip-own",
        // The older, the fainter.
        opacity: (0.25 + (0.55 * (index + 1)) / Math.max(1, earlier.length)).toFixed(2),
      }),
    ),
    ...(expert === undefined
      ? []
      : [
          makeSvg("path", {
            d: `M${x(expert)},${MIDDLE - 8}l6,8l-6,8l-6,-8z`,
            class: "strip-expert",
          }),
        ]),
    ...(last === undefined
      ? []
      : [makeSvg("circle", { cx: x(last), cy: MIDDLE, r: 6, class: "strip-last" })]),
  );
}
