// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The operation that waits for a page, in words: whose it is, since when, how far it went.
import type { Step } from "../protocol";

export interface WaitingOperation {
  /** As typed; may be empty. */
  readonly trainee: string;
  /** UTC, ISO 8601. */
  readonly startedAt: string;
  /** Begun by this page: it may go on with it. */
  readonly isOwn: boolean;
}

export interface HowFar {
  /** Number of the current one. */
  readonly step: number;
  /** Time spent in the operation [ms]. */
  readonly tick: number;
}

function clock(date: Date, now: Date): string {
  const two = (n: number): string => String(n).padStart(2, "0");
  const time = `${two(date.getHours())}:${two(date.getMinutes())}`;
  if (date.toDateString() === now.toDateString()) return time;
  return `${time} on ${date.getFullYear()}-${two(date.getMonth() + 1)}-${two(date.getDate())}`;
}

function duration(ms: number): string {
  const minutes = Math.floor(ms / 60_000);
  const seconds = Math.floor(ms / 1000) % 60;
  return minutes === 0 ? `${seconds} s` : `${minutes} min ${seconds} s`;
}

/**
 * @param howFar  unknown until the host's first snapshot
 * @param steps   of what is done; empty until the host has told
 */
export function waitingText(
  waiting: WaitingOperation,
  howFar: HowFar | undefined,
  steps: readonly Step[],
  now: Date,
): string {
  const { trainee, isOwn } = waiting;
  const unnamed = isOwn ? "An operation without a name" : "Another page's operation";
  const whose = trainee === "" ? unnamed : `The operation of ${trainee}`;
  const started = new Date(waiting.startedAt);
  const since = Number.isNaN(started.getTime()) ? "" : `, begun at ${clock(started, now)}`;
  const step = howFar === undefined ? undefined : steps[howFar.step];
  const at =
    howFar === undefined || step === undefined
      ? ""
      : `; ${duration(howFar.tick)} in, at step ${howFar.step + 1}, ${step.title}`;
  const keeps = trainee === "" ? "" : " Going on keeps it under that name.";
  const ends = " Only its own page goes on with it; starting anew stores it as unfinished.";
  return `${whose} waits${since}${at}.${isOwn ? keeps : ends}`;
}

/** After a station was started again: what this page had seen done and is not; empty where all is. */
export function lostText(seenTick: number | undefined, tick: number): string {
  if (seenTick === undefined || tick >= seenTick) return "";
  const seconds = ((seenTick - tick) / 1000).toFixed(1);
  return `The station was started again: the last ${seconds} s are lost, the rest goes on.`;
}
