// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What goes on by itself: the hand at most 60 times a second, a picture each frame, readings ten
// times a second.

/** Readings are for eyes: ten times a second is enough. */
const READINGS_MS = 100;
/** At most this often the hand is sent [1/s]. */
const SEND_PER_S = 60;

export interface Beats {
  hand(nowMs: number): void;
  draw(): void;
  readings(): void;
}

/** @return stops it */
export function startFrameLoop(beats: Beats): () => void {
  let frameRequest = 0;
  let lastSentMs = -Infinity;
  const timer = window.setInterval(() => {
    beats.readings();
    // Where frames are slow or the page is hidden, the host still has to hear of the hand.
    beats.hand(performance.now());
  }, READINGS_MS);
  const frame = (nowMs: number): void => {
    frameRequest = requestAnimationFrame(frame);
    if (nowMs - lastSentMs >= 1000 / SEND_PER_S - 1) {
      lastSentMs = nowMs;
      beats.hand(performance.now());
    }
    beats.draw();
  };
  frameRequest = requestAnimationFrame(frame);
  return () => {
    cancelAnimationFrame(frameRequest);
    clearInterval(timer);
  };
}
