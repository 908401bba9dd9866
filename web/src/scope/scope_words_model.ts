// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where the scope is and what to do next, as the round picture says it while there is no joint to see. Pure.
export interface ScopePlace {
  /** Through which it goes; empty where it is outside. */
  readonly portal: string;
  readonly isInJoint: boolean;
  /** Nothing pulls at the fingers: the joint is closed. */
  readonly isSlack: boolean;
}

export interface ScopeWords {
  readonly where: string;
  readonly next: string;
  readonly key: "pull" | "in";
}

/** @param wanted  the portal that it is held before. Empty words where the picture speaks for itself. */
export function scopeWords(at: ScopePlace, wanted: string): ScopeWords {
  if (at.isInJoint) return { where: "", next: "", key: "in" };
  const where = at.portal === "" ? "The scope is outside." : `The scope is in portal ${at.portal}.`;
  if (at.isSlack) return { where, next: "Pull the joint open first: hold", key: "pull" };
  return at.portal === ""
    ? { where, next: `Enter through the ${wanted}: hold`, key: "in" }
    : { where, next: "Go on into the joint: hold", key: "in" };
}
