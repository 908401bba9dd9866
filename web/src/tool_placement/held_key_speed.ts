// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How far one held key has moved the instrument: a tap is one fine step, holding goes on slowly and
// then faster, so that the same key serves for a tenth of a millimetre and for a centimetre.

/** Until a key counts as held rather than tapped [s]. */
const HOLD_S = 0.3;
/** Steps a second once held, and after `FAST_AFTER_S`. */
const SLOW_STEPS_PER_S = 12;
const FAST_STEPS_PER_S = 60;
const FAST_AFTER_S = 1.2;

/** Steps made by a key that has been down for `heldS` seconds, the first one at once. */
export function stepsAfter(heldS: number): number {
  if (!(heldS > HOLD_S)) return 1;
  const slow = Math.min(heldS, FAST_AFTER_S) - HOLD_S;
  const fast = Math.max(0, heldS - FAST_AFTER_S);
  return 1 + slow * SLOW_STEPS_PER_S + fast * FAST_STEPS_PER_S;
}
