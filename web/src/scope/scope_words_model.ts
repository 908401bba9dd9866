// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where the scope is and what to do next, as the round picture says it while there is no joint to see. Pure.
export interface ScopePlace {
  /** Through which it goes; empty where it is outside. */
  readonly portal: string;
  readonly isInJoint: boolean;
}

/** @param wanted  the portal that it is held before. Empty words where the picture speaks for itself. */
export function scopeWords(
  at: ScopePlace,
  wanted: string,
): { readonly where: string; readonly next: string } {
  if (at.isInJoint) return { where: "", next: "" };
  if (at.portal === "")
    return { where: "The scope is outside.", next: `Enter through the ${wanted}: hold` };
  return { where: `The scope is in portal ${at.portal}.`, next: "Go on into the joint: hold" };
}
