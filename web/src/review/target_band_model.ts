// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is good, as numbers, of the sentence that the host says for people (src/procedure/grading.cpp):
// "at most 5° good, over 15° fails", "none; a single one fails". A sentence of another kind has no band,
// and none is drawn. Pure.

/** Where there is no limit, infinite. */
export interface TargetBand {
  readonly from: number;
  readonly to: number;
}

const NUMBER = "(-?[\\d.]+)";
const UNIT = "[^\\d;]*?";
const PATTERNS: readonly (readonly [RegExp, (a: number, b: number) => TargetBand])[] = [
  [/^none(;| is good)/, () => ({ from: -Infinity, to: 0 })],
  [new RegExp(`^at most ${NUMBER}${UNIT} good`), (a) => ({ from: -Infinity, to: a })],
  [new RegExp(`^at least ${NUMBER}${UNIT} good`), (a) => ({ from: a, to: Infinity })],
  [new RegExp(`^${NUMBER}${UNIT} to ${NUMBER}${UNIT} good`), (from, to) => ({ from, to })],
];

/** @param unit  of the item: times are said in minutes and counted in seconds */
export function bandOf(target: string, unit: string): TargetBand | undefined {
  const factor = unit === "s" && / min good/.test(target) ? 60 : 1;
  for (const [pattern, band] of PATTERNS) {
    const found = pattern.exec(target.replace("cm²", ""));
    if (found === null) continue;
    return band(factor * Number(found[1]), factor * Number(found[2] ?? 0));
  }
  return undefined;
}
