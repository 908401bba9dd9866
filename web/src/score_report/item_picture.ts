// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A small picture of one figure where it says more than the number: a target for distances from the
// axis, two rays for the angle, a bar for bone cover and lengths. Decoration for readers: the value
// is in the table.
import { makeSvg } from "../dom";
import type { Grade, ScoreItem } from "../protocol";

const COLORS: Readonly<Record<Grade, string>> = {
  good: "var(--good)",
  acceptable: "var(--attention)",
  fail: "var(--harm)",
  not_measured: "var(--disabled)",
};
const SIZE = 56;
const MIDDLE = SIZE / 2;

function svg(...children: SVGElement[]): SVGElement {
  return makeSvg(
    "svg",
    { viewBox: `0 0 ${SIZE} ${SIZE}`, width: SIZE, height: SIZE, "aria-hidden": "true" },
    ...children,
  );
}

/**
 * Section of the bone across its axis: the good zone is its central third. How far beside the middle is a
 * ring: which way is said in words.
 */
function target(percentOfWidth: number, color: string): SVGElement {
  const radius = 50;
  const scale = 25 / Math.max(radius, percentOfWidth);
  const ring = (r: number, fill: string): SVGElement =>
    makeSvg("circle", { cx: MIDDLE, cy: MIDDLE, r, fill, stroke: "var(--secondary)" });
  return svg(
    ring(radius * scale, "var(--picture-bone)"),
    ring((radius * scale) / 3, "none"),
    makeSvg("circle", {
      cx: MIDDLE,
      cy: MIDDLE,
      r: Math.max(1.5, percentOfWidth * scale),
      fill: "none",
      stroke: color,
      "stroke-width": 3,
    }),
  );
}

/** The two lines at their true angle. */
function rays(degrees: number, color: string): SVGElement {
  const angle = (Math.min(degrees, 60) * Math.PI) / 180;
  const line = (dx: number, dy: number, stroke: string, dash: string): SVGElement =>
    makeSvg("line", {
      x1: 8,
      y1: SIZE - 10,
      x2: 8 + dx,
      y2: SIZE - 10 - dy,
      stroke,
      "stroke-width": 2.5,
      "stroke-dasharray": dash,
      "stroke-linecap": "round",
    });
  const tilt = Math.PI / 5;
  return svg(
    line(44 * Math.cos(tilt), 44 * Math.sin(tilt), "var(--secondary)", "4 4"),
    line(44 * Math.cos(tilt - angle), 44 * Math.sin(tilt - angle), color, "none"),
  );
}

/** Bone left before an end of the screw, against the 2 mm that are wanted. */
function cover(mm: number, color: string): SVGElement {
  const scale = 12;
  const surface = 12;
  const depth = Math.max(-10, Math.min(38, mm * scale));
  return svg(
    makeSvg("rect", { x: 6, y: surface, width: 44, height: 40, fill: "var(--picture-bone)" }),
    makeSvg("line", {
      x1: 6,
      x2: 50,
      y1: surface + 2 * scale,
      y2: surface + 2 * scale,
      stroke: "var(--secondary)",
      "stroke-dasharray": "3 3",
    }),
    makeSvg("rect", {
      x: MIDDLE - 6,
      y: surface + depth,
      width: 12,
      height: SIZE - surface - depth - 4,
      rx: 2,
      fill: color,
    }),
  );
}

export function itemPicture(item: ScoreItem): SVGElement | undefined {
  if (item.value === null) return undefined;
  const color = COLORS[item.grade];
  if (item.id === "angle_to_central_axis_deg") return rays(item.value, color);
  if (item.id.endsWith("_offset_percent")) return target(item.value, color);
  if (item.id.endsWith("_cover_mm")) return cover(item.value, color);
  return undefined;
}
