// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether drawing keeps up, and how much simpler it has to become: coarser shadows, none, fewer pixels
// while something moves. Only frames drawn one after the other count: at rest nothing is drawn, nothing
// is learnt, and after a moment the picture is drawn once more, sharp.

/** How a frame is drawn. */
export interface Drawing {
  /** Side of the shadow map; 0 for no shadows. */
  readonly shadowPixels: number;
  /** Device pixels per CSS pixel, at most. */
  readonly pixelRatio: number;
}

/** From the finest to the simplest. */
export const DRAWINGS: readonly [Drawing, ...Drawing[]] = [
  { shadowPixels: 2048, pixelRatio: 2 },
  { shadowPixels: 1024, pixelRatio: 2 },
  { shadowPixels: 0, pixelRatio: 1 },
  { shadowPixels: 0, pixelRatio: 0.7 },
  { shadowPixels: 0, pixelRatio: 0.5 },
];
/** Where WebGL runs on the processor one begins here. */
export const SOFTWARE_LEVEL = 3;
/** Of a picture at rest, whatever the level: more than one softens edges where nothing else does. */
const STILL_PIXEL_RATIO = 1.5;

/** A frame that takes longer is slow [ms]: under 20 a second the hand feels it. */
const SLOW_MS = 50;
/** So many slow frames in a row are no hiccup. */
const PATIENCE = 5;
/** Nothing changed for so long: the picture is at rest [ms]. */
const REST_MS = 300;

export class DrawingPace {
  private last = -1;
  private slow = 0;
  private restsSince = -1;
  private still = false;

  constructor(private level = 0) {}

  /** How the next frame is to be drawn. */
  get drawing(): Drawing {
    const drawing = DRAWINGS[this.level] ?? DRAWINGS[0];
    if (!this.still) return drawing;
    return { ...drawing, pixelRatio: Math.max(STILL_PIXEL_RATIO, drawing.pixelRatio) };
  }

  /** Something has changed and is drawn at `nowMs`. */
  moves(nowMs: number): void {
    const ms = nowMs - this.last;
    const first = this.last < 0;
    this.last = nowMs;
    this.restsSince = -1;
    this.still = false;
    if (first) return;
    this.slow = ms > SLOW_MS ? this.slow + 1 : 0;
    if (this.slow < PATIENCE || this.level >= DRAWINGS.length - 1) return;
    this.slow = 0;
    ++this.level;
  }

  /** Nothing has changed at `nowMs`. @return true when the picture is to be drawn once more, sharp. */
  rests(nowMs: number): boolean {
    this.last = -1;
    this.slow = 0;
    if (this.still) return false;
    if (this.restsSince < 0) this.restsSince = nowMs;
    if (nowMs - this.restsSince < REST_MS) return false;
    const before = this.drawing.pixelRatio;
    this.still = true;
    return this.drawing.pixelRatio > before;
  }
}
