// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// When in an operation: minutes and seconds since it began.

/** "1:02.5" @param tickMs simulated time [ms] */
export function tickText(tickMs: number): string {
  const tenths = Math.round(tickMs / 100);
  const minutes = Math.floor(tenths / 600);
  return `${minutes}:${((tenths - 600 * minutes) / 10).toFixed(1).padStart(4, "0")}`;
}
