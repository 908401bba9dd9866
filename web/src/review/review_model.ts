// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Which attempts are reviewed, how they compare, and how they leave as a file.
import type { AttemptSummary } from "../protocol";

/** An empty word leaves that out. Dates are days, YYYY-MM-DD, of the reader's own time. */
export interface ReviewFilter {
  readonly trainee: string;
  readonly procedure: string;
  readonly case: string;
  readonly mode: string;
  readonly from: string;
  readonly to: string;
}

export const NO_FILTER: ReviewFilter = {
  trainee: "",
  procedure: "",
  case: "",
  mode: "",
  from: "",
  to: "",
};

export const NOT_NAMED = "not named";

/** Who is compared with: those who were asked for, all other people, scripted experts. */
export type Who = "own" | "group" | "expert";

export function isScripted(attempt: Pick<AttemptSummary, "input_device">): boolean {
  return attempt.input_device === "script";
}

export function traineeOf(attempt: Pick<AttemptSummary, "trainee">): string {
  return attempt.trainee === "" ? NOT_NAMED : attempt.trainee;
}

export function dayOf(iso: string): string {
  const date = new Date(iso);
  if (Number.isNaN(date.getTime())) return "";
  const two = (n: number): string => String(n).padStart(2, "0");
  return `${date.getFullYear()}-${two(date.getMonth() + 1)}-${two(date.getDate())}`;
}

/** All that the filter leaves but for who made it; oldest first. */
export function inScope(
  attempts: readonly AttemptSummary[],
  filter: ReviewFilter,
): AttemptSummary[] {
  return attempts
    .filter((attempt) => {
      const day = dayOf(attempt.started_at);
      return (
        (filter.procedure === "" || attempt.procedure === filter.procedure) &&
        (filter.case === "" || attempt.case === filter.case) &&
        (filter.mode === "" || attempt.mode === filter.mode) &&
        (filter.from === "" || day >= filter.from) &&
        (filter.to === "" || day <= filter.to)
      );
    })
    .sort((a, b) => a.id - b.id);
}

export function madeBy(
  attempts: readonly AttemptSummary[],
  filter: ReviewFilter,
  who: Who,
): AttemptSummary[] {
  const isOwn = (attempt: AttemptSummary): boolean =>
    filter.trainee === "" ? !isScripted(attempt) : traineeOf(attempt) === filter.trainee;
  if (who === "own") return attempts.filter(isOwn);
  if (who === "group") {
    return attempts.filter((attempt) => !isScripted(attempt) && !isOwn(attempt));
  }
  return attempts.filter(
    (attempt) => isScripted(attempt) && attempt.trainee.startsWith("scripted expert"),
  );
}

/** What there is to choose from, each once, in the order of the alphabet. */
export function choicesOf(
  attempts: readonly AttemptSummary[],
  of: (attempt: AttemptSummary) => string,
): string[] {
  const found = new Set(attempts.map(of).filter((text) => text !== ""));
  return [...found].sort((a, b) => a.localeCompare(b, "en"));
}

/** No points are earned where a must-have is missing (docs/scoring.md). */
export function hasFailed(attempt: Pick<AttemptSummary, "overall">): boolean {
  return (attempt.overall ?? 0) <= 0;
}

export function finished(attempts: readonly AttemptSummary[]): AttemptSummary[] {
  return attempts.filter((attempt) => attempt.outcome === "finished" && attempt.overall !== null);
}

export function quantile(values: readonly number[], share: number): number | undefined {
  if (values.length === 0) return undefined;
  const sorted = [...values].sort((a, b) => a - b);
  const at = share * (sorted.length - 1);
  const low = sorted[Math.floor(at)] ?? 0;
  const high = sorted[Math.ceil(at)] ?? low;
  return low + (high - low) * (at - Math.floor(at));
}

export interface Comparison {
  readonly name: string;
  readonly attempts: number;
  readonly score: number | undefined;
  readonly safe: number | undefined;
  readonly seconds: number | undefined;
}

function compared(name: string, attempts: readonly AttemptSummary[]): Comparison {
  const done = finished(attempts);
  return {
    name,
    attempts: done.length,
    score: quantile(
      done.map((attempt) => attempt.overall ?? 0),
      0.5,
    ),
    safe:
      done.length === 0
        ? undefined
        : done.filter((attempt) => !hasFailed(attempt)).length / done.length,
    seconds: quantile(
      done.map((attempt) => attempt.duration_s),
      0.5,
    ),
  };
}

/** So many attempts at either end are one's past and one's present. */
const FEW = 5;

export function compare(
  attempts: readonly AttemptSummary[],
  filter: ReviewFilter,
): readonly Comparison[] {
  const own = finished(madeBy(attempts, filter, "own"));
  const name = filter.trainee === "" ? "All trainees" : filter.trainee;
  const rows = [compared(name, own)];
  if (own.length > FEW) {
    const few = Math.min(FEW, Math.floor(own.length / 2));
    rows.push(compared(`… the first ${few}`, own.slice(0, few)));
    rows.push(compared(`… the last ${few}`, own.slice(-few)));
  }
  if (filter.trainee !== "") rows.push(compared("All others", madeBy(attempts, filter, "group")));
  rows.push(compared("Scripted expert, in silico", madeBy(attempts, filter, "expert")));
  return rows;
}

/** Of the others, by how many attempts each had made before: how the group learns. */
export function groupCurve(
  attempts: readonly AttemptSummary[],
  filter: ReviewFilter,
  length: number,
): readonly { readonly low: number; readonly middle: number; readonly high: number }[] {
  const byTrainee = new Map<string, number[]>();
  for (const attempt of finished(madeBy(attempts, filter, "group"))) {
    const scores = byTrainee.get(traineeOf(attempt)) ?? [];
    scores.push(attempt.overall ?? 0);
    byTrainee.set(traineeOf(attempt), scores);
  }
  const curve = [];
  for (let index = 0; index < length; ++index) {
    const scores = [...byTrainee.values()].flatMap((one) => {
      const score = one[index];
      return score === undefined ? [] : [score];
    });
    // One is nobody's group.
    if (scores.length < 2) break;
    curve.push({
      low: quantile(scores, 0.25) ?? 0,
      middle: quantile(scores, 0.5) ?? 0,
      high: quantile(scores, 0.75) ?? 0,
    });
  }
  return curve;
}

const COLUMNS = [
  "id",
  "started_at",
  "ended_at",
  "trainee",
  "case",
  "case_fingerprint",
  "case_simulated",
  "procedure",
  "mode",
  "input_device",
  "outcome",
  "overall",
  "duration_s",
  "state_hash",
] as const satisfies readonly (keyof AttemptSummary)[];

/** Of what instructors said by the ASSET; empty where none did. */
const ASSET_COLUMNS = ["forms", "passed", "mean_total"] as const;

/** A cell that no table program takes for a formula, quoted where it must be. */
export function cell(value: string | number | boolean | null): string {
  if (value === null) return "";
  const text = String(value);
  const safe = typeof value === "string" && /^[=+\-@\t\r]/.test(text) ? `'${text}` : text;
  return /[",\n\r]/.test(safe) ? `"${safe.replaceAll('"', '""')}"` : safe;
}

export function csvOf(attempts: readonly AttemptSummary[]): string {
  const heads = [...COLUMNS, ...ASSET_COLUMNS.map((column) => `asset_${column}`)];
  const rows = attempts.map((attempt) =>
    [
      ...COLUMNS.map((column) => cell(attempt[column])),
      ...ASSET_COLUMNS.map((column) => cell(attempt.asset?.[column] ?? null)),
    ].join(","),
  );
  return [heads.join(","), ...rows, ""].join("\r\n");
}

/** As `carpus attempts --json` writes it. */
export function jsonOf(attempts: readonly AttemptSummary[]): string {
  const list = { attempts, older: false, total: attempts.length };
  return `${JSON.stringify(list, undefined, 2)}\n`;
}
