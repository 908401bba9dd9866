// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Figures of past attempts as people write them.
import type { ProcedureSummary } from "../protocol";

/** "21 Nov 2026, 03:15", in the reader's own time; the text as it is where it is no date. */
export function dateText(iso: string): string {
  const date = new Date(iso);
  if (Number.isNaN(date.getTime())) return iso;
  return date.toLocaleString("en-GB", {
    day: "numeric",
    month: "short",
    year: "numeric",
    hour: "2-digit",
    minute: "2-digit",
  });
}

/** "1:02" of minutes and seconds. */
export function durationText(seconds: number): string {
  const whole = Math.round(seconds);
  return `${Math.floor(whole / 60)}:${String(whole % 60).padStart(2, "0")}`;
}

/** Its title, or its id where the host does not offer it. */
export function procedureText(id: string, known: readonly ProcedureSummary[]): string {
  return known.find((one) => one.id === id)?.title ?? id;
}

/** "50 of 20 000 attempts" of a list that is shown in part; empty where it is whole. */
export function shownText(shown: number, total: number): string {
  const spaced = (n: number): string => String(n).replace(/\B(?=(\d{3})+$)/g, "\u202f");
  return shown >= total ? "" : `${spaced(shown)} of ${spaced(total)} attempts`;
}
