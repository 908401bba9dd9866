// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The comparison figure by figure: what one measured in the last attempts, how the others of late spread,
// the scripted expert, and what is good. Pure.
import type { AttemptSummary, ScoreItem } from "../protocol";
import { finished, madeBy, quantile, traineeOf, type ReviewFilter } from "./review_model";
import { bandOf, type TargetBand } from "./target_band_model";

/** So many of one's own, of each of the others, of the others together, and of the expert are looked at. */
const OWN = 10;
const OF_EACH = 2;
const OF_GROUP = 40;
const OF_EXPERT = 3;

export interface Chosen {
  /** Oldest first. */
  readonly own: readonly AttemptSummary[];
  readonly group: readonly AttemptSummary[];
  readonly expert: readonly AttemptSummary[];
}

/** @param scope  oldest first */
export function chosenFor(scope: readonly AttemptSummary[], filter: ReviewFilter): Chosen {
  const of = (who: "own" | "group" | "expert"): AttemptSummary[] =>
    finished(madeBy(scope, filter, who));
  const seen = new Map<string, number>();
  const group = of("group")
    .reverse()
    .filter((attempt) => {
      const count = (seen.get(traineeOf(attempt)) ?? 0) + 1;
      seen.set(traineeOf(attempt), count);
      return count <= OF_EACH;
    })
    .slice(0, OF_GROUP);
  return { own: of("own").slice(-OWN), group, expert: of("expert").slice(-OF_EXPERT) };
}

export interface Spread {
  readonly low: number;
  readonly middle: number;
  readonly high: number;
}

export interface FigureRow {
  readonly id: string;
  readonly label: string;
  readonly unit: string;
  readonly target: string;
  readonly band: TargetBand | undefined;
  /** Of one's attempts that were measured, oldest first. */
  readonly own: readonly number[];
  readonly grade: ScoreItem["grade"];
  readonly group: Spread | undefined;
  readonly expert: number | undefined;
}

export type Items = readonly ScoreItem[];

function valuesOf(id: string, all: readonly Items[]): number[] {
  return all.flatMap((items) => items.find((item) => item.id === id)?.value ?? []);
}

/** One row for each figure of one's last attempt, in the report's order. One is nobody's group. */
export function figureRows(
  own: readonly Items[],
  group: readonly Items[],
  expert: readonly Items[],
): readonly FigureRow[] {
  const last = own.at(-1) ?? [];
  return last.map((item) => {
    const others = valuesOf(item.id, group);
    const [low, middle, high] = [0.25, 0.5, 0.75].map((share) => quantile(others, share) ?? 0);
    return {
      id: item.id,
      label: item.label,
      unit: item.unit,
      target: item.target,
      band: bandOf(item.target, item.unit),
      own: valuesOf(item.id, own),
      grade: item.grade,
      group:
        others.length < 2 ? undefined : { low: low ?? 0, middle: middle ?? 0, high: high ?? 0 },
      expert: quantile(valuesOf(item.id, expert), 0.5),
    };
  });
}

/** What a strip shows: all values and the ends of what is good, with some room beside them. */
export function scaleOf(row: FigureRow): readonly [low: number, high: number] {
  const ends = [row.band?.from, row.band?.to, row.expert, row.group?.low, row.group?.high];
  const all = [...row.own, ...ends].filter(
    (value): value is number => value !== undefined && Number.isFinite(value),
  );
  if (all.length === 0) return [0, 1];
  const [low, high] = [Math.min(...all), Math.max(...all)];
  const room = high > low ? 0.12 * (high - low) : Math.max(0.5, 0.12 * Math.abs(high));
  return [low - room, high + room];
}
