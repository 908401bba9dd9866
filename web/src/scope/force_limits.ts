// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How hard is too hard in a joint, as the host counts it (clinical: B11, proposed from published probing
// forces). Pure.
import type { ScopeMessage, SnapshotMessage } from "../protocol";

export const WARN_N = 3;
export const INJURY_N = 8;

export type ForceGrade = "good" | "warning" | "injury";

export function gradeOf(newtons: number): ForceGrade {
  if (newtons > INJURY_N) return "injury";
  return newtons > WARN_N ? "warning" : "good";
}

/** By hand; outside a joint, on skin or on its way to a portal, nothing in it is pressed. */
export function forcesInJoint(
  scope: Pick<ScopeMessage, "in_joint"> | undefined,
  snapshot: Pick<SnapshotMessage, "hands"> | undefined,
): readonly number[] {
  return (snapshot?.hands ?? []).map(({ force_n: force }, hand) =>
    scope?.in_joint[hand] === 1 ? Math.hypot(...force) : 0,
  );
}
