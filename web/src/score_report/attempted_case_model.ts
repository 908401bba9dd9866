// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the report may say of the case of an attempt. The records hold attempts of several cases, the
// station serves one: a placement drawn in another patient's scaphoid would be a lie.
import { addressOfCase } from "../case_data";
import type { Attempt, CaseDescription } from "../protocol";

export interface AttemptedCase {
  /** Stands in place of the pictures; empty where they may be drawn in the open case's bones. */
  readonly notice: string;
  /** Opens that case and comes back to the report; empty where it is open, or not here. */
  readonly way: string;
  readonly simulated: boolean;
}

export function attemptedCase(
  attempt: Pick<Attempt, "id" | "case" | "case_here" | "case_is_open" | "case_simulated">,
  open: Pick<CaseDescription, "simulated">,
): AttemptedCase {
  if (attempt.case_is_open) {
    return { notice: "", way: "", simulated: attempt.case_simulated ?? open.simulated };
  }
  const name = attempt.case === "" ? "" : `, ${attempt.case}`;
  return {
    notice: `This attempt was made on another case${name}; open that case to see the placement.`,
    way: attempt.case_here === "" ? "" : addressOfCase(attempt.case_here, `attempts/${attempt.id}`),
    simulated: attempt.case_simulated === true,
  };
}
