// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A log for reading: the same thing again and again is one line with a count.
import type { LoggedEvent } from "../protocol";

export interface EventRun {
  /** of the first */
  readonly tick: number;
  readonly text: string;
  readonly times: number;
}

export function runsOf(events: readonly LoggedEvent[]): EventRun[] {
  const runs: EventRun[] = [];
  for (const { tick, text } of events) {
    const last = runs.at(-1);
    if (last?.text === text) runs[runs.length - 1] = { ...last, times: last.times + 1 };
    else runs.push({ tick, text, times: 1 });
  }
  return runs;
}
