// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A form that is being filled in: whose, of which attempt, and what of the records it amends.
import type { AssetForm, AssetRating } from "../protocol";
import { answersOf, chosenOf, type Chosen } from "./asset_model";

export interface Draft {
  readonly rater: string;
  readonly comment: string;
  readonly chosen: Chosen;
  /** The form in the records that it began from; undefined: a new one. */
  readonly basis: Pick<AssetForm, "rater" | "revision"> | undefined;
  /** Something was changed since it was saved. */
  readonly isChanged: boolean;
}

export function newDraft(rater: string): Draft {
  return { rater, comment: "", chosen: new Map(), basis: undefined, isChanged: false };
}

export function draftOf(form: AssetForm): Draft {
  return {
    rater: form.rater,
    comment: form.comment,
    chosen: chosenOf(form),
    basis: form,
    isChanged: false,
  };
}

/** The rater's own where there is one, else a new one. */
export function firstDraft(rater: string, forms: readonly AssetForm[]): Draft {
  const own = forms.find((form) => form.rater === rater);
  return own === undefined ? newDraft(rater) : draftOf(own);
}

/** What was kept of a draft as it would be sent. */
export function draftAgain(rating: AssetRating): Draft {
  const { rater, revision, comment } = rating;
  return {
    rater,
    comment,
    chosen: chosenOf(rating),
    basis: revision === 0 ? undefined : { rater, revision },
    isChanged: true,
  };
}

/** One of this name that is saved and is not what the draft began from: it must be seen first. */
export function unseenForm(draft: Draft, forms: readonly AssetForm[]): AssetForm | undefined {
  const saved = forms.find((form) => form.rater === draft.rater.trim());
  const isSeen = saved?.rater === draft.basis?.rater && saved?.revision === draft.basis?.revision;
  return isSeen ? undefined : saved;
}

export function ratingOf(draft: Draft): AssetRating {
  const rater = draft.rater.trim();
  return {
    rater,
    revision: draft.basis?.rater === rater ? draft.basis.revision : 0,
    answers: answersOf(draft.chosen),
    comment: draft.comment.trim(),
  };
}
