// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How far one held key has moved the instrument: a tap is one step, holding goes on slowly and then
// faster and faster, so that the same key serves for a tenth of a millimetre and for a centimetre.

/** Until a key counts as held rather than tapped [s]. */
const HOLD_S = 0.3;
/** Once held, for a while [1/s]; then faster each moment, until so long after it went down [s]. */
const SLOW_STEPS_PER_S = 12;
const SLOW_UNTIL_S = 0.7;
const FASTEST_AFTER_S = 1.7;

/**
 * Steps made by a key that has been down for `heldS` seconds, the first one at once.
 * @param fastest  that it comes to [1/s]
 */
export function stepsAfter(heldS: number, fastest: number): number {
  if (!(heldS > HOLD_S)) return 1;
  const slow = heldS - HOLD_S;
  const gain = (fastest - SLOW_STEPS_PER_S) / (FASTEST_AFTER_S - SLOW_UNTIL_S);
  const growing = Math.max(0, Math.min(heldS, FASTEST_AFTER_S) - SLOW_UNTIL_S);
  const fast = Math.max(0, heldS - FASTEST_AFTER_S);
  const gained = 0.5 * gain * growing * growing + (fastest - SLOW_STEPS_PER_S) * fast;
  return 1 + slow * SLOW_STEPS_PER_S + gained;
}
