// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether drawing keeps up, and how much simpler it has to become. Only frames drawn one after the
// other count: at rest nothing is drawn and nothing is learnt.

/** A frame that takes longer is slow [ms]: under 20 a second the hand feels it. */
const SLOW_MS = 50;
/** So many slow frames in a row are no hiccup. */
const PATIENCE = 5;
const LEVELS = 2;

export class DrawingPace {
  level = 0;
  private last = -1;
  private slow = 0;

  /** Tells of a frame at `nowMs`. @return true when drawing has just become one level simpler. */
  drew(nowMs: number): boolean {
    const ms = nowMs - this.last;
    const first = this.last < 0;
    this.last = nowMs;
    if (first) return false;
    this.slow = ms > SLOW_MS ? this.slow + 1 : 0;
    if (this.slow < PATIENCE || this.level >= LEVELS) return false;
    this.slow = 0;
    ++this.level;
    return true;
  }

  /** Nothing was drawn this time. */
  rest(): void {
    this.last = -1;
    this.slow = 0;
  }
}
