// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How hard is too hard in a joint, as the host counts it (clinical: B11, proposed from published probing
// forces). Pure.
export const WARN_N = 3;
export const INJURY_N = 8;

export type ForceGrade = "good" | "warning" | "injury";

export function gradeOf(newtons: number): ForceGrade {
  if (newtons > INJURY_N) return "injury";
  return newtons > WARN_N ? "warning" : "good";
}
