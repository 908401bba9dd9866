// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Places where cartilage was scuffed, in words, and where in the replay they are.
import { tickText } from "../operation";
import type { ScuffedPlace } from "../protocol";

/** So long before it happened the replay begins [s]. */
const LEAD_S = 2;

export interface ScuffRow {
  /** Of its dot in the view. */
  readonly number: string;
  readonly bone: string;
  readonly how: string;
  readonly at: string;
  readonly replay: string;
}

export function scuffRows(scuffs: readonly ScuffedPlace[], attempt: number): readonly ScuffRow[] {
  return scuffs.map((scuff, index) => ({
    number: String(index + 1),
    bone: scuff.bone.replaceAll("_", " "),
    how: howText(scuff),
    at: tickText(scuff.tick),
    replay: `#/replay/${attempt}?t=${Math.max(0, scuff.tick / 1000 - LEAD_S).toFixed(1)}`,
  }));
}

function howText({ how, force_n: forceN, instrument }: ScuffedPlace): string {
  const force = how === "pressed" ? ` with up to ${forceN.toFixed(1)} N` : "";
  return `${how}${force}, ${instrument}`;
}

/** As the table of the score tells it; more may have been scuffed than are kept with their places. */
export function moreText(kept: number, all: number | null | undefined): string {
  const more = (all ?? kept) - kept;
  return more > 0 ? `and ${more} more, whose places were not kept` : "";
}
