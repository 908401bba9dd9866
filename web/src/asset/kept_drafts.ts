// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What was chosen and not saved, by attempt, until this tab is closed: who rates looks at the replay
// in between, and the page is loaded anew for one of another case, or by hand. Where the tab may
// store nothing it lasts until then.
import { parseAssetRating } from "../protocol";
import { draftAgain, ratingOf, type Draft } from "./draft_model";

/** Which attempt it is, in other records too. */
export interface RatedAttempt {
  readonly id: number;
  /** UTC, ISO 8601 */
  readonly started_at: string;
}

const drafts = new Map<string, Draft>();

function keyOf(attempt: RatedAttempt): string {
  return `carpus.asset ${attempt.id} ${attempt.started_at}`;
}

export function keptDraft(attempt: RatedAttempt): Draft | undefined {
  const key = keyOf(attempt);
  const mine = drafts.get(key);
  if (mine !== undefined) return mine;
  try {
    const rating = parseAssetRating(sessionStorage.getItem(key) ?? "");
    return rating.ok ? draftAgain(rating.value) : undefined;
  } catch {
    return undefined;
  }
}

export function keepDraft(attempt: RatedAttempt, draft: Draft): void {
  const key = keyOf(attempt);
  drafts.set(key, draft);
  try {
    sessionStorage.setItem(key, JSON.stringify(ratingOf(draft)));
  } catch {
    // Storage may be forbidden; it then lasts as long as the page.
  }
}

export function forgetDraft(attempt: RatedAttempt): void {
  const key = keyOf(attempt);
  drafts.delete(key);
  try {
    sessionStorage.removeItem(key);
  } catch {
    // Then nothing was stored.
  }
}
