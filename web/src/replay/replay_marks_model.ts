// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What of an attempt's log is marked on its scrub bar, and where the steps end.
import type { LoggedEvent } from "../protocol";

export type MarkKind = "picture" | "entry" | "harm" | "step" | "undo";

export interface Mark {
  readonly kind: MarkKind;
  readonly tick: number;
  readonly text: string;
}

/** Of the log's kinds; others are in the log alone. */
const KINDS: Readonly<Record<string, MarkKind>> = {
  shot_taken: "picture",
  live_ended: "picture",
  entered_bone: "entry",
  left_far_side: "harm",
  wrong_bone: "harm",
  wire_bent: "harm",
  wire_broke: "harm",
  step_completed: "step",
  undone: "undo",
};

export function marksOf(events: readonly LoggedEvent[]): Mark[] {
  return events.flatMap(({ kind, tick, text }) => {
    const mark = KINDS[kind];
    return mark === undefined ? [] : [{ kind: mark, tick, text }];
  });
}

/** When the pictures were taken that stayed on the monitor: shots and the last of each live look. */
export function looksOf(events: readonly LoggedEvent[]): number[] {
  return events
    .filter(({ kind }) => kind === "shot_taken" || kind === "live_ended")
    .map(({ tick }) => tick);
}

/** The mark after a moment, or before it; undefined where there is none. */
export function neighbourOf(
  marks: readonly Mark[],
  tick: number,
  direction: 1 | -1,
): Mark | undefined {
  if (direction > 0) return marks.find((mark) => mark.tick > tick);
  // While it plays on from a mark, back goes to the one before.
  return marks.filter((mark) => mark.tick < tick - 700).at(-1);
}

/** Where a step ended for the first time, by its text; in the order in which they ended. */
export function stepEnds(events: readonly LoggedEvent[]): ReadonlyMap<string, number> {
  const ends = new Map<string, number>();
  for (const { kind, tick, text } of events) {
    if (kind === "step_completed" && !ends.has(text)) ends.set(text, tick);
  }
  return ends;
}

/** Stretches of two attempts that belong together: each begins where the one before ended. */
export interface StepPair {
  readonly text: string;
  /** End in the first and in the second attempt [ticks]. */
  readonly ends: readonly [number, number];
}

/** Steps that both did, in one order; what is left at the end is a stretch of its own. */
export function pairSteps(
  first: readonly LoggedEvent[],
  second: readonly LoggedEvent[],
  lengths: readonly [number, number],
): StepPair[] {
  const other = stepEnds(second);
  const pairs: StepPair[] = [];
  let before = -1;
  for (const [text, end] of stepEnds(first)) {
    const there = other.get(text);
    if (there === undefined || there <= before) continue;
    pairs.push({ text, ends: [end, there] });
    before = there;
  }
  const last = pairs.at(-1);
  if (last === undefined || last.ends[0] < lengths[0] || last.ends[1] < lengths[1]) {
    pairs.push({ text: "The end", ends: lengths });
  }
  return pairs;
}

/** Where the other attempt stands when one is moved: as far into the same step, or at its end. */
export function followedTick(pairs: readonly StepPair[], moved: 0 | 1, tick: number): number {
  const other = moved === 0 ? 1 : 0;
  const found = pairs.findIndex((pair) => tick < pair.ends[moved]);
  const index = found < 0 ? pairs.length - 1 : found;
  const start = (which: 0 | 1): number => pairs[index - 1]?.ends[which] ?? 0;
  const pair = pairs[index];
  if (pair === undefined) return tick;
  return Math.min(pair.ends[other], start(other) + Math.max(0, tick - start(moved)));
}

/**
 * How far each may play on: who is done with a step waits at its end for the other.
 * @return the tick at which each waits
 */
export function waitsAt(
  pairs: readonly StepPair[],
  ticks: readonly [number, number],
): readonly [number, number] {
  const pair = pairs.find((one) => ticks[0] < one.ends[0] || ticks[1] < one.ends[1]);
  return pair?.ends ?? ticks;
}
