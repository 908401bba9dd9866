// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The camera head's automatic exposure: what lies before the lens is neither burnt out near it nor lost in
// the dark, as on a tower. It follows slowly, so that coming near to something is still seen as light.

/** Grey of the round field that it goes for, 0 to 1, as shown. */
const WANTED_GREY = 0.52;
const LEAST = 0.07;
const MOST = 1.6;
/** In so long it goes most of the way, in the logarithm [s]. */
const SETTLES_S = 0.45;
/** The display's exponent: what is shown twice as bright is lit 2^2.2 times as much. */
const GAMMA = 2.2;

/** @param grey  mean of the field as it was shown with `exposure`; @param seconds  since the last look */
export function nextExposure(exposure: number, grey: number, seconds: number): number {
  const wanted = exposure * Math.pow(WANTED_GREY / Math.max(grey, 0.01), GAMMA);
  const share = 1 - Math.exp(-seconds / SETTLES_S);
  const next = exposure * Math.pow(wanted / exposure, share);
  return Math.min(MOST, Math.max(LEAST, next));
}

/** @param rgba  of a square picture. @return mean grey of its inscribed circle, 0 to 1 */
export function meanGrey(rgba: Uint8ClampedArray): number {
  const across = Math.round(Math.sqrt(rgba.length / 4));
  const half = across / 2;
  let sum = 0;
  let count = 0;
  for (let y = 0; y < across; ++y) {
    for (let x = 0; x < across; ++x) {
      if (Math.hypot(x + 0.5 - half, y + 0.5 - half) > half) continue;
      const at = 4 * (y * across + x);
      sum += 0.3 * (rgba[at] ?? 0) + 0.59 * (rgba[at + 1] ?? 0) + 0.11 * (rgba[at + 2] ?? 0);
      count += 1;
    }
  }
  return count === 0 ? 0 : sum / count / 255;
}
