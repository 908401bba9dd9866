// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Figures of the score report (docs/scoring.md) as people write them.
import type { Grade, ScoreItem, ScoreReport } from "../protocol";

/** What stands beside the angle to the central axis: the other line that a screw is judged by. */
export function longestLineText(
  report: Pick<ScoreReport, "longest_line_mm" | "angle_to_longest_line_deg">,
): string {
  const { longest_line_mm: length, angle_to_longest_line_deg: angle } = report;
  const line = `the longest line through the bone, ${valueText({ value: length, unit: "mm" })}`;
  return `To ${line}: ${valueText({ value: angle, unit: "deg" })}`;
}

/** A value with its unit, for people: "4.2 mm", "3", "2 min 5 s", "not measured". */
export function valueText(item: Pick<ScoreItem, "value" | "unit">): string {
  const { value, unit } = item;
  if (value === null) return "not measured";
  if (unit === "s") {
    const seconds = Math.round(value);
    const minutes = Math.floor(seconds / 60);
    return minutes === 0 ? `${seconds} s` : `${minutes} min ${seconds % 60} s`;
  }
  if (unit === "1" || unit === "") return String(Math.round(100 * value) / 100);
  if (unit === "deg") return `${value.toFixed(1)}°`;
  return `${value.toFixed(1)} ${unit.replace("cm2", "cm²")}`;
}

export const GRADE_WORDS: Readonly<Record<Grade, string>> = {
  good: "good",
  acceptable: "acceptable",
  fail: "not reached",
  not_measured: "not measured",
};

export const GRADE_SIGNS: Readonly<Record<Grade, string>> = {
  good: "✓",
  acceptable: "○",
  fail: "✕",
  not_measured: "–",
};
