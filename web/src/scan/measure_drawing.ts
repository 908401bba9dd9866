// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is laid over a slice in lines: measures, circles with their HU, and the line by which a bone is cut.
import type { Vec3 } from "../protocol";
import { traceOfCut, type CutLine } from "./cut_line_model";
import { measureText, type Measure } from "./measure_model";
import { along, cross, dot } from "./planes_model";
import type { Region } from "./region_model";
import { pixelOf, type SliceView } from "./slice_model";

type Pixel = readonly [number, number];

export interface Sheet {
  readonly context: CanvasRenderingContext2D;
  readonly view: SliceView;
  /** In CSS pixels. */
  readonly width: number;
  readonly height: number;
}

const COLOR = "#f0c36a";
const FAINT = 0.25;
/** A measure is drawn where it lies within so many mm of the slice; fainter elsewhere. */
const NEAR_MM = 1;
const CIRCLE_STEPS = 72;
const LINE_HEIGHT = 16;
/** Of the ticks towards what is cut off, in pixels. */
const TICK = 7;
const TICKS_APART = 14;

/** Around a region, for a slice at any angle. */
function circleOf({ centre, radiusMm, away }: Region): readonly Vec3[] {
  const least: Vec3 = Math.abs(away[0]) < 0.6 ? [1, 0, 0] : [0, 1, 0];
  const side = cross(away, least);
  const u = along([0, 0, 0], 1 / Math.sqrt(dot(side, side)), side);
  const v = cross(away, u);
  return Array.from({ length: CIRCLE_STEPS + 1 }, (_, i) => {
    const at = (2 * Math.PI * i) / CIRCLE_STEPS;
    return along(along(centre, radiusMm * Math.cos(at), u), radiusMm * Math.sin(at), v);
  });
}

function drawPath(context: CanvasRenderingContext2D, points: readonly Pixel[]): void {
  context.beginPath();
  points.forEach(([x, y], i) => {
    if (i === 0) context.moveTo(x, y);
    else context.lineTo(x, y);
  });
  context.stroke();
}

function drawDot(context: CanvasRenderingContext2D, [x, y]: Pixel): void {
  context.beginPath();
  context.arc(x, y, 2.5, 0, 2 * Math.PI);
  context.fill();
}

/** Beside a place, and within the picture. */
function drawText({ context, width, height }: Sheet, text: string, [x, y]: Pixel): void {
  const lines = text.split("\n");
  context.font = "600 13px 'Inter Variable', sans-serif";
  context.strokeStyle = "#0e1214";
  context.lineWidth = 3;
  const widest = Math.max(...lines.map((line) => context.measureText(line).width));
  const left = Math.min(x + 8, width - widest - 6);
  const lowest = height - 6 - LINE_HEIGHT * (lines.length - 1);
  const top = Math.max(LINE_HEIGHT, Math.min(lowest, y - 8 - LINE_HEIGHT * (lines.length - 1)));
  lines.forEach((line, i) => {
    context.strokeText(line, left, top + LINE_HEIGHT * i);
    context.fillText(line, left, top + LINE_HEIGHT * i);
  });
}

export function drawMeasure(sheet: Sheet, measure: Measure): void {
  const { context, view, width, height } = sheet;
  const { region } = measure;
  const line = region === undefined ? measure.places : circleOf(region);
  const offs = line.map((p) => Math.abs(dot(along(p, -1, view.centre), view.plane.away)));
  const points = line.map((p) => pixelOf(view, width, height, p));
  context.globalAlpha = offs.every((off) => off < NEAR_MM) ? 1 : FAINT;
  context.strokeStyle = context.fillStyle = COLOR;
  context.lineWidth = 1.5;
  drawPath(context, points);
  const dots = region === undefined ? points : [pixelOf(view, width, height, region.centre)];
  for (const at of dots) drawDot(context, at);
  const at =
    region === undefined
      ? points[measure.kind === "angle" ? 1 : points.length - 1]
      : points.reduce((best, one) => (one[0] - one[1] > best[0] - best[1] ? one : best));
  // Of a circle that is seen from its edge the words would stand there twice.
  const isSeen = region === undefined || Math.abs(dot(region.away, view.plane.away)) > 0.9;
  const text = isSeen ? measureText(measure) : "";
  if (at !== undefined && text !== "") drawText(sheet, text, at);
  context.globalAlpha = 1;
}

/** Solid as it was drawn, dashed where it cuts besides; ticks point at what is cut off. */
export function drawCut({ context, view, width, height }: Sheet, line: CutLine): void {
  context.strokeStyle = context.fillStyle = COLOR;
  const trace = traceOfCut(line, view, width, height);
  if (trace === undefined) {
    // Its first end, while the second lies on it; a slice along the cut shows nothing.
    const isHome = dot(line.away, view.plane.away) > 0.999;
    if (isHome) drawDot(context, pixelOf(view, width, height, line.a));
    return;
  }
  context.lineWidth = 1.5;
  context.globalAlpha = 0.8;
  context.setLineDash([5, 5]);
  drawPath(context, [trace.from, trace.to]);
  context.setLineDash([]);
  context.globalAlpha = 1;
  const { ends, side } = trace;
  if (ends === undefined) return;
  const [[ax, ay], [bx, by]] = ends;
  context.lineWidth = 2;
  drawPath(context, ends);
  for (const at of ends) drawDot(context, at);
  const length = Math.hypot(bx - ax, by - ay);
  const many = Math.floor(length / TICKS_APART);
  for (let i = 0; i < many; ++i) {
    const s = ((i + 0.5) * TICKS_APART) / length;
    const [x, y] = [ax + s * (bx - ax), ay + s * (by - ay)];
    drawPath(context, [
      [x, y],
      [x + TICK * side[0], y + TICK * side[1]],
    ]);
  }
}
