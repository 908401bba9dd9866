// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The form by which a person rates an arthroscopy (data/asset.json): its rows, what is missing, what
// it comes to, in words. The host counts for the records (src/arthroscopy/asset_table.hpp).
import data from "../../../data/asset.json";
import type { AssetAnswer, AssetForm, AssetSummary } from "../protocol";

/** What a step of a row means; steps without words lie between. */
export interface AssetStep {
  readonly points: number;
  readonly text: string;
}

export interface AssetRow {
  readonly id: string;
  readonly title: string;
  /** What the row is about. */
  readonly about: string;
  /** Points go from 1 to this. */
  readonly highest: number;
  readonly steps: readonly AssetStep[];
}

export const DOMAINS: readonly AssetRow[] = data.domains;
/** Of the procedure: asked, not counted. */
export const COMPLEXITY: AssetRow = data.complexity;
export const ROWS: readonly AssetRow[] = [...DOMAINS, COMPLEXITY];
export const PASSES_AT = data.passes_at.value;
export const HIGHEST_TOTAL = data.highest_total.value;
/** "novice", "competent", "expert". */
export const LEVELS: readonly (readonly [number, string])[] = Object.entries(data.steps.words).map(
  ([points, word]) => [Number(points), word],
);

/** Points by row; rows may be missing. */
export type Chosen = ReadonlyMap<string, number>;

export function chosenOf(form: Pick<AssetForm, "answers">): Chosen {
  return new Map(form.answers.map(({ domain, points }) => [domain, points]));
}

/** In the form's order. */
export function answersOf(chosen: Chosen): AssetAnswer[] {
  return ROWS.flatMap(({ id }) => {
    const points = chosen.get(id);
    return points === undefined ? [] : [{ domain: id, points }];
  });
}

export function missingRows(chosen: Chosen): AssetRow[] {
  return ROWS.filter(({ id }) => !chosen.has(id));
}

/** Of the domains that were answered. */
export function totalOf(chosen: Chosen): number {
  return DOMAINS.reduce((sum, { id }) => sum + (chosen.get(id) ?? 0), 0);
}

/** Domains below the pass mark. */
export function lowDomains(chosen: Chosen): AssetRow[] {
  return DOMAINS.filter(({ id }) => (chosen.get(id) ?? PASSES_AT) < PASSES_AT);
}

/** What the form comes to, or what is missing. */
export function standingText(chosen: Chosen): string {
  const missing = missingRows(chosen);
  if (missing.length === ROWS.length) return "Nothing chosen yet.";
  if (missing.length > 0) return `Missing: ${missing.map(({ title }) => title).join(", ")}.`;
  const low = lowDomains(chosen);
  if (low.length === 0) return `✓ Passes: each of the eight is ${PASSES_AT} or better.`;
  const named = low.map(({ id, title }) => `${title} is ${chosen.get(id) ?? 0}`).join(", ");
  return `✕ Does not pass: ${named}; each of the eight must be ${PASSES_AT} or better.`;
}

/** What a choice means, in the row's words; between two of them where it has none. */
export function stepText(row: AssetRow, points: number): string {
  const own = row.steps.find((step) => step.points === points);
  if (own !== undefined) return own.text;
  const word = (at: number): string => LEVELS.find(([level]) => level === at)?.[1] ?? String(at);
  return `Between ${word(points - 1)} and ${word(points + 1)}`;
}

export function verdictText(form: Pick<AssetForm, "passes">): string {
  if (form.passes === null) return "unfinished";
  return form.passes ? "✓ passes" : "✕ does not pass";
}

/** "31 of 38 ✓" of one form, "28.5 of 38, 1 of 2 pass" of several; empty of none. */
export function summaryText(asset: AssetSummary | null): string {
  if (asset === null) return "";
  const total = `${Number(asset.mean_total.toFixed(1))} of ${HIGHEST_TOTAL}`;
  if (asset.forms === 1) return `${total} ${asset.passed === 1 ? "✓" : "✕"}`;
  return `${total}, ${asset.passed} of ${asset.forms} pass`;
}
