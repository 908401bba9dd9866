// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the findings' dialog says of what it asks.
import type { ControlledScrew } from "../protocol";

const TAKEN_BACK = "You may come back to it; what stands here when you finish counts.";

export const WHAT_IS_ASKED = {
  structures: `Of each structure one grade, healthy ones too. ${TAKEN_BACK}`,
  screw: `Of each place what you found, and what is to be done. An answer counts where the place had been in view before. ${TAKEN_BACK}`,
} as const;

/** What the operation's report says: whether there is bone before the tip follows from it. */
export function reportOf(screw: ControlledScrew | null): string {
  if (screw === null) return "";
  return `Report of the operation: ${screw.line_mm} mm measured between the cortices, a headless screw of ${screw.length_mm} mm put in from the proximal pole.`;
}
