// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is asked before an operation ends with steps not done.
import type { Step } from "../protocol";

/** So many are named; more would not be read. */
const NAMED = 4;

/** Empty where all are done. */
export function openStepsText(
  steps: readonly Pick<Step, "title">[],
  completed: readonly number[],
): string {
  const open = steps.filter((_, index) => !completed.includes(index)).map(({ title }) => title);
  if (open.length === 0) return "";
  const named = open.slice(0, NAMED).join(", ");
  const more = open.length > NAMED ? ` and ${open.length - NAMED} more` : "";
  const what = open.length === 1 ? "A step is" : `${open.length} of ${steps.length} steps are`;
  return `${what} still open: ${named}${more}.`;
}
