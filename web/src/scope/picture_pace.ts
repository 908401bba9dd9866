// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How many pixels the scope's picture is drawn with: a machine without graphics hardware draws fewer of
// them rather than fewer pictures, for hands go by what they see move. Pure.

/** Slower pictures lose pixels, faster ones win them back [ms between two]. */
const SLOW_MS = 1000 / 15;
const FAST_MS = 1000 / 40;
/** Of the side. */
const LEAST_SHARE = 0.4;
/** Fewer across show too little of a joint. */
const LEAST_PX = 220;
const LESS = 0.85;
const MORE = 1.1;
const PICTURES = 8; // until it is judged again
const MOST_OF_THEM = 6; // one that is late says nothing
const PAUSE_MS = 1000; // so long a gap says nothing of how fast pictures are

export class PicturePace {
  private side = 1;
  private lastMs = -Infinity;
  private pictures = 0;
  private slow = 0;
  private fast = 0;

  /** Across the picture. @param sidePx  as it is on the page. @param nowMs  when one is drawn, rising */
  pixels(sidePx: number, nowMs: number): number {
    return Math.max(Math.min(sidePx, LEAST_PX), sidePx * this.share(nowMs));
  }

  /** Of the side that the picture has on the page, 0.4 to 1. */
  share(nowMs: number): number {
    const gapMs = nowMs - this.lastMs;
    this.lastMs = nowMs;
    if (gapMs > PAUSE_MS) return this.side;
    if (gapMs > SLOW_MS) ++this.slow;
    if (gapMs < FAST_MS) ++this.fast;
    if (++this.pictures < PICTURES) return this.side;
    if (this.slow >= MOST_OF_THEM) this.side = Math.max(LEAST_SHARE, this.side * LESS);
    else if (this.fast >= MOST_OF_THEM) this.side = Math.min(1, this.side * MORE);
    this.pictures = this.slow = this.fast = 0;
    return this.side;
  }
}
