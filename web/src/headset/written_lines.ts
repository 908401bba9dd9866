// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where each line of a screen's words stands: in the sizes that are wished, all of them smaller where they would else
// run into what stands below. Pure.
import { wrapped } from "./wrapped";

export interface Paragraph {
  readonly text: string;
  /** Wished [px]. */
  readonly sizePx: number;
  readonly weight: number;
  readonly color: string;
  /** Beneath it [px]. */
  readonly gapPx: number;
}

export interface WrittenLine {
  readonly text: string;
  readonly topPx: number;
  readonly sizePx: number;
  readonly of: Paragraph;
}

export interface Room {
  readonly widthPx: number;
  readonly heightPx: number;
}

/** Width of a text [px]. */
export type Measure = (text: string, sizePx: number, weight: number) => number;

/** Of a line, over its letters' size. */
const LINE = 1.28;
/** By how much smaller it is tried next, and where it ends: smaller nobody reads it. */
const SMALLER = 0.94;
const LEAST = 0.5;

function at(
  paragraphs: readonly Paragraph[],
  widthPx: number,
  measure: Measure,
  share: number,
): { readonly lines: readonly WrittenLine[]; readonly heightPx: number } {
  const lines: WrittenLine[] = [];
  let topPx = 0;
  for (const of of paragraphs) {
    const sizePx = share * of.sizePx;
    const width = (part: string): number => measure(part, sizePx, of.weight);
    for (const text of wrapped(of.text, widthPx, width)) {
      lines.push({ text, topPx, sizePx, of });
      topPx += LINE * sizePx;
    }
    topPx += share * of.gapPx;
  }
  return { lines, heightPx: topPx };
}

/** What does not fit at its smallest ends with the last line that does. */
export function writtenLines(
  paragraphs: readonly Paragraph[],
  { widthPx, heightPx }: Room,
  measure: Measure,
): readonly WrittenLine[] {
  let share = 1;
  let written = at(paragraphs, widthPx, measure, share);
  while (written.heightPx > heightPx && share > LEAST) {
    share = Math.max(LEAST, SMALLER * share);
    written = at(paragraphs, widthPx, measure, share);
  }
  return written.lines.filter(({ topPx, sizePx }) => topPx + LINE * sizePx <= heightPx);
}
