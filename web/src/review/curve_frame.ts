// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What every curve of the review room has in common: its frame, levels with a word, and the numbers of what
// was done under it. SVG, so that it prints.
import { makeSvg } from "../dom";

export const WIDTH = 880;
export const LEFT = 48;
export const RIGHT = 150;
export const TOP = 22;

export type Place = (index: number, value: number) => readonly [number, number];

/** Room for ten, then for all. */
export function placing(count: number, height: number, low: number, high: number): Place {
  const room = Math.max(10, count);
  return (index, value) => [
    LEFT + ((WIDTH - LEFT - RIGHT) * (index + 0.5)) / room,
    TOP + ((height - 2 * TOP) * (high - value)) / (high - low),
  ];
}

export function line(points: readonly (readonly [number, number])[], kind: string): SVGElement {
  const text = points.map(([x, y]) => `${x.toFixed(1)},${y.toFixed(1)}`).join(" ");
  return makeSvg("polyline", { points: text, class: kind, fill: "none" });
}

export function text(
  x: number,
  y: number,
  says: string,
  kind: string,
  anchor = "start",
): SVGElement {
  return makeSvg("text", { x, y, class: kind, "text-anchor": anchor }, says);
}

export function level(place: Place, value: number, says: string, kind: string): SVGElement[] {
  const y = place(0, value)[1];
  return [
    makeSvg("line", { x1: LEFT, x2: WIDTH - RIGHT, y1: y, y2: y, class: kind }),
    text(WIDTH - RIGHT + 8, y + 4, says, `${kind}-word`),
  ];
}

/** Numbers of attempts under a picture. */
export function numbers(count: number, place: Place, y: number): SVGElement[] {
  const room = Math.max(10, count);
  const every = Math.ceil(room / 20);
  const all = Array.from({ length: room }, (_, index) => index);
  return all
    .filter((index) => (index + 1) % every === 0 || index === 0)
    .map((index) => text(place(index, 0)[0], y, String(index + 1), "curve-number", "middle"));
}

export function frame(height: number, says: string, ...children: SVGElement[]): SVGElement {
  return makeSvg(
    "svg",
    { viewBox: `0 0 ${WIDTH} ${height}`, class: "curve", role: "img", "aria-label": says },
    ...children,
  );
}

export function cross(x: number, y: number): SVGElement {
  return makeSvg("path", {
    d: `M${x - 5},${y - 5}L${x + 5},${y + 5}M${x + 5},${y - 5}L${x - 5},${y + 5}`,
    class: "curve-failed",
  });
}
