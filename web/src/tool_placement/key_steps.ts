// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How much one step of a key is and how many a second a held one comes to: fine for the last tenth of a
// millimetre, coarse for the way there.

export interface KeyStep {
  /** One step: mm, or rad. */
  readonly size: number;
  /** [1/s] */
  readonly fastest: number;
}

export interface KeySteps {
  /** Of the tip, and of drawing back [mm]. */
  readonly move: KeyStep;
  /** Of the shaft [rad]. */
  readonly turn: KeyStep;
}

const DEGREE = Math.PI / 180;
/** Held they come to 8 mm/s and 40 deg/s, and to 40 mm/s and 90 deg/s. */
const FINE: KeySteps = {
  move: { size: 0.1, fastest: 80 },
  turn: { size: 0.5 * DEGREE, fastest: 80 },
};
const COARSE: KeySteps = {
  move: { size: 1, fastest: 40 },
  turn: { size: 5 * DEGREE, fastest: 18 },
};

export function keySteps(isCoarse: boolean): KeySteps {
  return isCoarse ? COARSE : FINE;
}
