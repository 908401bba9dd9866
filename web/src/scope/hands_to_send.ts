// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// When the host is told of each of two hands: at once where its wish changed; the one that mouse and keys
// lead also while it rests, so that the host hears that somebody is there; a pedal that is held again and
// again, before the host takes it for let go. Pure.
import type { HandIndex } from "./scope_hands";

const REPEAT_MS = 200;
export const PEDAL_REPEAT_MS = 40;

export interface SentHand {
  /** Mouse and keys lead it. */
  readonly isLed: boolean;
  /** What it holds runs by its pedal. */
  readonly runs: boolean;
}

export class HandsToSend {
  private readonly changed: [boolean, boolean] = [true, false];
  private readonly lastMs: [number, number] = [-Infinity, -Infinity];

  begin(): void {
    this.changed[0] = true;
    this.changed[1] = false;
  }

  mark(hand: HandIndex): void {
    this.changed[hand] = true;
  }

  isDue(hand: HandIndex, { isLed, runs }: SentHand, nowMs: number): boolean {
    if (this.changed[hand]) return true;
    if (!isLed && !runs) return false;
    return nowMs - this.lastMs[hand] >= (runs ? PEDAL_REPEAT_MS : REPEAT_MS);
  }

  sent(hand: HandIndex, nowMs: number): void {
    this.changed[hand] = false;
    this.lastMs[hand] = nowMs;
  }
}
