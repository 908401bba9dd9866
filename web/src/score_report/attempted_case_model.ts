// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the report may say of the case of an attempt. The records hold attempts of several cases, the
// station serves one: a placement drawn in another patient's scaphoid would be a lie.
import type { Attempt, CaseDescription } from "../protocol";

export interface AttemptedCase {
  /** Stands in place of the pictures; empty where they may be drawn in the open case's bones. */
  readonly notice: string;
  readonly simulated: boolean;
}

export function attemptedCase(
  attempt: Pick<Attempt, "case" | "case_is_open" | "case_simulated">,
  open: Pick<CaseDescription, "simulated">,
): AttemptedCase {
  if (attempt.case_is_open) {
    return { notice: "", simulated: attempt.case_simulated ?? open.simulated };
  }
  const name = attempt.case === "" ? "" : `, ${attempt.case}`;
  return {
    notice: `This attempt was made on another case${name}; open that case to see the placement.`,
    simulated: attempt.case_simulated === true,
  };
}
