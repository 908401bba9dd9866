// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the report may say of the case of an attempt. The records hold attempts of several cases, the
// station serves one: a placement drawn in another patient's scaphoid would be a lie.
import type { AttemptSummary } from "../attempts_list";
import type { CaseDescription } from "../protocol";

export interface AttemptedCase {
  /** Stands in place of the pictures; empty where they may be drawn in the open case's bones. */
  readonly notice: string;
  readonly simulated: boolean;
}

export function attemptedCase(
  attempt: Pick<AttemptSummary, "caseName" | "caseIsOpen" | "caseSimulated"> | undefined,
  open: Pick<CaseDescription, "simulated">,
): AttemptedCase {
  if (attempt?.caseIsOpen === true) {
    return { notice: "", simulated: attempt.caseSimulated ?? open.simulated };
  }
  const name = attempt === undefined || attempt.caseName === "" ? "" : `, ${attempt.caseName}`;
  return {
    notice: `This attempt was made on another case${name}; open that case to see the placement.`,
    simulated: attempt?.caseSimulated === true,
  };
}
